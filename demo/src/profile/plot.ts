import type { PointCloud } from "@groma/layer/cesium";
import { type PlotDrawing, PlotPicture, type PlotSeries } from "@groma/layer/plot";
import {
  type PlotAxes,
  PlotIndex,
  type PlotPlace,
  type PlottedPoint,
  PlotView,
  type ProfilePoints,
  type TerrainStation,
} from "@groma/layer/tools";
import { i18n } from "../language/i18n.js";
import { significant } from "../language/numbers.js";
import { drawAxes } from "./plot-axes.js";
import { watchPlot } from "./plot-input.js";

/** Pixels around the pointer in which a point counts as hit. */
const REACH = 10;

/** Words of the axes. */
export interface AxisWords {
  readonly along: string;
  readonly up: string;
}

/** What the rest of the page hears of a plot. */
export interface PlotEvents {
  /** The point that is pointed at; undefined: none. */
  readonly hovered: (point: PlottedPoint<ProfilePoints> | undefined) => void;
  /** A place was clicked, or chosen by key; with the point there, if one is near. */
  readonly clicked: (place: PlotPlace, point: PlottedPoint<ProfilePoints> | undefined) => void;
  /** Another part is seen. */
  readonly moved: () => void;
}

/** Chainage against height of the points of one profile: seen, moved, pointed at. */
export class ProfilePlot {
  readonly view = new PlotView(1, 1);
  readonly #picture: PlotPicture;
  readonly #root: HTMLCanvasElement;
  readonly #axes: SVGSVGElement;
  readonly #events: PlotEvents;
  readonly #index = new PlotIndex<ProfilePoints>();
  readonly #parts: ProfilePoints[] = [];
  #first: PlotSeries | undefined;
  #second: PlotSeries | undefined;
  #words: AxisWords = { along: i18n.t("chainage (m)"), up: i18n.t("height (m)") };
  #from = 0;
  #length = 1;
  #least = Number.POSITIVE_INFINITY;
  #greatest = Number.NEGATIVE_INFINITY;
  #ground: readonly TerrainStation[] = [];
  #secondGround: readonly TerrainStation[] = [];
  #measured: readonly PlotPlace[] = [];
  #measuredWords = "";
  #hover: PlottedPoint<ProfilePoints> | undefined;
  #crosshair: readonly [number, number] | undefined;
  #frame = 0;

