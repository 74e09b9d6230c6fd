import { i18n } from "../language/i18n.js";

/** What the reader says heights are: as the file has it, above the ellipsoid, or in the height system of a code. */
export type HeightWish = "declared" | "ellipsoidal" | "code";

/** What follows from that: a way to open the cloud, or words about what is still missing. */
export type HeightChoice =
  | { readonly kind: "open"; readonly vertical: string | undefined }
  | { readonly kind: "refused"; readonly words: string };

/**
 * What can be done about a wish.
 *
 * @param code what the reader wrote as the code
 */
export function chooseHeight(wish: HeightWish, code: string): HeightChoice {
  if (wish === "declared") return { kind: "open", vertical: undefined };
  if (wish === "ellipsoidal") return { kind: "open", vertical: "ellipsoidal" };
  const [, number] = /^\s*(?:EPSG:)?(\d{4,6})\s*$/i.exec(code) ?? [];
  if (number !== undefined) return { kind: "open", vertical: `EPSG:${number}` };
  return { kind: "refused", words: i18n.t("Give the EPSG code of a height system, such as 5728.") };
}
