/** A drawing on paper, millimetres from the lower left corner. */
export interface Sheet {
  readonly width: number;
  readonly height: number;
  readonly title: string;
  readonly images: readonly SheetImage[];
  readonly lines: readonly SheetLine[];
  readonly texts: readonly SheetText[];
}

/** A line through places of the sheet, millimetres. */
export interface SheetLine {
  readonly places: readonly (readonly [x: number, y: number])[];
  /** Width of the line, millimetres. */
  readonly width: number;
  readonly colour: Colour;
}

/** A line of text at a place of the sheet, millimetres. */
export interface SheetText {
  readonly text: string;
  readonly x: number;
  readonly y: number;
  /** Of the font, millimetres. */
  readonly size: number;
  /** Which part of the text is at x. */
  readonly anchor: "start" | "middle" | "end";
  /** Whether it is written upwards. */
  readonly upwards?: true | undefined;
}

/** Pixels, four bytes each (RGBA), top row first. */
export interface Pixels {
  readonly columns: number;
  readonly rows: number;
  readonly data: Uint8Array;
}

/** A picture on the sheet. */
export interface SheetImage extends Pixels {
  /** Lower left corner and size, millimetres. */
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

/** 0 to 255. */
export type Colour = readonly [red: number, green: number, blue: number];

export const BLACK: Colour = [20, 20, 20];
export const GRID: Colour = [205, 210, 215];
export const GROUND: Colour = [178, 34, 34];
