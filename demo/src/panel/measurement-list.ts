import {
  type Measurement,
  type MeasureTool,
  type NamedValue,
  readsPoints,
  type Vertex,
  type VolumeSettings,
  wordsOf,
} from "@groma/layer/tools";
import { i18n } from "../language/i18n.js";
import { libraryWords } from "../language/library-words.js";
import { fixed, several } from "../language/numbers.js";
import { byId, optionElement, setText, textElement } from "./elements.js";
import { shortlyOf } from "./fault-words.js";
import { titleOf } from "./measure-words.js";

/** What a volume can be measured against, by what the reader chooses. */
const BASES = new Map<string, string>([
  ["lowest", i18n.t("its lowest vertex")],
  ["highest", i18n.t("its highest vertex")],
  ["plane", i18n.t("the plane through its vertices")],
  ["ring", i18n.t("triangles between its vertices")],
  ["height", i18n.t("a height")],
]);

/** Begins the choices that are scans; what their points are follows, or the name where that is not known. */
const CLOUD = "cloud:";

/** A scan that volumes are measured against. */
interface Scan {
  readonly name: string;
  readonly identity?: string | undefined;
}

/** ASPRS class of the ground. */
const GROUND = 2;

interface Entry {
  readonly measurement: Measurement;
  readonly element: HTMLLIElement;
  readonly edit: HTMLButtonElement;
  readonly read: HTMLButtonElement;
  readonly facts: HTMLDListElement;
  /** Fields of a volume. */
  readonly settings: Settings | undefined;
  /** What it shows: as long as that is the same, its words are. */
  shown: readonly unknown[];
}

interface Settings {
  readonly element: HTMLElement;
  /** Lets the volume be measured against further scans. */
  offer(scans: readonly Scan[]): void;
  fill(volume: VolumeSettings | undefined): void;
}

/** The list of what was measured, with values and what they are worth. */
export class MeasurementList {
  readonly #tool: MeasureTool;
  readonly #fly: (measurement: Measurement) => void;
  readonly #others: () => readonly Scan[];
  readonly #list = byId("measurements", HTMLOListElement);
  #entries: readonly Entry[] = [];

  /**
   * @param others scans that volumes can be measured against
   * @param fly takes the views to a measurement
   */
  constructor(tool: MeasureTool, others: () => readonly Scan[], fly: (measurement: Measurement) => void) {
    this.#tool = tool;
    this.#others = others;
    this.#fly = fly;
  }

