import { i18n } from "./language/i18n.js";
import { PageError } from "./panel/page-error.js";

/** A cloud as the page's address names it. */
export interface NamedCloud {
  /** Absolute, `http:` or `https:`. */
  readonly address: string;
  /** Coordinate system, in place of what the file says. */
  readonly crs?: string | undefined;
  /** Height reference: `EPSG:5728` or `ellipsoidal`. */
  readonly vertical?: string | undefined;
  /** Absolute address of the georeference that `groma georef` made for the cloud. */
  readonly georef?: string | undefined;
}

/** What the page's own address asks for. */
export interface PageOptions {
  /** In their order; the first is the chosen one. */
  readonly clouds: readonly NamedCloud[];
  /** Most points drawn at once. */
  readonly budget?: number;
  /** Point size, CSS pixels. */
  readonly size?: number;
  /** What the colours show: `rgb`, `levelOfDetail`, or the name of an attribute. */
  readonly color?: string;
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
 * Reads the query of the page's address: `cloud` (each with `crs`, `vertical`, `georef`), `budget`, `size`, `color`,
 * `terrain`, `fly`, `map`, `link`. Others are left alone.
 * @param page the page's whole address
 * @throws PageError PAGE_ADDRESS, PAGE_OPTION
 */
export function readPageOptions(page: string): PageOptions {
  const query = new URL(page).searchParams;
  const budget = number(query, "budget", { least: 1, most: MOST_POINTS, whole: true });
  const size = number(query, "size", { least: 1, most: 64, whole: false });
  const color = query.get("color");
  const terrain = query.get("terrain");
  const map = word(query, "map", ["0", "1", "only"]) ?? "0";
  return {
    clouds: cloudsOf(query, page),
    ...(budget !== undefined && { budget }),
    ...(size !== undefined && { size }),
    ...(color && { color }),
    ...(terrain && { terrain: cloudAddress(terrain, page) }),
    ...(map !== "0" && { shown: map === "1" ? "both" : "map" }),
    ...(word(query, "link", ["0", "1"]) === "0" && { linked: false }),
    fly: word(query, "fly", ["0", "1"]) !== "0",
  };
}

/** Of the query, what is said of one cloud: of the one that is named before it, else of the first. */
const OF_A_CLOUD = ["crs", "vertical", "georef"];

function cloudsOf(query: URLSearchParams, page: string): NamedCloud[] {
  const clouds: Map<string, string>[] = [];
  const ahead = new Map<string, string>();
  for (const [name, value] of query) {
    if (name === "cloud") clouds.push(new Map([...(clouds.length === 0 ? ahead : []), [name, value]]));
    else if (OF_A_CLOUD.includes(name) && value) (clouds.at(-1) ?? ahead).set(name, value);
  }
  return clouds.map((said) => {
    const [crs, vertical, georef] = OF_A_CLOUD.map((name) => said.get(name));
    return {
      address: cloudAddress(said.get("cloud") ?? "", page),
      ...(crs && { crs }),
      ...(vertical && { vertical }),
      ...(georef && { georef: cloudAddress(georef, page) }),
    };
  });
}

/** Has an address of the page name clouds, in place of those that it names. */
export function nameClouds(page: URL, clouds: readonly NamedCloud[]): void {
  const { searchParams: query } = page;
  for (const name of ["cloud", ...OF_A_CLOUD]) query.delete(name);
  const short = (address: string) => {
    const { origin, pathname, search } = new URL(address);
    return origin === page.origin ? pathname + search : address;
  };
  for (const { address, crs, vertical, georef } of clouds) {
    const said = [
      ["cloud", short(address)],
      ["crs", crs],
      ["vertical", vertical],
      ["georef", georef && short(georef)],
    ] as const;
    for (const [name, value] of said) if (value) query.append(name, value);
  }
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
