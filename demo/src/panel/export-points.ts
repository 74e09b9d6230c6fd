import type { PointCloudLayer } from "@groma/layer/cesium";
import { exportPoints, type PointFormat } from "@groma/layer/export";
import { byId, optionElement } from "./elements.js";
import { ExportJob } from "./export-job.js";

const FORMATS: ReadonlyMap<PointFormat, string> = new Map([
  ["las", "LAS"],
  ["laz", "LAZ"],
  ["csv", "CSV"],
  ["geojson", "GeoJSON"],
  ["dxf", "DXF"],
]);

/** Writes what is shown of the cloud, complete: what clips, the classes and the filter leave of it, at full density. */
export class ExportPoints {
  readonly #place = byId("export", HTMLElement);
  readonly #format = byId("export-format", HTMLSelectElement);
  readonly #job: ExportJob;
  #layer: PointCloudLayer | undefined;

  constructor(failed: (thrown: unknown) => void) {
    const button = byId("export-points", HTMLButtonElement);
    const status = byId("export-status", HTMLElement);
    for (const [value, label] of FORMATS) this.#format.append(optionElement({ value, label }));
    this.#job = new ExportJob(button, status, () => void this.#save(), failed);
  }

  attach(layer: PointCloudLayer): void {
    this.#job.cancel();
    this.#layer = layer;
    this.#place.hidden = false;
  }

  async #save(): Promise<void> {
    const layer = this.#layer;
    if (!layer) return;
    const { cloud, clips, filter } = layer;
    const format = this.#format.value as PointFormat;
    const name = `${cloud.name.replace(/(\.copc)?\.laz$/i, "")}-points.${format}`;
    const classes = shownClasses(layer);
    await this.#job.save(name, (sink, options) =>
      exportPoints(cloud, sink, { ...options, format, clips, filter, classes }),
    );
  }
}

/** Numbers of the classes that are shown; undefined where all are. */
function shownClasses({ style }: PointCloudLayer): number[] | undefined {
  const numbers = Object.keys(style.classes).map(Number);
  const shown = numbers.filter((number) => style.classes[number]?.show);
  return shown.length === numbers.length ? undefined : shown;
}
