import type { LedgerRow, PointCloud, PointCloudLayer } from "@groma/layer/cesium";
import { profileLedger } from "@groma/layer/plot";
import {
  type PlotPlace,
  type PlottedPoint,
  Profile,
  type ProfilePoints,
  type ViewAdapter,
} from "@groma/layer/tools";
import type { Viewer } from "cesium";
import { i18n } from "../language/i18n.js";
import { fixed } from "../language/numbers.js";
import { byId, setText } from "../panel/elements.js";
import { isNarrow } from "../panel/fold.js";
import { Comparison } from "./comparison.js";
import { CutClips } from "./cut-clips.js";
import { GroundPanel } from "./ground-panel.js";
import { LineTools } from "./line-tools.js";
import { measuredWords, TOLERANCE } from "./measured-words.js";
import { ProfilePlot, placeOf } from "./plot.js";
import { PlotStyle } from "./plot-style.js";
import { axisWords, pointPlace, pointWords, profileWords } from "./point-words.js";
import { type ExportedProfile, ProfileExport } from "./profile-export.js";
import { type DrawnLine, ProfileLines } from "./profile-lines.js";
import { PlaceMark, StripOutline } from "./strip-outline.js";

/** Points of the picture at most; all of them are exported. */
const MOST_SHOWN = 3_000_000;

const HINT = i18n.t(
  "Click points of the cloud along the line, or move the crosshair with the arrow keys and press Enter. Twice in one place ends it; Escape gives it up.",
);

/** What the rest of the page hears of a profile. */
export interface ProfileEvents {
  /** Clicks on globe and map become vertices of its line. */
  readonly begins: () => void;
  /** A point of the picture was chosen: its node and record. */
  readonly picked: (cloud: PointCloud, node: string, record: number) => void;
  /** The place that is pointed at, ECEF, metres. */
  readonly pointed: (place: ArrayLike<number> | undefined) => void;
  /** It could not be read or written. */
  readonly failed: (thrown: unknown) => void;
}

/** The profile of the page: lines, the picture of the points along one of them, what is measured in it, and its files. */
export class ProfilePanel {
  readonly lines: ProfileLines;
  readonly #lineTools: LineTools;
  readonly comparison: Comparison;
  readonly #cut: CutClips;
  readonly #layer: () => PointCloudLayer | undefined;
  readonly #events: ProfileEvents;
  readonly #outline: StripOutline;
  readonly #mark: PlaceMark;
  readonly #panel = byId("profile", HTMLElement);
  readonly #status = byId("profile-status", HTMLElement);
  readonly #readout = byId("profile-readout", HTMLElement);
  readonly #start = byId("profile-draw", HTMLButtonElement);
  readonly #stretch = byId("profile-stretch", HTMLInputElement);
  readonly #style: PlotStyle;
  readonly #measure = byId("profile-measure", HTMLButtonElement);
  readonly #ground: GroundPanel;
  readonly #export: ProfileExport;
  #plot: ProfilePlot | undefined;
  #profile: Profile | undefined;
  #work: AbortController | undefined;
  #measured: PlotPlace[] = [];
  /** How much heights are stretched, where the reader asked for a number. */
  #stretched: number | undefined;

