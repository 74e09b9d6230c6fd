import { geodeticToEcef } from "@groma/georef";
import { measureView, type PointCloudLayer, type SharedProfile } from "@groma/layer/cesium";
import {
  type Measurement,
  type MeasurementChange,
  MeasureTool,
  measurementsToGeoJson,
  readMeasurements,
  type StationEquations,
  type Vertex,
  type ViewAdapter,
} from "@groma/layer/tools";
import type { Viewer } from "cesium";
import { i18n } from "../language/i18n.js";
import { MEASURE_WORDS, unitsOf } from "../panel/measure-words.js";
import { PageError } from "../panel/page-error.js";
import { readLines } from "./line-file.js";
import { type LineSettings, samePlaces, settingsIn, stationsOn } from "./line-settings.js";

/** A line on the globe: longitude and latitude of each vertex, radians. */
export type DrawnLine = readonly (readonly [number, number])[];

/** Where the browser keeps the lines of a cloud between visits, by its identity. */
const KEY = "groma-profiles:";

/** No lines are kept. */
const NOTHING = { text: null, ids: new Set<string>() };

/**
 * The lines of profiles: drawn and changed on globe and map, by pointer, touch or keyboard, as measured polylines are; named,
 * reversed, kept in the browser with the records that their vertices stand on, their widths and where their chainage starts.
 */
export class ProfileLines {
  readonly tool: MeasureTool;
  readonly #layer: () => PointCloudLayer | undefined;
  readonly #changed: () => void;
  readonly #failed: (thrown: unknown) => void;
  /** Vertices that the picture was told of. */
  #told = "";
  #chosen: string | undefined;
  /** By the ids of lines, those too that were removed and may come back. */
  #settings = new Map<string, LineSettings>();
  /** Identity of the cloud whose lines these are: several scans may have one name. */
  #cloud: string | undefined;
  /** Whether the browser keeps them; false where it cannot, or has some that this program cannot read. */
  #keeps = true;
  /** What this page has kept or taken over last, and the ids of the lines in it: others are another page's. */
  #kept: { readonly text: string | null; readonly ids: ReadonlySet<string> } = NOTHING;

