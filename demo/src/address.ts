import { i18n } from "./language/i18n.js";
import { PageError } from "./panel/page-error.js";

/** What the page's own address asks for. */
export interface PageOptions {
  /** Absolute `http:` or `https:` address of the cloud. */
  readonly cloud?: string;
  /** Most points drawn at once. */
  readonly budget?: number;
  /** Point size, CSS pixels. */
  readonly size?: number;
  /** What the colours show: `rgb`, `levelOfDetail`, or the name of an attribute. */
  readonly color?: string;
  /** Coordinate system of the cloud, in place of what the file says. */
  readonly crs?: string;
  /** Height reference of the cloud: `EPSG:5728` or `ellipsoidal`. */
  readonly vertical?: string;
  /** Absolute address of the georeference that `groma georef` made for the cloud. */
  readonly georef?: string;
  /** Absolute address of a terrain of Cesium's, the folder with its `layer.json`. */
  readonly terrain?: string;
  /** Whether the camera flies to the cloud rather than being there at once. */
  readonly fly: boolean;
  /** What is shown from the beginning, where it is not the globe alone. */
  readonly shown?: "both" | "map";
  /** Whether map and globe move together, where that is given. */
  readonly linked?: boolean;
}

const MOST_POINTS = 100_000_000;

/**
 * Reads the query of the page's address: `cloud`, `budget`, `size`, `color`, `crs`, `vertical`, `georef`, `terrain`,
 * `fly`, `map`, `link`. Others are left alone.
 * @param page the page's whole address
 * @throws PageError PAGE_ADDRESS, PAGE_OPTION
 */
export function readPageOptions(page: string): PageOptions {
  const query = new URL(page).searchParams;
  const cloud = query.get("cloud");
  const budget = number(query, "budget", { least: 1, most: MOST_POINTS, whole: true });
  const size = number(query, "size", { least: 1, most: 64, whole: false });
  const color = query.get("color");
  const crs = query.get("crs");
  const vertical = query.get("vertical");
  const georef = query.get("georef");
  const terrain = query.get("terrain");
  const map = word(query, "map", ["0", "1", "only"]) ?? "0";
  return {
    ...(cloud !== null && { cloud: cloudAddress(cloud, page) }),
    ...(budget !== undefined && { budget }),
    ...(size !== undefined && { size }),
    ...(color && { color }),
    ...(crs && { crs }),
    ...(vertical && { vertical }),
    ...(georef && { georef: cloudAddress(georef, page) }),
    ...(terrain && { terrain: cloudAddress(terrain, page) }),
    ...(map !== "0" && { shown: map === "1" ? "both" : "map" }),
    ...(word(query, "link", ["0", "1"]) === "0" && { linked: false }),
    fly: word(query, "fly", ["0", "1"]) !== "0",
  };
}

/**
 * The absolute address of a cloud that was named relative to the page or by `http:` or `https:`.
 * @throws PageError PAGE_ADDRESS for anything else: a script, a file of the reader's disk, data, a login
 */
export function cloudAddress(text: string, page: string): string {
  const trimmed = text.trim();
  if (trimmed === "") throw badAddress(i18n.t("the address"), i18n.t("it is empty"));
  let address: URL;
  try {
    address = new URL(trimmed, page);
  } catch {
    throw badAddress(trimmed, i18n.t("this is not a valid address"));
  }
  const { protocol, username, password } = address;
  if (protocol !== "http:" && protocol !== "https:") {
    throw badAddress(trimmed, i18n.t("addresses that begin with {protocol} are not supported", { protocol }));
  }
  if (username || password)
    throw badAddress(`${address.host}…`, i18n.t("the address contains a user name or password"));
  return address.href;
}

function badAddress(file: string, cause: string): PageError {
  return new PageError({
    code: "PAGE_ADDRESS",
    file: file.length > 120 ? `${file.slice(0, 119)}…` : file,
    cause,
    fix: i18n.t(
      "Give a path on this server or an http(s) address; open files of this computer with Choose a file",
    ),
  });
}

function number(
  query: URLSearchParams,
  name: string,
  { least, most, whole }: { least: number; most: number; whole: boolean },
): number | undefined {
  const text = query.get(name);
  if (text === null) return undefined;
  const value = (whole ? /^\d+$/ : /^\d+(\.\d+)?$/).test(text) ? Number(text) : Number.NaN;
  if (value >= least && value <= most) return value;
  throw badOption(
    name,
    text,
    whole
      ? i18n.t("Give a whole number from {least} to {most}", { least, most })
      : i18n.t("Give a number from {least} to {most}", { least, most }),
  );
}

function word<Word extends string>(
  query: URLSearchParams,
  name: string,
  words: readonly Word[],
): Word | undefined {
  const text = query.get(name);
  if (text === null) return undefined;
  const found = words.find((each) => each === text);
  if (found) return found;
  throw badOption(name, text, i18n.t("Give one of {words}", { words: words.join(", ") }));
}

function badOption(name: string, text: string, fix: string): PageError {
  return new PageError({
    code: "PAGE_OPTION",
    file: i18n.t("the option {name} of the page's address", { name }),
    cause:
      text === ""
        ? i18n.t("it is empty")
        : i18n.t("“{text}” is not a valid value", { text: text.slice(0, 60) }),
    fix,
  });
}
