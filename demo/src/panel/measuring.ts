import type { PointCloud, PointCloudLayer } from "@groma/layer/cesium";
import { cameraView, measureView, terrainOf } from "@groma/layer/cesium";
import {
  MEASUREMENT_KINDS,
  MeasureControl,
  type Measurement,
  type MeasurementKind,
  MeasureTool,
  type MeasureUnitsOptions,
  measurementsToGeoJson,
  readMeasurements,
  type SaveOptions,
  valuesToCsv,
} from "@groma/layer/tools";
import type { Viewer } from "cesium";
import { i18n } from "../language/i18n.js";
import { noteWords } from "../language/note-words.js";
import { AnnotationList } from "./annotation-list.js";
import { Compared } from "./compared.js";
import { byId, optionElement, textElement } from "./elements.js";
import { MEASURE_WORDS, unitsOf } from "./measure-words.js";
import { MeasurementList } from "./measurement-list.js";
import { download } from "./save-file.js";

/** Units that go together, by what the reader chooses. */
const SYSTEMS = new Map<string, MeasureUnitsOptions>([
  [i18n.t("metres"), {}],
  [i18n.t("kilometres, hectares"), { length: "kilometres", area: "hectares" }],
  [i18n.t("feet"), { length: "feet", area: "squareFeet", volume: "cubicFeet" }],
  [i18n.t("feet, acres, cubic yards"), { length: "feet", area: "acres", volume: "cubicYards" }],
  [
    i18n.t("US survey feet"),
    { length: "usSurveyFeet", area: "squareUsSurveyFeet", volume: "cubicUsSurveyFeet" },
  ],
  [i18n.t("yards"), { length: "yards", area: "squareYards", volume: "cubicYards" }],
  [i18n.t("miles"), { length: "miles", area: "squareMiles", volume: "acreFeet" }],
  [i18n.t("nautical miles"), { length: "nauticalMiles" }],
]);

const SLOPES = new Map<string, MeasureUnitsOptions>([
  [i18n.t("degrees"), {}],
  [i18n.t("percent"), { slope: "percent" }],
  [i18n.t("ratio, as 1 : 20"), { slope: "ratio" }],
  [i18n.t("grade, rise over run"), { slope: "grade" }],
]);

const ANGLES = new Map<string, MeasureUnitsOptions>([
  [i18n.t("degrees"), {}],
  [i18n.t("degrees, minutes, seconds"), { angle: "dms", coordinates: "dms" }],
  [i18n.t("gon"), { angle: "gon" }],
]);

/** Elements of the page that lie over globe and map. */
const COVERING = ["panel", "picked", "profile"];

const HINT = i18n.t(
  "Click points, or move the crosshair with the arrow keys and press Enter. Twice in one place ends; Escape gives up.",
);

const PLACE_HINT = i18n.t(
  "Click the point that it belongs to, or move the crosshair with the arrow keys and press Enter.",
);

/** The tool bar of measuring, and the lists of what was measured and said. */
export class Measuring {
  readonly tool: MeasureTool;
  readonly #layers: () => readonly PointCloudLayer[];
  readonly #told: (thrown: unknown) => void;
  readonly #list: MeasurementList;
  readonly #annotations: AnnotationList;
  readonly #compared: Compared;
  /** What has to be known of the file that was opened last. */
  readonly #notes = byId("measure-notes", HTMLParagraphElement);

  /**
   * @param layers what is measured, the chosen one first
   * @param fly takes the camera to a measurement
   * @param told hears of what could not be read
   * @param address of a cloud, by what the reader typed; throws where that is none
   */
  constructor(
    viewer: Viewer,
    layers: () => readonly PointCloudLayer[],
    fly: (measurement: Measurement) => void,
    told: (thrown: unknown) => void,
    address: (text: string) => string,
  ) {
    this.#layers = layers;
    this.#told = told;
    this.tool = new MeasureTool(measureView(viewer.scene, layers), {
      units: unitsOf([]),
      words: MEASURE_WORDS,
      terrain: terrainOf(() => viewer.terrainProvider),
      onError: told,
      covering: () => COVERING.map((id) => byId(id, HTMLElement)),
    });
    this.#compared = new Compared(address, () => this.attach(), told);
    this.#list = new MeasurementList(this.tool, () => this.#others, fly);
    this.#annotations = new AnnotationList(this.tool, fly, () => cameraView(viewer.camera));
    this.tool.onChange(() => this.#show());
    const kinds = (Object.keys(MEASUREMENT_KINDS) as MeasurementKind[]).filter(
      (kind) => kind !== "annotation",
    );
    byId("measure-tools", HTMLDivElement).append(new MeasureControl(this.tool, { kinds }).element);
    this.#connectFields();
    this.#connectFiles();
    this.#show();
  }

  /** What is to be done while something is drawn; empty while nothing is. */
  get hint(): string {
    const { drawing } = this.tool;
    if (drawing === undefined) return "";
    return drawing === "annotation" ? PLACE_HINT : HINT;
  }

  /** Puts vertices on the clouds that are shown, and lets volumes be measured against them and those opened beside them. */
  attach(): void {
    this.tool.attach(this.#clouds);
  }

  get #clouds(): readonly PointCloud[] {
    return [...this.#layers().map(({ cloud }) => cloud), ...this.#compared.clouds];
  }

  /** What volumes can be measured against: all but the chosen cloud. */
  get #others(): readonly PointCloud[] {
    const [, ...besides] = this.#layers();
    return [...besides.map(({ cloud }) => cloud), ...this.#compared.clouds];
  }

  #connectFields(): void {
    const choices = [
      ["measure-units", SYSTEMS],
      ["measure-slopes", SLOPES],
      ["measure-angles", ANGLES],
    ] as const;
    const fields = choices.map(([id, values]) => {
      const field = byId(id, HTMLSelectElement);
      for (const value of values.keys()) field.append(optionElement({ value, label: value }));
      return [field, values] as const;
    });
    for (const [field] of fields) {
      field.addEventListener("change", () => {
        const chosen = fields.map(([one, values]) => values.get(one.value));
        this.tool.units = unitsOf(chosen);
      });
    }
    const precision = byId("measure-precision", HTMLInputElement);
    precision.addEventListener("change", () => {
      const given = precision.value === "" ? undefined : precision.valueAsNumber / 1000;
      this.tool.worth = { precision: given !== undefined && given >= 0 ? given : undefined };
    });
  }

  #connectFiles(): void {
    byId("measure-save", HTMLButtonElement).addEventListener("click", () => {
      const document = measurementsToGeoJson(this.tool.measurements, this.#saving());
      const text = JSON.stringify(document, undefined, 1);
      download("measurements.geojson", new Blob([text], { type: "application/geo+json" }));
    });
    byId("measure-csv", HTMLButtonElement).addEventListener("click", () => {
      const text = valuesToCsv(this.tool.measurements, this.#saving());
      download("measurements.csv", new Blob([text], { type: "text/csv" }));
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
    const { measurements, notes } = readMeasurements(await file.text(), this.#clouds, file.name);
    this.tool.add(measurements);
    const read = i18n.t("{name}: {count, plural, one {# measurement} other {# measurements}} read", {
      name: file.name,
      count: measurements.length,
    });
    const remarks = notes.map((note) => {
      const { text, translated } = noteWords(note);
      const element = textElement("small", text);
      if (!translated) element.lang = "en";
      return element;
    });
    this.#notes.replaceChildren(textElement("span", read), ...remarks);
  }

  #show(): void {
    this.#list.show();
    this.#annotations.show();
  }
}
