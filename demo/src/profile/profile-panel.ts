import type { PointCloudLayer } from "@groma/layer/cesium";
import { exportCsv, exportDxf, exportLas } from "@groma/layer/export";
import { Profile } from "@groma/layer/tools";
import type { Viewer } from "cesium";
import { byId, setText } from "../panel/elements.js";
import { DrawLine, type DrawnLine } from "./draw-line.js";
import { ProfilePlot } from "./plot.js";
import { saveFile } from "./save-file.js";

const FORMATS = { las: exportLas, csv: exportCsv, dxf: exportDxf } as const;

/** Points of the picture at most; all of them are exported. */
const MOST_SHOWN = 3_000_000;

/** What the rest of the page hears of a profile. */
export interface ProfileEvents {
  /** Clicks on the globe become vertices of its line. */
  readonly begins: () => void;
  /** It could not be read or written. */
  readonly failed: (thrown: unknown) => void;
}

/** The profile of the page: a line drawn by clicks, the picture of its points, and their export. */
export class ProfilePanel {
  readonly #layer: () => PointCloudLayer | undefined;
  readonly #events: ProfileEvents;
  readonly #draw: DrawLine;
  readonly #panel = byId("profile", HTMLElement);
  readonly #status = byId("profile-status", HTMLElement);
  readonly #width = byId("profile-width", HTMLInputElement);
  readonly #start = byId("profile-draw", HTMLButtonElement);
  readonly #format = byId("profile-format", HTMLSelectElement);
  readonly #export = byId("profile-export", HTMLButtonElement);
  #plot: ProfilePlot | undefined;
  #profile: Profile | undefined;
  #work: AbortController | undefined;

  constructor(viewer: Viewer, layer: () => PointCloudLayer | undefined, events: ProfileEvents) {
    this.#layer = layer;
    this.#events = events;
    this.#draw = new DrawLine(viewer, layer, (line) => void this.#read(line));
    this.#start.addEventListener("click", () => (this.#draw.active ? this.finish() : this.#begin()));
    this.#width.addEventListener("change", () => void this.#read(this.#draw.line));
    this.#export.addEventListener("click", () => void this.#save());
    byId("profile-close", HTMLButtonElement).addEventListener("click", () => this.clear());
    window.addEventListener("keydown", ({ key }) => {
      if (key === "Escape" && this.#draw.active) this.finish();
    });
  }

  /** Whether clicks on the globe are vertices of the line. */
  get drawing(): boolean {
    return this.#draw.active;
  }

  /** Longitude and latitude of the line's vertices, radians. */
  get line(): DrawnLine {
    return this.#draw.line;
  }

  /** Points in the picture. */
  get shown(): number {
    return this.#plot?.count ?? 0;
  }

  /** Forgets line, picture and what is being read. */
  clear(): void {
    this.#work?.abort();
    this.#draw.clear();
    this.#profile = undefined;
    this.#panel.hidden = true;
    this.#tellState();
  }

  #begin(): void {
    this.#events.begins();
    this.#work?.abort();
    this.#profile = undefined;
    this.#draw.begin(this.#events.failed);
    this.#panel.hidden = false;
    this.#picture().clear(1);
    setText(this.#status, "Click points of the cloud along the line; Escape ends it.");
    this.#tellState();
  }

  /** Ends the line that is being drawn, if any. */
  finish(): void {
    this.#draw.end();
    this.#tellState();
  }

  #tellState(): void {
    setText(this.#start, this.#draw.active ? "End the line" : "Draw a profile");
    this.#export.disabled = this.#profile === undefined;
  }

  #picture(): ProfilePlot {
    this.#plot ??= new ProfilePlot(
      byId("profile-plot", HTMLCanvasElement),
      this.#panel.querySelector<SVGSVGElement>("#profile-axes")!,
    );
    return this.#plot;
  }

  async #read(line: DrawnLine): Promise<void> {
    const layer = this.#layer();
    if (!layer || line.length < 2) return;
    this.#work?.abort();
    this.#work = new AbortController();
    const { signal } = this.#work;
    try {
      const profile = new Profile(layer.cloud, { line, width: Number(this.#width.value) });
      this.#profile = profile;
      this.#tellState();
      const plot = this.#picture();
      plot.clear(profile.length);
      const bits = layer.cloud.statistics?.rgbBits === 8 ? 8 : 16;
      let complete = true;
      for await (const points of profile.points({ signal })) {
        plot.add(points, bits);
        setText(this.#status, `${this.#told(profile, plot.count)}, reading…`);
        complete = plot.count < MOST_SHOWN;
        if (!complete) break;
      }
      const whole = complete ? "complete" : "the coarser levels; the export has all points";
      setText(this.#status, `${this.#told(profile, plot.count)}, ${whole}`);
    } catch (thrown) {
      if (!signal.aborted) this.#events.failed(thrown);
    }
  }

  #told({ length }: Profile, count: number): string {
    return `${length.toFixed(1)} m, ${count.toLocaleString("en")} points`;
  }

  async #save(): Promise<void> {
    const profile = this.#profile;
    if (!profile) return;
    const format = this.#format.value as keyof typeof FORMATS;
    const onProgress = ({ read, total }: { read: number; total: number }) =>
      setText(this.#status, `writing, ${total > 0 ? Math.floor((100 * read) / total) : 100} %`);
    try {
      const name = `${profile.origin.name.replace(/(\.copc)?\.laz$/i, "")}-profile.${format}`;
      const saved = await saveFile(name, (sink) => FORMATS[format]([profile], sink, { onProgress }));
      setText(this.#status, saved ? `${name} is written.` : "Nothing was written.");
    } catch (thrown) {
      this.#events.failed(thrown);
    }
  }
}
