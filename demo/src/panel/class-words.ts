import { i18n } from "../language/i18n.js";

/** The names of ASPRS LAS 1.4, table 17. */
const NAMES: ReadonlyMap<string, string> = new Map([
  ["Created, never classified", i18n.t("Created, never classified")],
  ["Unclassified", i18n.t("Unclassified")],
  ["Ground", i18n.t("Ground")],
  ["Low vegetation", i18n.t("Low vegetation")],
  ["Medium vegetation", i18n.t("Medium vegetation")],
  ["High vegetation", i18n.t("High vegetation")],
  ["Building", i18n.t("Building")],
  ["Low point (noise)", i18n.t("Low point (noise)")],
  ["Reserved", i18n.t("Reserved")],
  ["Water", i18n.t("Water")],
  ["Rail", i18n.t("Rail")],
  ["Road surface", i18n.t("Road surface")],
  ["Wire – guard (shield)", i18n.t("Wire – guard (shield)")],
  ["Wire – conductor (phase)", i18n.t("Wire – conductor (phase)")],
  ["Transmission tower", i18n.t("Transmission tower")],
  ["Wire-structure connector", i18n.t("Wire-structure connector")],
  ["Bridge deck", i18n.t("Bridge deck")],
  ["High noise", i18n.t("High noise")],
  ["Overhead structure", i18n.t("Overhead structure")],
  ["Ignored ground", i18n.t("Ignored ground")],
  ["Snow", i18n.t("Snow")],
  ["Temporal exclusion", i18n.t("Temporal exclusion")],
  ["User definable", i18n.t("User definable")],
]);

/** A class in the reader's language; a name that the application gave stays as it is. */
export function classWords(name: string): string {
  return NAMES.get(name) ?? name;
}
