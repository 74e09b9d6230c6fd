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
  type SaveOptions,
  valuesToCsv,
} from "@groma/layer/tools";
import type { Viewer } from "cesium";
import { byId, optionElement, setText, textElement } from "./elements.js";
import { MeasurementList } from "./measurement-list.js";

/** Units that go together, by what the reader chooses. */
const SYSTEMS = new Map<string, MeasureUnitsOptions>([
  ["metres", {}],
  ["feet", { length: "feet", area: "squareFeet" }],
  ["US survey feet", { length: "usSurveyFeet", area: "squareUsSurveyFeet" }],
]);

/** What the tool bar says while a figure is drawn. */
const HINT =
  "Click points, or move the crosshair with the arrow keys and press Enter. Twice in one place ends; Escape gives up.";

/** Elements of the page that lie over globe and map. */
const COVERING = ["panel", "picked", "profile"];

/** The tool bar of measuring, and the list of what was measured. */
export class Measuring {
  readonly tool: MeasureTool;
  readonly #layer: () => PointCloudLayer | undefined;
  readonly #told: (thrown: unknown) => void;
  readonly #buttons = new Map<MeasurementKind, HTMLButtonElement>();
  readonly #list: MeasurementList;
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
    this.#told = told;
    const layers = () => [layer()].flatMap((one) => one ?? []);
    this.tool = new MeasureTool(measureView(scene, layers), {
      onError: told,
      covering: () => COVERING.map((id) => byId(id, HTMLElement)),
    });
    this.#list = new MeasurementList(this.tool, fly);
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
      const document = measurementsToGeoJson(this.tool.measurements, this.#saving());
      download("measurements.geojson", "application/geo+json", JSON.stringify(document, undefined, 1));
    });
    byId("measure-csv", HTMLButtonElement).addEventListener("click", () => {
      download("measurements.csv", "text/csv", valuesToCsv(this.tool.measurements, this.#saving()));
    });
    const file = byId("measure-file", HTMLInputElement);
    file.addEventListener("change", () => {
      const [chosen] = file.files ?? [];
      file.value = "";
      if (chosen) this.#open(chosen).catch(this.#told);
    });
  }

  /** What was read of volumes is saved too. */
  #saving(): SaveOptions {
    return { ...this.tool.worth, valuesOf: (measurement) => this.tool.valuesOf(measurement) };
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
    this.#list.show();
  }
}

function download(name: string, type: string, text: string): void {
  const link = document.createElement("a");
  link.download = name;
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.click();
  URL.revokeObjectURL(link.href);
}
