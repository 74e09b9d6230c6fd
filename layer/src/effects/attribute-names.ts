/** Columns whose names are fit for GLSL as they stand; extra bytes may be called anything. */
const PLAIN = /^[A-Za-z][A-Za-z0-9]*$/;

/** GLSL name of the attribute that reads a column. Extra bytes with unfit names are named by their characters' codes. */
export function attributeName(column: string): string {
  if (PLAIN.test(column)) return `a_${column}`;
  const codes = [...column].map((character) =>
    /[A-Za-z0-9]/.test(character) ? character : `x${character.codePointAt(0)!.toString(16)}x`,
  );
  return `a_e${codes.join("")}`;
}
