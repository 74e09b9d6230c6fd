/** What the reader says heights are: as the file has it, above the ellipsoid, or in the height system of a code. */
export type HeightWish = "declared" | "ellipsoidal" | "code";

/** What follows from that: a way to open the cloud, or words about why there is none in the page. */
export type HeightChoice =
  | { readonly kind: "open"; readonly vertical: string | undefined }
  | { readonly kind: "refused"; readonly words: string };

/**
 * What can be done about a wish. The page carries no geoids and no table of codes; a conversion has both, so what is
 * not the ellipsoid is left to it.
 *
 * @param code what the reader wrote as the code
 * @param name name of the cloud's file
 */
export function chooseHeight(wish: HeightWish, code: string, name: string): HeightChoice {
  if (wish === "declared") return { kind: "open", vertical: undefined };
  if (wish === "ellipsoidal") return { kind: "open", vertical: "ellipsoidal" };
  const [, number] = /^\s*(?:EPSG:)?(\d{4,6})\s*$/i.exec(code) ?? [];
  if (number === undefined) {
    return { kind: "refused", words: "Give the EPSG code of a height system, such as 5728." };
  }
  return {
    kind: "refused",
    words: `Heights above EPSG:${number} need its geoid, which goes into the file when it is converted: groma convert SCAN ${name} --vertical EPSG:${number}`,
  };
}
