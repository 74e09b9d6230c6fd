import type { PointCloudLayer } from "@groma/layer/cesium";
import { measureView } from "@groma/layer/cesium";
import {
  MEASUREMENT_KINDS,
  type Measurement,
  type MeasurementKind,
  MeasureTool,
  MeasureUnits,
  type MeasureUnitsOptions,
  measurementsToGeoJson,
  readMeasurements,
  valuesOf,
  valuesToCsv,
  wordsOf,
} from "@groma/layer/tools";
import type { Viewer } from "cesium";
import { byId, optionElement, setText, textElement } from "./elements.js";

/** Units that go together, by what the reader chooses. */
const SYSTEMS = new Map<string, MeasureUnitsOptions>([
  ["metres", {}],
  ["feet", { length: "feet", area: "squareFeet" }],
  ["US survey feet", { length: "usSurveyFeet", area: "squareUsSurveyFeet" }],
]);

/** What the tool bar says while a figure is drawn. */
const HINT =
  "Click points, or move the crosshair with the arrow keys and press Enter. Twice in one place ends; Escape gives up.";

/** The tool bar of measuring, and the list of what was measured. */
export class Measuring {
  readonly tool: MeasureTool;
  readonly #layer: () => PointCloudLayer | undefined;
  readonly #told: (thrown: unknown) => void;
  readonly #fly: (measurement: Measurement) => void;
  readonly #buttons = new Map<MeasurementKind, HTMLButtonElement>();
  readonly #list = byId("measurements", HTMLOListElement);
  readonly #hint = byId("measure-hint", HTMLParagraphElement);
  readonly #undo = byId("measure-undo", HTMLButtonElement);
  readonly #redo = byId("measure-redo", HTMLButtonElement);

  /**
   * @param layer what is measured
   * @param fly takes the camera to a measurement
   * @param told hears of what could not be read
   */
  constructor(
    { scene }: Viewer,
    layer: () => PointCloudLayer | undefined,
    fly: (measurement: Measurement) => void,
    told: (thrown: unknown) => void,
  ) {
    this.#layer = layer;
    this.#fly = fly;
    this.#told = told;
    const layers = () => [layer()].flatMap((one) => one ?? []);
    this.tool = new MeasureTool(measureView(scene, layers), { onError: told });
    this.tool.onChange(() => this.#show());
    this.#connectTools();
    this.#connectFields();
    this.#connectFiles();
    this.#show();
  }

  #connectTools(): void {
    const place = byId("measure-tools", HTMLDivElement);
    for (const [kind, { title }] of Object.entries(MEASUREMENT_KINDS)) {
      const button = textElement("button", title);
      button.type = "button";
      button.addEventListener("click", () => {
        if (this.tool.drawing === kind) this.tool.cancel();
        else this.tool.draw(kind as MeasurementKind).catch(this.#told);
      });
      this.#buttons.set(kind as MeasurementKind, button);
      place.append(button);
    }
    this.#undo.addEventListener("click", () => this.tool.undo());
    this.#redo.addEventListener("click", () => this.tool.redo());
  }

  #connectFields(): void {
    const system = byId("measure-units", HTMLSelectElement);
    for (const value of SYSTEMS.keys()) system.append(optionElement({ value, label: value }));
    system.addEventListener("change", () => {
      this.tool.units = new MeasureUnits(SYSTEMS.get(system.value));
    });
    const precision = byId("measure-precision", HTMLInputElement);
    precision.addEventListener("change", () => {
      const given = precision.value === "" ? undefined : precision.valueAsNumber / 1000;
      this.tool.worth = { precision: given !== undefined && given >= 0 ? given : undefined };
    });
  }

  #connectFiles(): void {
    byId("measure-save", HTMLButtonElement).addEventListener("click", () => {
      const document = measurementsToGeoJson(this.tool.measurements, this.tool.worth);
      download("measurements.geojson", "application/geo+json", JSON.stringify(document, undefined, 1));
    });
    byId("measure-csv", HTMLButtonElement).addEventListener("click", () => {
      download("measurements.csv", "text/csv", valuesToCsv(this.tool.measurements, this.tool.worth));
    });
    const file = byId("measure-file", HTMLInputElement);
    file.addEventListener("change", () => {
      const [chosen] = file.files ?? [];
      file.value = "";
      if (chosen) this.#open(chosen).catch(this.#told);
    });
  }

  async #open(file: File): Promise<void> {
    const clouds = [this.#layer()].flatMap((layer) => layer?.cloud ?? []);
    const { measurements, notes } = readMeasurements(await file.text(), clouds, file.name);
    this.tool.add(measurements);
    setText(this.#hint, notes.join("; "));
  }

  #show(): void {
    const { tool } = this;
    for (const [kind, button] of this.#buttons) {
      button.setAttribute("aria-pressed", String(tool.drawing === kind));
    }
    this.#undo.disabled = !tool.canUndo;
    this.#redo.disabled = !tool.canRedo;
    setText(this.#hint, tool.drawing ? HINT : "");
    this.#list.replaceChildren(...tool.measurements.map((measurement) => this.#entry(measurement)));
  }

  #entry(measurement: Measurement): HTMLLIElement {
    const { tool } = this;
    const { id, name } = measurement;
    const entry = document.createElement("li");
    const edited = tool.edited?.id === id;
    const head = document.createElement("div");
    head.className = "row";
    const show = textElement("button", name, "name");
    const edit = textElement("button", edited ? "Done" : "Edit");
    const remove = textElement("button", "Delete");
    edit.setAttribute("aria-label", `${edited ? "Done with" : "Edit"} ${name}`);
    remove.setAttribute("aria-label", `Delete ${name}`);
    show.addEventListener("click", () => this.#fly(measurement));
    edit.addEventListener("click", () => this.#keepingFocus(id, () => tool.edit(edited ? undefined : id)));
    remove.addEventListener("click", () => tool.remove(id));
    for (const button of [show, edit, remove]) button.type = "button";
    edit.dataset.edit = id;
    head.append(show, edit, remove);
    entry.append(head, this.#values(measurement));
    return entry;
  }

  #values(measurement: Measurement): HTMLElement {
    const facts = document.createElement("dl");
    facts.className = "facts";
    try {
      for (const value of valuesOf(measurement, this.tool.worth)) {
        const unknown = value.quantity.parts.flatMap(({ name, standard }) => (standard === null ? name : []));
        const text = textElement("dd", wordsOf(value, this.tool.units).text);
        if (unknown.length > 0) text.title = `unknown: ${unknown.join(", ")}`;
        facts.append(textElement("dt", value.title), text);
      }
    } catch (thrown) {
      facts.append(
        textElement("dt", "no value"),
        textElement("dd", thrown instanceof Error ? thrown.message : ""),
      );
    }
    return facts;
  }

  /** The list is made anew at each change: the button that was pressed is pressed again at its place. */
  #keepingFocus(id: string, change: () => void): void {
    change();
    this.#list.querySelector<HTMLElement>(`[data-edit="${CSS.escape(id)}"]`)?.focus();
  }
}

function download(name: string, type: string, text: string): void {
  const link = document.createElement("a");
  link.download = name;
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.click();
  URL.revokeObjectURL(link.href);
}
