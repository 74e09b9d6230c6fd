import type { AttributeInfo } from "@groma/layer/cesium";
import { i18n } from "../language/i18n.js";
import { libraryWords } from "../language/library-words.js";

const LABELS: ReadonlyMap<string, string> = new Map(
  Object.entries({
    intensity: i18n.t("intensity"),
    classification: i18n.t("classification"),
    elevation: i18n.t("elevation"),
    ellipsoidalHeight: i18n.t("height above the ellipsoid"),
    returnNumber: i18n.t("return number"),
    numberOfReturns: i18n.t("number of returns"),
    scanAngle: i18n.t("scan angle"),
    userData: i18n.t("user data"),
    pointSourceId: i18n.t("point source"),
    gpsTime: i18n.t("GPS time"),
    nir: i18n.t("near infrared"),
    red: i18n.t("red"),
    green: i18n.t("green"),
    blue: i18n.t("blue"),
  }),
);

/** What an attribute is called on the page: the field's words, or the file's for extra bytes. */
export function attributeLabel({
  name,
  label,
  unit,
}: Pick<AttributeInfo, "name"> & Partial<AttributeInfo>): string {
  const text = LABELS.get(name) ?? label ?? name;
  return unit ? `${text} (${libraryWords(unit)})` : text;
}
