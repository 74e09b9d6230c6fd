import { CAMERA_VIEW, type CameraView, isCameraView } from "../camera/index.js";
import { type Clip, checkClip } from "../clips/index.js";
import { defaultStyle, type PointCloudStyle, type PointFilter, type StyleParts } from "../effects/index.js";
import { LinkError } from "../errors/index.js";
import { asText, fromText } from "./json-text.js";

/** How one of several clouds is drawn: as of {@link SharedView}. */
export type DrawnCloud = Pick<SharedView, "style" | "filter">;

/** What a link keeps of a view; all of it may be left out. */
export interface SharedView {
  readonly camera?: CameraView | undefined;
  /** What differs from the style by default: see {@link layerView}. */
  readonly style?: StyleParts | undefined;
  readonly filter?: PointFilter | undefined;
  readonly clips?: readonly Clip[] | undefined;
  /** How further clouds are drawn, in the order in which an application names them beside the link; at most 100. */
  readonly others?: readonly DrawnCloud[] | undefined;
  /** A record that is selected: its node, `depth-x-y-z`, and its index there. */
  readonly selected?: { readonly node: string; readonly index: number } | undefined;
}

/** Written first; a reader refuses any other. */
const VERSION = "1";
/** Stands between the parts: needs no escape in the query or the fragment of an address, and no part holds it. */
const BETWEEN = "~";
/** Longest text that is written or read. */
const LONGEST = 100_000;

/** Clouds that are written or read besides the one that the view is of. */
const MOST_OTHERS = 100;

const DEGREE = Math.PI / 180;
/** Decimals of a camera's numbers, degrees and metres: a centimetre and a hundredth of a degree. */
const DECIMALS = [7, 7, 2, 2, 2, 2] as const;

/** What each part of a link is, by its first letter. */
const PARTS: ReadonlyMap<string, keyof SharedView> = new Map([
  ["c", "camera"],
  ["s", "style"],
  ["f", "filter"],
  ["k", "clips"],
  ["o", "others"],
  ["p", "selected"],
]);

/**
 * A view as short text for the address of a page: `1~c8.5412345_47.3712345_1200_30_-45_0~p2-0-1-0_153`. What is left out
 * is left out of the text too.
 *
 * @throws LinkError LINK_LONG for a view that no address can hold: volumes of many thousand corners
 */
export function writePermalink({ camera, style, filter, clips, others = [], selected }: SharedView): string {
  const given = (of: object | undefined) => of !== undefined && Object.keys(of).length > 0;
  const text = [
    VERSION,
    ...(camera ? [`c${cameraText(camera)}`] : []),
    ...(given(style) ? [`s${asText(style)}`] : []),
    ...(given(filter) ? [`f${asText(filter)}`] : []),
    ...(given(clips) ? [`k${asText(clips)}`] : []),
    ...(others.some(({ style: one, filter: two }) => given(one) || given(two))
      ? [
          `o${asText(others.slice(0, MOST_OTHERS).map(({ style: one, filter: two }) => [one ?? {}, two ?? {}]))}`,
        ]
      : []),
    ...(selected ? [`p${selected.node}_${selected.index}`] : []),
  ].join(BETWEEN);
  if (text.length <= LONGEST) return text;
  throw new LinkError({
    code: "LINK_LONG",
    file: "link",
    cause: `it would have ${text.length} characters, of which ${LONGEST} are read`,
    fix: "leave the volumes out, or give them fewer corners",
  });
}

/**
 * Reads what {@link writePermalink} wrote. Style and filter are held against the data set when a layer is given them, which
 * refuses by name what it does not know.
 *
 * @throws LinkError LINK_VERSION for another version, LINK_PART for a part that is not known, LINK_BROKEN for one that cannot
 *   be read; StyleError STYLE_CLIP for a volume that is none
 */