  /** @throws DrawError DRAW_WEBGL2 */
  constructor(canvas: HTMLCanvasElement, axes: SVGSVGElement, events: PlotEvents) {
    this.#picture = new PlotPicture(canvas, () => this.#ask());
    this.#root = canvas;
    this.#axes = axes;
    this.#events = events;
    new ResizeObserver(() => this.#ask()).observe(canvas);
    watchPlot(canvas, {
      pan: (right, down) => this.#change(() => this.view.panBy(right, down)),
      zoom: (x, y, factor, which) => this.zoom(factor, x, y, which),
      hover: (x, y) => this.#point(x, y),
      leave: () => this.#point(undefined, undefined),
      click: (x, y) => this.#click(x, y),
      crosshair: (at) => {
        this.#crosshair = at;
        if (at) this.#point(...at);
        this.#ask();
      },
      fit: () => this.fit(),
      trueScale: () => this.stretch(1),
      size: () => [this.view.width, this.view.height],
    });
  }

  /** Points that are in the picture. */
  get count(): number {
    return this.#parts.reduce((sum, { chainage }) => sum + chainage.length, 0);
  }

  /** Points of the picture, node by node. */
  get parts(): readonly ProfilePoints[] {
    return this.#parts;
  }

  /**
   * Begins another profile.
   * @param from chainage of its start, metres
   * @param length of its line, metres
   * @param cloud whose points come; undefined: none do
   */
  clear(from: number, length: number, words: AxisWords, cloud?: PointCloud, drawing?: PlotDrawing): void {
    for (const series of [this.#first, this.#second]) if (series) this.#picture.remove(series);
    this.#first = cloud && drawing && this.#picture.addSeries(cloud, drawing);
    this.#second = undefined;
    this.#index.clear();
    this.#parts.length = 0;
    [this.#from, this.#length, this.#words] = [from, length, words];
    this.#least = Number.POSITIVE_INFINITY;
    this.#greatest = Number.NEGATIVE_INFINITY;
    this.#ground = [];
    this.#secondGround = [];
    this.#measured = [];
    this.#hover = undefined;
    this.fit();
  }

  /** Takes points of the profile. */
  add(points: ProfilePoints): void {
    this.#first?.add(points);
    this.#index.add(points);
    this.#parts.push(points);
    this.#reach(points);
  }

  /** Takes points of a second cloud, which are not pointed at. */
  addSecond(points: ProfilePoints, cloud: PointCloud, drawing: PlotDrawing): void {
    this.#second ??= this.#picture.addSeries(cloud, drawing);
    this.#second.add(points);
    this.#reach(points);
  }

  #reach({ height: heights }: ProfilePoints): void {
    for (const height of heights) {
      if (height < this.#least) this.#least = height;
      if (height > this.#greatest) this.#greatest = height;
    }
    if (this.view.isFitted) this.fit();
  }

  /** How the points are drawn from now on. */
  set drawing(drawing: PlotDrawing) {
    if (this.#first) this.#first.drawing = drawing;
  }

  /** The ground of a second cloud. */
  set secondGround(stations: readonly TerrainStation[]) {
    this.#secondGround = stations;
    this.#ask();
  }

  set ground(stations: readonly TerrainStation[]) {
    this.#ground = stations;
    this.#ask();
  }

  /** Shows a measured line and words beside its end. */
  measured(places: readonly PlotPlace[], words: string): void {
    [this.#measured, this.#measuredWords] = [places, words];
    this.#ask();
  }

  /** Shows everything. */
  fit(): void {
    const empty = !(this.#greatest >= this.#least);
    const [low, high] = empty ? [0, 1] : [this.#least, Math.max(this.#greatest, this.#least + 0.1)];
    this.#change(() => this.view.fit({ from: this.#from, to: this.#from + this.#length, low, high }));
  }

  /** Stretches heights against lengths by a number; 1 shows true angles. */
  stretch(exaggeration: number): void {
    this.#change(() => {
      this.view.exaggeration = exaggeration;
    });
  }

  /** Makes things larger about a pixel of the plot. */
  zoom(factor: number, x = this.view.width / 2, y = this.view.height / 2, axes: PlotAxes = "both"): void {
    this.#change(() => this.view.zoomAt(x, y, factor, axes));
  }

  #change(change: () => void): void {
    this.#measure();
    change();
    this.#events.moved();
    this.#ask();
  }

  #nearest(x: number, y: number): PlottedPoint<ProfilePoints> | undefined {
    const shows = (points: ProfilePoints, index: number) => this.#first?.shows(points, index) ?? false;
    return this.#index.nearest(this.view, x, y, REACH, shows);
  }

  #point(x: number | undefined, y: number | undefined): void {
    const found = x === undefined || y === undefined ? undefined : this.#nearest(x, y);
    if (found?.points === this.#hover?.points && found?.index === this.#hover?.index) return;
    this.#hover = found;
    this.#events.hovered(found);
    this.#ask();
  }

  #click(x: number, y: number): void {
    const found = this.#nearest(x, y);
    this.#events.clicked(found ? placeOf(found) : this.view.placeOf(x, y), found);
  }

  #ask(): void {
    this.#frame ||= requestAnimationFrame(() => {
      this.#frame = 0;
      this.#draw();
    });
  }

  #measure(): void {
    this.view.resize(this.#root.clientWidth, this.#root.clientHeight);
  }

  #draw(): void {
    if (this.#root.clientWidth === 0 || this.#root.clientHeight === 0) return;
    this.#measure();
    if (!this.#picture.draw(this.view)) this.#ask();
    drawAxes(this.#axes, this.view, {
      along: `${this.#words.along}, ${i18n.t("heights")} × ${significant(this.view.exaggeration, 3)}`,
      ...{ up: this.#words.up, ground: this.#ground, secondGround: this.#secondGround },
      crosshair: this.#crosshair,
      ...{ measured: this.#measured, measuredWords: this.#measuredWords },
      hover: this.#hover && placeOf(this.#hover),
    });
  }
}

/** Chainage and height of a point. */
export function placeOf({ points, index }: PlottedPoint<ProfilePoints>): PlotPlace {
  return [points.chainage[index]!, points.height[index]!];
}
