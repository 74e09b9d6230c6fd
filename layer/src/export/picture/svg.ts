import { printable } from "@groma/georef";
import { encode } from "fast-png";
import type { Colour, Pixels, Sheet, SheetText } from "./sheet.js";

/** Pixels as a PNG file. */
export function pngOf({ columns, rows, data }: Pixels): Uint8Array {
  return encode({ width: columns, height: rows, data, channels: 4, depth: 8 }, { zlib: { level: 3 } });
}

/** A sheet as SVG 1.1 in its real size: a program that keeps to the sizes of the file prints it true to scale. */
export function svgOf({ width, height, title, images, lines, texts }: Sheet): string {
  const parts = [
    '<?xml version="1.0" encoding="UTF-8"?>',
    `<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="${width}mm" height="${height}mm" viewBox="0 0 ${width} ${height}" font-family="Helvetica, Arial, sans-serif">`,
    `<title>${escaped(title)}</title>`,
    `<rect width="${width}" height="${height}" fill="#fff"/>`,
  ];
  const down = (y: number) => number(height - y);
  const grid = lines.map(({ places, width: stroke, colour }) => {
    const points = places.map(([x, y]) => `${number(x)},${down(y)}`).join(" ");
    return `<polyline points="${points}" fill="none" stroke="${hex(colour)}" stroke-width="${stroke}"/>`;
  });
  const pictures = images.map((image) => {
    const place = `x="${number(image.x)}" y="${down(image.y + image.height)}" width="${number(image.width)}" height="${number(image.height)}"`;
    const uri = `data:image/png;base64,${base64(pngOf(image))}`;
    return `<image ${place} preserveAspectRatio="none" style="image-rendering:pixelated" xlink:href="${uri}"/>`;
  });
  parts.push(...pictures, ...grid, ...texts.map((text) => textOf(text, down)), "</svg>\n");
  return parts.join("\n");
}

function textOf({ text, x, y, size, anchor, upwards }: SheetText, down: (y: number) => string): string {
  const turn = upwards ? ` transform="rotate(-90 ${number(x)} ${down(y)})"` : "";
  return `<text x="${number(x)}" y="${down(y)}" font-size="${size}" text-anchor="${anchor}"${turn}>${escaped(text)}</text>`;
}

/** Digits: a thousandth of a millimetre. */
function number(value: number): string {
  return String(Number(value.toFixed(3)));
}

function hex(colour: Colour): string {
  return `#${colour.map((part) => part.toString(16).padStart(2, "0")).join("")}`;
}

/** Text that XML takes as text, on one line, without what nobody sees. */
export function escaped(text: string): string {
  const marks: Readonly<Record<string, string>> = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" };
  return printable(text).replace(/[&<>"]/g, (mark) => marks[mark]);
}

function base64(bytes: Uint8Array): string {
  let text = "";
  for (let from = 0; from < bytes.length; from += 0x8000) {
    text += String.fromCharCode(...bytes.subarray(from, from + 0x8000));
  }
  return btoa(text);
}
