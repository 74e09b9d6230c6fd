import type { EpsgEntry } from "./crs.js";

/** West, south, east, north in degrees; `west` exceeds `east` across the antimeridian. */
export type AreaOfUse = readonly [west: number, south: number, east: number, north: number];

/** The area of use of a row of an EPSG table; undefined where the row has none. */
export function areaOf({ bbox }: Pick<EpsgEntry, "bbox">): AreaOfUse | undefined {
  if (bbox?.length !== 4 || !bbox.every(Number.isFinite)) return undefined;
  const [north, west, south, east] = bbox;
  return [west, south, east, north];
}

/**
 * The countries that EPSG names in an area of use: `Europe between 6°E and 12°E: Austria; Germany - onshore.` has
 * Austria and Germany.
 */
export function countriesIn(area: string): string[] {
  const list = area.slice(area.lastIndexOf(":") + 1).replace(/^\s*Europe - onshore -/, "");
  const names = list.split(/[;.]/).map((part) => part.split(PART_OF_COUNTRY)[0].trim());
  return [...new Set(names.filter((name) => /^[A-Z]/.test(name)))];
}

/** What follows the name of a country, and says which part of it is meant. */
const PART_OF_COUNTRY =
  / - |\(|, |–| (?:north|east|south|west|between|onshore|offshore|mainland|including)\b/;

/** Degrees. */
export interface Place {
  readonly longitude: number;
  readonly latitude: number;
}

const DEGREE = Math.PI / 180;
/** Mean radius of the earth, metres. */
const RADIUS = 6_371_008.8;
/** Turns of longitude, and the edges of an area, to this many degrees (a metre). */
const EDGE = 1e-5;

/** Degrees of longitude from one side to the other. */
export function widthOf([west, , east]: AreaOfUse): number {
  return east >= west ? east - west : east - west + 360;
}

/** Square degrees: how much an area says of a place. */
export function extentOf(area: AreaOfUse): number {
  return widthOf(area) * (area[3] - area[1]);
}

/** Whether a place lies in an area, its edges included. */
export function isInside(area: AreaOfUse, { longitude, latitude }: Place): boolean {
  const east = eastOf(area[0], longitude);
  const within = east <= widthOf(area) + EDGE || east >= 360 - EDGE;
  return within && latitude >= area[1] - EDGE && latitude <= area[3] + EDGE;
}

/** Whether two areas have a place in common. */
export function areOverlapping(a: AreaOfUse, b: AreaOfUse): boolean {
  const inLongitude = eastOf(a[0], b[0]) <= widthOf(a) || eastOf(b[0], a[0]) <= widthOf(b);
  return inLongitude && a[1] <= b[3] && b[1] <= a[3];
}

/** Metres from a place to the nearest point of an area on a sphere (good to half a per cent); 0 inside. */
export function distanceTo(area: AreaOfUse, place: Place): number {
  if (isInside(area, place)) return 0;
  const { longitude, latitude } = place;
  const within = eastOf(area[0], longitude) <= widthOf(area);
  const meridians = within ? [longitude] : [area[0], area[2]];
  return Math.min(...meridians.map((meridian) => toMeridian(area, latitude, longitude - meridian)));
}

/** Metres to the part of a meridian that an area has; `apart` degrees of longitude away. */
function toMeridian([, south, , north]: AreaOfUse, latitude: number, apart: number): number {
  // The nearest point of the whole meridian, held between the ends of the part.
  const nearest = Math.atan2(Math.tan(latitude * DEGREE), Math.cos(apart * DEGREE)) / DEGREE;
  const ends = [Math.min(Math.max(nearest, south), north), south, north];
  return Math.min(...ends.map((end) => onSphere(latitude * DEGREE, end * DEGREE, apart * DEGREE)));
}

/** Great-circle distance by the haversine. */
function onSphere(latitudeA: number, latitudeB: number, apart: number): number {
  const h =
    Math.sin((latitudeB - latitudeA) / 2) ** 2 +
    Math.cos(latitudeA) * Math.cos(latitudeB) * Math.sin(apart / 2) ** 2;
  return 2 * RADIUS * Math.asin(Math.min(1, Math.sqrt(h)));
}

/** Degrees that `longitude` lies east of `from`: 0 to 360. */
function eastOf(from: number, longitude: number): number {
  return (((longitude - from) % 360) + 360) % 360;
}
