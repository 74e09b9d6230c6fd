/** Colour of what a link draws, on either side. */
export const ACCENT = "#f2b84b";