export function readPermalink(text: string): SharedView {
  const [version, ...parts] = text.slice(0, LONGEST + 1).split(BETWEEN);
  if (text.length > LONGEST) throw broken("the whole", "it is longer than any link");
  if (version !== VERSION) {
    throw new LinkError({
      code: "LINK_VERSION",
      file: "link",
      cause: `it has version ${JSON.stringify(version?.slice(0, 20))}; this program reads version ${VERSION}`,
      fix: "open it with the version of the program that wrote it, or copy the link again",
    });
  }
  const view = new Map<keyof SharedView, unknown>();
  for (const part of parts) {
    const name = PARTS.get(part.slice(0, 1));
    if (!name) {
      throw new LinkError({
        code: "LINK_PART",
        file: "link",
        cause: `it has a part ${JSON.stringify(part.slice(0, 20))} that this program does not know`,
        fix: "open it with a later version of the program, or take the part out",
      });
    }
    if (view.has(name)) throw broken(name, "it is there twice");
    view.set(name, read(name, part.slice(1)));
  }
  return Object.fromEntries(view) as SharedView;
}

/** What a link keeps of a layer. */
export interface ViewedLayer {
  readonly style: PointCloudStyle;
  readonly filter: PointFilter | undefined;
  readonly clips: Iterable<Clip>;
  readonly cloud: Parameters<typeof defaultStyle>[0];
}

/** How a layer is drawn, to be kept in a link: of the style what differs from the one by default. */
export function layerView({ style, filter, clips, cloud }: ViewedLayer): SharedView {
  const changed = changes(style, defaultStyle(cloud)) as StyleParts | undefined;
  return { ...(changed && { style: changed }), ...(filter && { filter }), clips: [...clips] };
}

/** What of a value differs from another one: objects in parts, all else whole. */
function changes(value: unknown, from: unknown): unknown {
  if (!isObject(value) || !isObject(from)) {
    return JSON.stringify(value) === JSON.stringify(from) ? undefined : value;
  }
  const parts = Object.entries(value).flatMap(([name, one]) => {
    const part = changes(one, Object.hasOwn(from, name) ? from[name] : undefined);
    return part === undefined ? [] : [[name, part] as const];
  });
  return parts.length > 0 ? Object.fromEntries(parts) : undefined;
}

function read(name: keyof SharedView, text: string): SharedView[keyof SharedView] {
  if (name === "camera") return cameraOf(text);
  if (name === "selected") return selectedOf(text);
  let value: unknown;
  try {
    value = fromText(text);
  } catch {
    throw broken(name, "its text is damaged");
  }
  if (name === "clips") {
    if (!Array.isArray(value)) throw broken(name, "it is no list of volumes");
    for (const clip of value) checkClip(clip);
    return value;
  }
  if (name === "others") return othersOf(value);
  if (!isObject(value)) throw broken(name, "it is no object");
  return value;
}

function othersOf(value: unknown): DrawnCloud[] {
  if (!Array.isArray(value) || value.length > MOST_OTHERS) throw broken("others", "it is no list of clouds");
  return value.map((one: unknown) => {
    if (!Array.isArray(one) || one.length !== 2 || !one.every(isObject)) {
      throw broken("others", "a cloud of it is no style with a filter");
    }
    const [style, filter] = one.map((part) => (Object.keys(part).length > 0 ? part : undefined));
    return { ...(style && { style }), ...(filter && { filter }) };
  });
}

function cameraText(camera: CameraView): string {
  return CAMERA_VIEW.map((name, at) => {
    const number = name === "height" ? camera[name] : camera[name] / DEGREE;
    return String(Number(number.toFixed(DECIMALS[at])));
  }).join("_");
}

function cameraOf(text: string): CameraView {
  const numbers = text.split("_").map((part) => (part === "" ? Number.NaN : Number(part)));
  const [longitude, latitude, height, heading, pitch, roll] = numbers;
  const camera = {
    ...{ longitude: longitude * DEGREE, latitude: latitude * DEGREE, height },
    ...{ heading: heading * DEGREE, pitch: pitch * DEGREE, roll: roll * DEGREE },
  };
  if (numbers.length === CAMERA_VIEW.length && isCameraView(camera)) return camera;
  throw broken("camera", `it is not the six numbers ${CAMERA_VIEW.join(", ")} of a camera`);
}

function selectedOf(text: string): NonNullable<SharedView["selected"]> {
  const found = /^(\d+-\d+-\d+-\d+)_(\d{1,15})$/.exec(text);
  if (!found) throw broken("selected", "it is no node with the index of a record");
  return { node: found[1], index: Number(found[2]) };
}

function broken(part: string, cause: string): LinkError {
  return new LinkError({
    code: "LINK_BROKEN",
    file: "link",
    cause: `its part ${part} cannot be read: ${cause}`,
    fix: "copy the link again, whole",
  });
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}
