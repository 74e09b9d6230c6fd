import type { ScaleBar } from "./scale-bar.js";
import type { ViewShot } from "./view-shot.js";

/** What is drawn beside the picture of a view. */
export interface SheetView {
  readonly shot: ViewShot;
  /** Undefined where the view shows no ground in its middle. */
  readonly bar: ScaleBar | undefined;
  /** Under the bar, or in its place. */
  readonly remark: string;
}

/** Colours of what is drawn on and below the picture: the same in every look, to be printed. */
const INK = "#10161d";
const PAPER = "#fff";
const PLATE = "rgb(255 255 255 / 88%)";
const NORTH = "#b3261e";
const FONT = '"Liberation Sans", "Segoe UI", system-ui, sans-serif';

/** CSS pixels: around plates and words, of the bar's height, of a line of words, and of the arrow's disc. */
const MARGIN = 12;
const BAR = 6;
const LINE = 17;
const DISC = 46;

/**
 * Lays pictures of views out as they are in the page, each with its scale bar and north arrow, and the sources below.
 * @param size of the page, CSS pixels
 * @param ratio pixels of the picture per CSS pixel
 * @param lines what the picture shows and where that comes from; each on one line, cut off where it is too long
 */
export function drawSheet(
  views: readonly SheetView[],
  { width, height }: { readonly width: number; readonly height: number },
  ratio: number,
  lines: readonly string[],
): HTMLCanvasElement {
  const foot = lines.length * LINE + 2 * MARGIN - 6;
  const canvas = document.createElement("canvas");
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round((height + foot) * ratio);
  const context = canvas.getContext("2d");
  if (!context) throw new Error("the browser gives no canvas to draw a picture on");
  context.scale(ratio, ratio);
  context.fillStyle = INK;
  context.fillRect(0, 0, width, height);
  for (const view of views) {
    const { left, top, width: wide, height: high } = view.shot.box;
    context.drawImage(view.shot.image, left, top, wide, high);
    drawPlate(context, view);
  }
  context.fillStyle = PAPER;
  context.fillRect(0, height, width, foot);
  context.fillStyle = INK;
  context.font = `12px ${FONT}`;
  context.textBaseline = "middle";
  for (const [at, line] of lines.entries()) {
    const y = height + MARGIN - 3 + (at + 0.5) * LINE;
    context.fillText(cutOff(context, line, width - 2 * MARGIN), MARGIN, y);
  }
  return canvas;
}

/** The scale bar and the north arrow of a view, in its lower left corner. */
function drawPlate(
  context: CanvasRenderingContext2D,
  { shot: { box, ground }, bar, remark }: SheetView,
): void {
  context.font = `11px ${FONT}`;
  const words = context.measureText(remark).width;
  const wide = Math.max(bar?.pixels ?? 0, words) + (ground ? DISC + MARGIN : 0) + 2 * MARGIN;
  const high = DISC + 10;
  const [x, y] = [box.left + MARGIN, box.bottom - MARGIN - high];
  context.fillStyle = PLATE;
  context.beginPath();
  context.roundRect(x, y, wide, high, 6);
  context.fill();
  context.fillStyle = INK;
  context.textBaseline = "middle";
  const inside = x + MARGIN;
  if (bar) {
    context.fillText(remark, inside, y + high - 11);
    drawBar(context, bar, inside, y + 24);
  } else context.fillText(remark, inside, y + high / 2);
  if (ground) drawArrow(context, ground.north, x + wide - MARGIN - DISC / 2, y + high / 2);
}

/** Four parts, dark and light by turns, in a dark frame as long as the bar. */
function drawBar(context: CanvasRenderingContext2D, { label, pixels }: ScaleBar, x: number, y: number): void {
  context.font = `600 12px ${FONT}`;
  context.fillText(label, x, y - 9);
  context.fillRect(x, y, pixels, BAR);
  context.fillStyle = PAPER;
  for (const part of [1, 3])
    context.fillRect(x + (part * pixels) / 4, y + 1.5, pixels / 4 - (part - 1) * 0.75, BAR - 3);
  context.fillStyle = INK;
}

/** @param north radians clockwise from the picture's upper edge */
function drawArrow(context: CanvasRenderingContext2D, north: number, x: number, y: number): void {
  context.save();
  context.translate(x, y);
  context.font = `600 11px ${FONT}`;
  context.textAlign = "center";
  context.fillText("N", 18 * Math.sin(north), -18 * Math.cos(north));
  context.rotate(north);
  context.fillStyle = NORTH;
  context.beginPath();
  for (const [right, down] of [
    [0, -11],
    [7, 13],
    [0, 8],
    [-7, 13],
  ] as const) {
    context.lineTo(right, down);
  }
  context.fill();
  context.restore();
}

/** A text that takes no more room than there is. */
function cutOff(context: CanvasRenderingContext2D, text: string, room: number): string {
  if (context.measureText(text).width <= room) return text;
  const letters = Array.from(text);
  let [fits, end] = [0, letters.length];
  while (end - fits > 1) {
    const middle = Math.floor((fits + end) / 2);
    if (context.measureText(`${letters.slice(0, middle).join("")}…`).width <= room) fits = middle;
    else end = middle;
  }
  return `${letters.slice(0, fits).join("")}…`;
}
