import type * as PdfLib from "@cantoo/pdf-lib";
import type { Sheet, SheetText } from "./sheet.js";
import { pngOf } from "./svg.js";

/** PDF's points per millimetre. */
const POINT = 72 / 25.4;

/**
 * Sheets as one PDF, a page each, in their real size; printed without scaling it is true to scale, and the file asks for that.
 * Characters that the standard font lacks are written as `?`.
 */
export async function pdfOf(
  sheets: AsyncIterable<Sheet> | Iterable<Sheet>,
  title: string,
): Promise<Uint8Array> {
  const lib = await import("@cantoo/pdf-lib");
  const document = await lib.PDFDocument.create({ updateMetadata: false });
  document.setTitle(title);
  document.setProducer("Groma");
  document.catalog.getOrCreateViewerPreferences().setPrintScaling(lib.PrintScaling.None);
  const font = await document.embedFont(lib.StandardFonts.Helvetica);
  for await (const sheet of sheets) {
    const page = document.addPage([sheet.width * POINT, sheet.height * POINT]);
    for (const image of sheet.images) {
      const embedded = await document.embedPng(pngOf(image));
      page.drawImage(embedded, {
        ...{ x: image.x * POINT, y: image.y * POINT },
        ...{ width: image.width * POINT, height: image.height * POINT },
      });
    }
    page.pushOperators(...strokes(lib, sheet));
    for (const text of sheet.texts) write(lib, page, font, text);
  }
  return document.save();
}

function strokes(lib: typeof PdfLib, { lines }: Sheet): PdfLib.PDFOperator[] {
  return lines.flatMap(({ places, width, colour: [red, green, blue] }) => [
    lib.pushGraphicsState(),
    lib.setStrokingRgbColor(red / 255, green / 255, blue / 255),
    lib.setLineWidth(width * POINT),
    ...places.map(([x, y], index) => (index === 0 ? lib.moveTo : lib.lineTo)(x * POINT, y * POINT)),
    lib.stroke(),
    lib.popGraphicsState(),
  ]);
}

function write(
  lib: typeof PdfLib,
  page: PdfLib.PDFPage,
  font: PdfLib.PDFFont,
  { text, x, y, size, anchor, upwards }: SheetText,
): void {
  const known = new Set(font.getCharacterSet());
  const shown = [...text].map((letter) => (known.has(letter.codePointAt(0)!) ? letter : "?")).join("");
  const share = anchor === "start" ? 0 : anchor === "middle" ? 0.5 : 1;
  const back = share * font.widthOfTextAtSize(shown, size * POINT);
  page.drawText(shown, {
    ...(upwards
      ? { x: x * POINT, y: y * POINT - back, rotate: lib.degrees(90) }
      : { x: x * POINT - back, y: y * POINT }),
    ...{ size: size * POINT, font },
  });
}
