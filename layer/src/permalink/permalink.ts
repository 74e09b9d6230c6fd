import { CAMERA_VIEW, type CameraView, isCameraView } from "../camera/index.js";
import { type Clip, checkClip } from "../clips/index.js";
import { defaultStyle, type PointCloudStyle, type PointFilter, type StyleParts } from "../effects/index.js";
import { LinkError } from "../errors/index.js";
import { asText, fromText } from "./json-text.js";
import { profileOf, type SharedProfile } from "./shared-profile.js";

/** How a cloud is drawn; all of it may be left out. */
export interface DrawnCloud {
  /** What differs from the style by default: see {@link layerView}. */
  readonly style?: StyleParts | undefined;
  readonly filter?: PointFilter | undefined;
  /** Whether it is drawn at all; by default it is. */
  readonly show?: boolean | undefined;
  /** How far it is drawn above its place, metres; by default 0. */
  readonly heightOffset?: number | undefined;
}

/** What a link keeps of a view, with how its first cloud is drawn; all of it may be left out. */
export interface SharedView extends DrawnCloud {
  readonly camera?: CameraView | undefined;
  readonly clips?: readonly Clip[] | undefined;
  /** How further clouds are drawn, in the order in which an application names them beside the link; at most 100. */
  readonly others?: readonly DrawnCloud[] | undefined;
  /** A record that is selected: its node, `depth-x-y-z`, and its index there. */
  readonly selected?: { readonly node: string; readonly index: number } | undefined;
  /** The line whose profile is shown. */
  readonly profile?: SharedProfile | undefined;
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

/** Names of the parts; the display is whether a cloud is drawn, and how far above its place. */
type PartName = Exclude<keyof SharedView, keyof Display> | "display";
type Display = Pick<DrawnCloud, "show" | "heightOffset">;

/** What each part of a link is, by its first letter. */
const PARTS: ReadonlyMap<string, PartName> = new Map([
  ["c", "camera"],
  ["s", "style"],
  ["f", "filter"],
  ["d", "display"],
  ["k", "clips"],
  ["o", "others"],
  ["p", "selected"],
  ["l", "profile"],
]);

/**
 * A view as short text for the address of a page: `1~c8.5412345_47.3712345_1200_30_-45_0~p2-0-1-0_153`. What is left out
 * is left out of the text too.
 *
 * @throws LinkError LINK_LONG for a view that no address can hold: volumes or a line of many thousand corners
 */
export function writePermalink(view: SharedView): string {
  const { camera, style, filter, clips, others = [], selected, profile } = view;
  const display = displayOf(view);
  const further = others.slice(0, MOST_OTHERS).map((one) => {
    const shown = displayOf(one);
    return [one.style ?? {}, one.filter ?? {}, ...(given(shown) ? [shown] : [])];
  });
  const text = [
    VERSION,
    ...(camera ? [`c${cameraText(camera)}`] : []),
    ...(given(style) ? [`s${asText(style)}`] : []),
    ...(given(filter) ? [`f${asText(filter)}`] : []),
    ...(given(display) ? [`d${asText(display)}`] : []),
    ...(given(clips) ? [`k${asText(clips)}`] : []),
    ...(further.some((parts) => parts.some(given)) ? [`o${asText(further)}`] : []),
    ...(selected ? [`p${selected.node}_${selected.index}`] : []),
    ...(profile ? [`l${asText(profile)}`] : []),
  ].join(BETWEEN);
  if (text.length <= LONGEST) return text;
  throw new LinkError({
    code: "LINK_LONG",
    file: "link",
    cause: `it would have ${text.length} characters, of which ${LONGEST} are read`,
    fix: "leave the volumes and the profile's line out, or give them fewer corners",
  });
}

function given(of: object | undefined): boolean {
  return of !== undefined && Object.keys(of).length > 0;
}

/** What differs from how clouds are drawn by default. */
function displayOf({ show, heightOffset }: Display): Display {
  return { ...(show === false && { show }), ...(heightOffset && { heightOffset }) };
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
  const view = new Map<PartName, unknown>();
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
  const { display, ...others } = Object.fromEntries(view);
  return { ...others, ...(display as Display | undefined) };
}

/** What a link keeps of a layer. */
export interface ViewedLayer extends Display {
  readonly style: PointCloudStyle;
  readonly filter: PointFilter | undefined;
  readonly clips: Iterable<Clip>;
  readonly cloud: Parameters<typeof defaultStyle>[0];
}

/** How a layer is drawn, to be kept in a link: of the style what differs from the one by default. */
export function layerView(layer: ViewedLayer): SharedView {
  const { style, filter, clips, cloud } = layer;
  const changed = changes(style, defaultStyle(cloud)) as StyleParts | undefined;
  return {
    ...(changed && { style: changed }),
    ...(filter && { filter }),
    ...displayOf(layer),
    clips: [...clips],
  };
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

function read(name: PartName, text: string): unknown {
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
  if (name === "display") return checkedDisplay(value, name);
  if (name !== "profile") return value;
  const profile = profileOf(value);
  if (!profile) throw broken(name, "it is no line with a width and a start");
  return profile;
}

/** @param part that it stands in */
function checkedDisplay({ show, heightOffset, ...more }: Record<string, unknown>, part: string): Display {
  const known = Object.keys(more).length === 0;
  const shown = show === undefined || typeof show === "boolean";
  const raised = heightOffset === undefined || Number.isFinite(heightOffset);
  if (!known || !shown || !raised) throw broken(part, "it is no display of a cloud");
  return displayOf({ show, heightOffset: heightOffset as number | undefined });
}

function othersOf(value: unknown): DrawnCloud[] {
  if (!Array.isArray(value) || value.length > MOST_OTHERS) throw broken("others", "it is no list of clouds");
  return value.map((one: unknown) => {
    if (!Array.isArray(one) || one.length < 2 || one.length > 3 || !one.every(isObject)) {
      throw broken("others", "a cloud of it is no style with a filter");
    }
    const [style, filter, display = {}] = one as [object, object, Record<string, unknown>?];
    return {
      ...(given(style) && { style }),
      ...(given(filter) && { filter }),
      ...checkedDisplay(display, "others"),
    };
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
