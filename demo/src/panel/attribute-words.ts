import type { AttributeInfo } from "@groma/layer/cesium";

const LABELS: ReadonlyMap<string, string> = new Map(
  Object.entries({
    elevation: "elevation",
    ellipsoidalHeight: "height above the ellipsoid",
    returnNumber: "return number",
    numberOfReturns: "number of returns",
    scanAngle: "scan angle",
    userData: "user data",
    pointSourceId: "point source",
    gpsTime: "GPS time",
    nir: "near infrared",
    red: "red",
    green: "green",
    blue: "blue",
  }),
);

/** What an attribute is called on the page: the field's words, or the file's for extra bytes. */
export function attributeLabel({
  name,
  label,
  unit,
}: Pick<AttributeInfo, "name"> & Partial<AttributeInfo>): string {
  const text = LABELS.get(name) ?? label ?? name;
  return unit ? `${text} (${unit})` : text;
}