  constructor(viewer: Viewer, layer: () => PointCloudLayer | undefined, events: ProfileEvents) {
    this.#layer = layer;
    this.#events = events;
    this.lines = new ProfileLines(viewer, layer, () => this.#follow(), events.failed);
    this.#lineTools = new LineTools(this.lines, () => void this.#read(), events.failed);
    this.comparison = new Comparison(() => void this.#read(), events.failed);
    this.#cut = new CutClips(layer);
    this.#ground = new GroundPanel(() => void this.#groundAnew(), events.failed);
    this.#mark = new PlaceMark(viewer);
    this.#style = new PlotStyle(viewer, layer, (drawing) => {
      if (this.#plot && !this.#panel.hidden) this.#plot.drawing = drawing;
    });
    const widened = (width: number) => {
      this.#lineTools.width = Number(width.toPrecision(3));
    };
    this.#outline = new StripOutline(viewer, layer, widened, events.failed);
    this.#export = new ProfileExport(this.#status, () => this.#exported(), events.failed);
    this.#connect();
  }

  /** Whether clicks are vertices of the line. */
  get drawing(): boolean {
    return this.lines.drawing;
  }

  /** What is to be done while a line is drawn; empty while none is. */
  get hint(): string {
    return this.drawing ? HINT : "";
  }

  /** Longitude and latitude of the line's vertices, radians. */
  get line(): DrawnLine {
    return this.lines.line;
  }

  /** Points in the picture. */
  get shown(): number {
    return this.#plot?.count ?? 0;
  }

  /** What its plot could leave out; nothing without a profile. */
  get ledger(): readonly LedgerRow[] {
    return this.#profile ? profileLedger(this.#profile, TOLERANCE) : [];
  }

  get plot(): ProfilePlot | undefined {
    return this.#plot;
  }

  /** Lets lines be drawn and changed on a further view. */
  addView(view: ViewAdapter): void {
    this.lines.addView(view);
    view.onFrame(this.#style.tell);
  }

  /** Forgets what is shown, and takes over the lines that were kept of a cloud. */
  open(layer: PointCloudLayer): void {
    this.#close();
    this.comparison.clear();
    try {
      this.lines.attach(layer);
    } catch (thrown) {
      this.#events.failed(thrown);
    }
  }

  /** No cloud is there any more. */
  leave(): void {
    this.#close();
    this.comparison.clear();
    this.lines.leave();
  }

  /** Ends the line that is being drawn, if any. */
  finish(): void {
    if (this.drawing) this.lines.finish();
  }

  #connect(): void {
    const on = (element: HTMLElement, event: string, work: () => void) =>
      element.addEventListener(event, work);
    on(this.#start, "click", () => (this.drawing ? this.finish() : this.#begin()));
    on(byId("profile-close", HTMLButtonElement), "click", () => this.#close());
    on(byId("profile-fit", HTMLButtonElement), "click", () => this.#plot?.fit());
    on(byId("profile-true", HTMLButtonElement), "click", () => this.#stretchBy(1));
    on(this.#stretch, "change", () => this.#stretchBy(this.#stretch.valueAsNumber));
    on(this.#measure, "click", () => this.#toggleMeasuring());
  }

  #stretchBy(exaggeration: number): void {
    if (!(exaggeration > 0)) return;
    this.#stretched = exaggeration;
    this.#plot?.stretch(exaggeration);
  }

  #begin(): void {
    this.#events.begins();
    this.#work?.abort();
    this.#profile = undefined;
    // Where it would lie over what is to be clicked, it comes once the line is there.
    this.#panel.hidden = isNarrow();
    this.#cut.show(undefined);
    this.#clearPicture(0, 1);
    setText(this.#status, "");
    this.lines.draw().catch(this.#events.failed);
  }

  #close(): void {
    this.#export.cancel();
    this.lines.tool.cancel();
    this.lines.choose(undefined);
    this.#forget();
    this.#panel.hidden = true;
  }

  /** There is no profile any more. */
  #forget(): void {
    this.#work?.abort();
    if (this.#profile) {
      this.#profile = undefined;
      this.#outline.show(undefined, []);
      this.#cut.show(undefined);
      this.#point(undefined);
      this.#clearPicture(0, 1);
      setText(this.#status, "");
    }
    this.#tellState();
  }

  /** The lines have changed, or another one is shown. */
  #follow(): void {
    const { chosen } = this.lines;
    this.#lineTools.show();
    if (chosen) this.#panel.hidden = false;
    this.#tellState();
    if (this.lines.line.length > 1) void this.#read();
    else if (!chosen && !this.drawing) this.#forget();
  }

  #tellState(): void {
    setText(this.#start, this.drawing ? i18n.t("End the line") : i18n.t("Draw a profile"));
    this.#export.possible = this.#profile !== undefined;
  }

  #picture(): ProfilePlot {
    const axes = this.#panel.querySelector<SVGSVGElement>("#profile-axes")!;
    this.#plot ??= new ProfilePlot(byId("profile-plot", HTMLCanvasElement), axes, {
      hovered: (point) => this.#point(point),
      clicked: (place, point) => this.#click(place, point),
      moved: () => {
        this.#stretch.value = this.#plot?.view.exaggeration.toPrecision(3) ?? "";
      },
    });
    return this.#plot;
  }

  #clearPicture(from: number, length: number): ProfilePlot {
    const layer = this.#layer();
    const plot = this.#picture();
    plot.clear(from, length, axisWords(layer?.cloud), layer?.cloud, layer && this.#style.of(layer));
    this.#measured = [];
    this.#ground.clear();
    return plot;
  }

  async #read(): Promise<void> {
    const layer = this.#layer();
    const { line, vertices } = this.lines;
    const { start, width } = this.#lineTools;
    if (!layer || line.length < 2) return;
    this.#work?.abort();
    this.#work = new AbortController();
    const { signal } = this.#work;
    try {
      const plane = this.comparison.planeWith(layer.cloud);
      const cut = { line, width, start, plane };
      const profile = new Profile(layer.cloud, cut);
      this.#profile = profile;
      this.#outline.show(profile, vertices);
      this.#cut.show(profile);
      this.#tellState();
      const plot = this.#clearPicture(profile.from, profile.length);
      const tell = (state: string) => setText(this.#status, `${profileWords(profile, plot.count)}, ${state}`);
      tell(i18n.t("reading…"));
      let complete = true;
      for await (const points of profile.points({ signal })) {
        plot.add(points);
        tell(i18n.t("reading…"));
        complete = plot.count < MOST_SHOWN;
        if (!complete) break;
      }
      tell(complete ? i18n.t("complete") : i18n.t("the coarser levels; the export has all points"));
      await this.comparison.read(
        cut,
        (points, cloud) => plot.addSecond(points, cloud, this.#style.ofSecond(layer)),
        signal,
      );
      await this.#groundAnew();
    } catch (thrown) {
      if (!signal.aborted) this.#events.failed(thrown);
    }
  }

  #groundAnew(): Promise<void> {
    return this.#ground.tell(this.#profile, this.#plot, this.comparison);
  }

  /** Shows the point that is pointed at, here and on globe and map. */
  #point(point: PlottedPoint<ProfilePoints> | undefined): void {
    const profile = this.#profile;
    const place = point && profile ? pointPlace(profile, point) : undefined;
    setText(this.#readout, point && place ? pointWords(point, this.lines.stations) : "");
    this.#mark.show(place);
    this.#events.pointed(place);
  }

  #toggleMeasuring(): void {
    const measuring = this.#measure.getAttribute("aria-pressed") !== "true";
    this.#measure.setAttribute("aria-pressed", String(measuring));
    this.#measured = [];
    this.#plot?.measured([], "");
    if (measuring)
      setText(
        this.#readout,
        i18n.t("Click two places of the picture, or choose them with the arrow keys and Enter."),
      );
  }

  #click(place: PlotPlace, point: PlottedPoint<ProfilePoints> | undefined): void {
    const profile = this.#profile;
    if (!profile) return;
    if (this.#measure.getAttribute("aria-pressed") === "true") {
      this.#measured = this.#measured.length === 1 ? [...this.#measured, place] : [place];
      const words = measuredWords(this.#measured, this.#ground.stations);
      this.#plot?.measured(this.#measured, words[0] ?? "");
      if (words.length > 0) setText(this.#readout, words.join("; "));
    } else if (point) {
      const { batch } = point.points;
      this.#events.picked(profile.origin as PointCloud, batch.node, batch.inside[point.index]!);
      setText(
        this.#readout,
        i18n.t("{chainage} m: its record is shown beside the globe", {
          chainage: fixed(placeOf(point)[0], 2),
        }),
      );
    }
  }

  /** Drawings to scale have heights in a round scale too, unless the reader asked for another. */
  #drawnStretch(): ExportedProfile["exaggeration"] {
    const most = Number(this.#plot?.view.exaggeration.toPrecision(3) ?? 1);
    return most === Number(this.#stretched?.toPrecision(3)) ? most : { most };
  }

  #exported(): ExportedProfile | undefined {
    const [profile, layer] = [this.#profile, this.#layer()];
    if (!profile || !layer) return undefined;
    return {
      profile,
      name: this.lines.chosen?.name,
      exaggeration: this.#drawnStretch(),
      drawing: this.#style.of(layer),
      stations: this.lines.stations,
      ground: this.#ground.exported(profile),
      thickness: this.#lineTools.width,
    };
  }
}