  /** Shows what the tool has. Entries of what is the same are kept, and with them the reader's focus. */
  show(): void {
    const kept = new Map(this.#entries.map((entry) => [entry.measurement.id, entry]));
    const measured = this.#tool.measurements.filter(({ kind }) => kind !== "annotation");
    this.#entries = measured.map((measurement) => {
      const there = kept.get(measurement.id);
      const entry: Entry = there ? { ...there, measurement } : this.#entry(measurement);
      entry.settings?.offer(this.#others());
      // Not while it is read: who types a height is not disturbed.
      if (there?.measurement !== measurement) entry.settings?.fill(measurement.volume);
      const { units, worth } = this.#tool;
      const edited = this.#tool.edited?.id === measurement.id;
      const shown = [measurement, this.#tool.readingOf(measurement), units, worth, edited];
      if (shown.some((one, i) => one !== entry.shown[i])) this.#fill(entry);
      entry.shown = shown;
      return entry;
    });
    const wanted = this.#entries.map(({ element }) => element);
    const same =
      wanted.length === this.#list.children.length &&
      wanted.every((one, i) => one === this.#list.children[i]);
    if (!same) this.#list.replaceChildren(...wanted);
  }

  #of(id: string): Measurement | undefined {
    return this.#tool.measurements.find((one) => one.id === id);
  }

  #entry(measurement: Measurement): Entry {
    const tool = this.#tool;
    const { id, name } = measurement;
    const element = document.createElement("li");
    const head = document.createElement("div");
    head.className = "row";
    const show = textElement("button", name, "name");
    const read = textElement("button", i18n.t("Stop"));
    const edit = textElement("button", i18n.t("Edit"));
    const remove = textElement("button", i18n.t("Delete"));
    remove.setAttribute("aria-label", i18n.t("Delete {name}", { name }));
    const doing = (work: (one: Measurement) => void) => () => {
      const one = this.#of(id);
      if (one) work(one);
    };
    show.addEventListener("click", doing(this.#fly));
    edit.addEventListener("click", () => tool.edit(tool.edited?.id === id ? undefined : id));
    remove.addEventListener("click", () => tool.remove(id));
    read.addEventListener(
      "click",
      doing((one) =>
        tool.readingOf(one)?.state === "reading" ? tool.stopReading(one) : tool.readAgain(one),
      ),
    );
    for (const button of [show, read, edit, remove]) button.type = "button";
    head.append(show, read, edit, remove);
    const facts = document.createElement("dl");
    facts.className = "facts";
    const settings = measurement.kind === "volume" ? this.#settings(measurement) : undefined;
    element.append(head, ...(settings ? [settings.element] : []), facts);
    return { measurement, element, edit, read, facts, settings, shown: [] };
  }

  #fill({ measurement, edit, read, facts }: Entry): void {
    const { id, name, kind, vertices } = measurement;
    const edited = this.#tool.edited?.id === id;
    setText(edit, edited ? i18n.t("Done") : i18n.t("Edit"));
    edit.setAttribute(
      "aria-label",
      edited ? i18n.t("Done with {name}", { name }) : i18n.t("Edit {name}", { name }),
    );
    const reading = this.#tool.readingOf(measurement);
    read.hidden = !readsPoints(measurement) || reading?.state === "done";
    setText(read, reading?.state === "reading" ? i18n.t("Stop") : i18n.t("Measure again"));
    facts.replaceChildren();
    const fact = (title: string, text: string, note?: string) => {
      const told = textElement("dd", text);
      if (note) told.title = note;
      const term = textElement("dt", title);
      facts.append(term, told);
      return term;
    };
    if (reading?.state === "reading")
      fact(
        i18n.t("reading points"),
        i18n.number(Math.floor(100 * reading.share) / 100, { style: "percent" }),
      );
    if (reading?.state === "failed") fact(i18n.t("no value"), shortlyOf(reading.thrown));
    try {
      for (const one of this.#tool.valuesOf(measurement))
        fact(titleOf(one), this.#words(one), unknownOf(one));
      if (kind !== "point") return;
      for (const [title, text] of placesOf(vertices[0])) {
        const term = fact(title, text);
        // Registries have names of systems in English.
        if (title === vertices[0]?.cloud?.crs.name) term.lang = "en";
      }
    } catch (thrown) {
      fact(i18n.t("no value"), shortlyOf(thrown));
    }
  }

  #words(value: NamedValue): string {
    return wordsOf(value, this.#tool.units).text;
  }

  /** What a volume is measured against, and which points make its surface. */
  #settings({ id, name }: Measurement): Settings {
    const base = document.createElement("select");
    base.setAttribute("aria-label", i18n.t("{name} is measured against", { name }));
    for (const [value, label] of BASES) base.append(optionElement({ value, label }));
    const height = document.createElement("input");
    height.type = "number";
    height.step = "any";
    height.placeholder = i18n.t("metres");
    height.setAttribute("aria-label", i18n.t("Height that {name} is measured against, metres", { name }));
    const ground = document.createElement("input");
    ground.type = "checkbox";
    const only = document.createElement("label");
    only.className = "check";
    only.append(ground, textElement("span", i18n.t("ground points only")));
    const offered = new Map<string, Scan>();
    const changed = () => {
      height.hidden = base.value !== "height";
      const settings = settingsOf(
        offered.get(base.value) ?? base.value,
        height.valueAsNumber,
        ground.checked,
      );
      if (settings) this.#tool.change(id, { volume: settings });
    };
    for (const field of [base, height, ground]) field.addEventListener("change", changed);
    const element = document.createElement("div");
    element.className = "row";
    element.append(base, height, only);
    const offer = (scans: readonly Scan[]) => {
      for (const scan of scans) {
        const value = choiceOf(scan);
        if (offered.has(value)) continue;
        const namesakes = [...offered.values()].some(({ name }) => name === scan.name);
        offered.set(value, scan);
        const called = namesakes ? `${scan.name} (${scan.identity})` : scan.name;
        const label = i18n.t("the scan {name}", { name: called });
        base.append(optionElement({ value, label }));
      }
    };
    const fill = (volume: VolumeSettings | undefined) => {
      const against = volume?.base;
      // A scan that is not open is what the volume was measured against all the same.
      const scan = against?.kind === "cloud" && { name: against.dataset, identity: against.identity };
      if (scan) offer([scan]);
      base.value = scan ? choiceOf(scan) : (against?.kind ?? "lowest");
      height.hidden = base.value !== "height";
      if (volume?.base?.kind === "height") height.valueAsNumber = volume.base.height;
      ground.checked = volume?.classes?.length === 1 && volume.classes[0] === GROUND;
    };
    return { element, offer, fill };
  }
}

function choiceOf({ name, identity }: Scan): string {
  return CLOUD + (identity ?? name);
}

/** Undefined where a height is still to be given. */
function settingsOf(base: string | Scan, height: number, groundOnly: boolean): VolumeSettings | undefined {
  const classes = groundOnly ? { classes: [GROUND] } : {};
  if (base === "height") {
    return Number.isFinite(height) ? { base: { kind: "height", height }, ...classes } : undefined;
  }
  if (typeof base === "object") {
    const { name, identity } = base;
    return { base: { kind: "cloud", dataset: name, identity }, ...classes };
  }
  const kind = (["highest", "plane", "ring"] as const).find((one) => one === base) ?? "lowest";
  return { base: { kind }, ...classes };
}

/** A point in the frames that have no units to choose. */
function placesOf(vertex: Vertex | undefined): [title: string, text: string][] {
  if (!vertex) return [];
  const { source, cloud, record, ecef } = vertex;
  const decimals = (step: number) => Math.min(9, Math.max(0, Math.ceil(-Math.log10(step) - 1e-9)));
  return [
    ...(source && cloud
      ? [[cloud.crs.name, several(source.map((one, i) => fixed(one, decimals(cloud.scale[i] ?? 1))))]]
      : []),
    ["ECEF", several(ecef.map((one) => fixed(one, 4)))],
    [
      i18n.t("record"),
      record
        ? i18n.t("{index} of node {node}", { index: record.index, node: record.node })
        : i18n.t("none: a place"),
    ],
  ] as [string, string][];
}

/** What of a value nobody knows. */
function unknownOf({ quantity: { parts } }: NamedValue): string {
  const unknown = parts.flatMap(({ name, standard }) => (standard === null ? libraryWords(name) : []));
  return unknown.length > 0 ? i18n.t("unknown: {parts}", { parts: unknown.join(", ") }) : "";
}