  /**
   * @param changed hears of another line, and of each change of it
   * @param failed hears why a point could not be read
   */
  constructor(
    { scene }: Viewer,
    layer: () => PointCloudLayer | undefined,
    changed: () => void,
    failed: (thrown: unknown) => void,
  ) {
    this.#layer = layer;
    this.#changed = changed;
    this.#failed = failed;
    const layers = () => [layer()].flatMap((one) => one ?? []);
    this.tool = new MeasureTool(measureView(scene, layers), {
      onError: failed,
      units: unitsOf([]),
      words: { ...MEASURE_WORDS, measurements: i18n.t("Lines of profiles") },
    });
    this.tool.onChange(() => this.#follow());
    addEventListener("storage", ({ key }) => {
      if (this.#isKept && key === KEY + this.#cloud) this.#attempt(() => this.#takeOver());
    });
  }

  /** Lets lines be drawn on a further view. */
  addView(view: ViewAdapter): void {
    this.tool.addView(view);
  }

  get all(): readonly Measurement[] {
    return this.tool.measurements;
  }

  /** The line whose profile is shown, once it is finished. */
  get chosen(): Measurement | undefined {
    return this.all.find(({ id }) => id === this.#chosen);
  }

  get drawing(): boolean {
    return this.tool.drawing !== undefined;
  }

  /** Vertices of the line that is drawn, else of the one that is shown. */
  get vertices(): readonly Vertex[] {
    return this.drawing ? this.tool.drawnVertices : (this.chosen?.vertices ?? []);
  }

  get line(): DrawnLine {
    return placesOf(this.vertices);
  }

  /** Stations of the line that is shown, metres; undefined: its chainages. */
  get stations(): StationEquations | undefined {
    return this.settings && stationsOn(this.settings, this.line);
  }

  /** Takes over the lines that were kept of a cloud, with their records. */
  attach(layer: PointCloudLayer): void {
    const { cloud } = layer;
    if (this.#cloud === cloud.identity) {
      this.tool.attach([cloud]);
      return;
    }
    this.leave();
    this.#cloud = cloud.identity;
    this.#keeps = true;
    this.#settings = new Map();
    this.#kept = NOTHING;
    this.#attempt(() => this.#takeOver());
  }

  /** Has the reader draw a line, which is then chosen. */
  async draw(): Promise<void> {
    this.#chosen = undefined;
    const drawn = await this.tool.polyline();
    if (drawn) this.choose(drawn.id);
  }

  /** Ends the line that is drawn, or gives it up where it has too few vertices. */
  finish(): void {
    if (!this.tool.finish()) this.tool.cancel();
  }

  /** Shows a line, and lets its vertices be moved; undefined: none. */
  choose(id: string | undefined): void {
    this.#chosen = id;
    this.tool.edit(id);
    this.#follow();
  }

  /**
   * Takes the lines of a file over, of which the last is chosen.
   * @param width of their strips, metres
   * @throws as `readLines`
   */
  async open(file: File, width: number): Promise<void> {
    const layer = this.#layer();
    if (!layer) return;
    const lines = (await readLines(file, layer.cloud)).map((line) => ({ id: crypto.randomUUID(), ...line }));
    for (const { id, start, equations, vertices } of lines) {
      const stationing = { vertices: placesOf(vertices), equations };
      this.#settings.set(id, { width, start, stationing });
    }
    this.tool.add(lines.map(({ id, name, vertices }) => ({ id, kind: "polyline", name, vertices })));
    if (lines.length > 0) this.choose(this.all.at(-1)?.id);
  }

  /** The line that is shown, as a link brings it back; undefined: none is. */
  get shared(): SharedProfile | undefined {
    const { chosen, settings } = this;
    if (!chosen || !settings) return undefined;
    const { width, start, stationing } = settings;
    const line = chosen.vertices.map(
      ({ longitude, latitude, height }) => [longitude, latitude, height] as const,
    );
    // A line that was changed since has other stations than those that it came with.
    const equations = this.stations && stationing?.equations;
    return { name: chosen.name, line, width, start, ...(equations && { equations }) };
  }

  /** Shows the line of a link: the one that is there already, where it has the same vertices. */
  showShared({ name, line, width, start, equations = [] }: SharedProfile): void {
    const places = line.map(([longitude, latitude]) => [longitude, latitude] as const);
    const there = this.all.find(({ vertices }) => samePlaces(placesOf(vertices), places));
    const id = there?.id ?? crypto.randomUUID();
    this.#settings.set(id, { width, start, stationing: { vertices: places, equations } });
    if (!there) {
      const vertices = line.map(([longitude, latitude, height]): Vertex => {
        const ecef = new Float64Array(3);
        geodeticToEcef(longitude, latitude, height, ecef);
        return { longitude, latitude, height, ecef: [ecef[0]!, ecef[1]!, ecef[2]!] };
      });
      this.tool.add([{ id, kind: "polyline", name, vertices }]);
    }
    this.choose(id);
  }

  /** Of the line that is shown; undefined where it has none yet. */
  get settings(): LineSettings | undefined {
    return this.#chosen === undefined ? undefined : this.#settings.get(this.#chosen);
  }

  /** Gives the line that is shown its settings, which are kept. */
  settle(settings: Omit<LineSettings, "stationing">): void {
    if (this.#chosen === undefined) return;
    this.#settings.set(this.#chosen, { ...this.settings, ...settings });
    this.#keep();
  }

  rename(name: string): void {
    this.#change(() => ({ name }));
  }

  /** Turns the line round: chainage begins at its other end. */
  reverse(): void {
    this.#change(({ vertices }) => ({ vertices: vertices.toReversed() }));
  }

  remove(): void {
    const { chosen } = this;
    if (!chosen) return;
    this.#chosen = undefined;
    this.tool.remove(chosen.id);
  }

  /** Takes all lines off the views; those that are kept stay where they are. */
  leave(): void {
    this.#cloud = undefined;
    this.choose(undefined);
    for (const { id } of [...this.all]) this.tool.remove(id);
  }

  #change(change: (line: Measurement) => MeasurementChange): void {
    const { chosen } = this;
    if (chosen) this.tool.change(chosen.id, change(chosen));
  }

  #follow(): void {
    this.#keep();
    // A line that is clicked on globe or map is the one that is shown.
    this.#chosen = this.tool.edited?.id ?? this.#chosen;
    const now = JSON.stringify([this.#chosen, this.drawing, this.line, this.chosen?.name, this.all.length]);
    if (now === this.#told) return;
    this.#told = now;
    this.#changed();
  }

  /** Whether changes of the lines go into the browser's storage. */
  get #isKept(): boolean {
    return this.#keeps && this.#cloud !== undefined && this.#layer()?.cloud.identity === this.#cloud;
  }

  #keep(): void {
    if (!this.#isKept) return;
    const key = KEY + this.#cloud;
    this.#attempt(() => {
      this.#takeOver();
      const lines = { ...measurementsToGeoJson(this.all), profiles: this.#settingsOfAll() };
      const text = this.all.length === 0 ? null : JSON.stringify(lines);
      if (text === this.#kept.text) return;
      if (text === null) localStorage.removeItem(key);
      else localStorage.setItem(key, text);
      this.#kept = { text, ids: new Set(this.all.map(({ id }) => id)) };
    });
  }

  /**
   * Brings in what is kept of the cloud: its lines at first; later those that another page has added or removed meanwhile, which
   * would be lost by keeping one's own.
   */
  #takeOver(): void {
    const text = localStorage.getItem(KEY + this.#cloud);
    const { text: last, ids: known } = this.#kept;
    const cloud = this.#layer()?.cloud;
    if (text === last || !cloud) return;
    const { measurements } =
      text === null ? { measurements: [] } : readMeasurements(text, [cloud], cloud.name);
    const ids = new Set(measurements.map(({ id }) => id));
    for (const [id, settings] of text === null ? [] : settingsIn(text)) {
      if (!this.#settings.has(id)) this.#settings.set(id, settings);
    }
    this.#kept = { text, ids };
    const own = new Set(this.all.map(({ id }) => id));
    for (const id of known) if (own.has(id) && !ids.has(id)) this.tool.remove(id);
    const fresh = measurements.filter(({ id }) => !own.has(id) && !known.has(id));
    if (fresh.length > 0) this.tool.add(fresh);
  }

  #attempt(work: () => void): void {
    try {
      work();
    } catch (thrown) {
      this.#keepsNone(thrown);
    }
  }

  /** Settings of the lines that there are, by their ids. */
  #settingsOfAll(): Record<string, LineSettings> {
    return Object.fromEntries([...this.#settings].filter(([id]) => this.all.some((line) => line.id === id)));
  }

  /** Tells once why lines are not kept; those that were stay as they are. */
  #keepsNone(thrown: unknown): void {
    this.#keeps = false;
    const refused = thrown instanceof DOMException;
    this.#failed(refused ? unkept(thrown) : thrown);
  }
}

function placesOf(vertices: readonly Vertex[]): DrawnLine {
  return vertices.map(({ longitude, latitude }) => [longitude, latitude]);
}

function unkept({ message }: DOMException): PageError {
  return new PageError({
    ...{ code: "PAGE_STORAGE", file: i18n.t("Profiles") },
    cause: i18n.t("the browser does not keep them for the next visit ({reason})", { reason: message }),
    fix: i18n.t("Export those that are needed, and allow this site to store data or free some"),
  });
}
