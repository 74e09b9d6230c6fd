import {
  type PlotAxes,
  PlotIndex,
  type PlotPlace,
  type PlottedPoint,
  PlotView,
  type ProfilePoints,
  type TerrainStation,
} from "@groma/layer/tools";
import { drawAxes, MARGIN } from "./plot-axes.js";
import { PlotCanvas } from "./plot-canvas.js";
import { watchPlot } from "./plot-input.js";
import { coloursOf, type PointColours } from "./point-colours.js";

/** Pixels around the pointer in which a point counts as hit. */
const REACH = 10;

/** Colour of the points of a second cloud. */
const SECOND: PointColours = { by: "second", bits: 16 };

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
  readonly #canvas: PlotCanvas;
  readonly #root: HTMLCanvasElement;
  readonly #axes: SVGSVGElement;
  readonly #events: PlotEvents;
  readonly #index = new PlotIndex<ProfilePoints>();
  readonly #parts: ProfilePoints[] = [];
  /** Points in the order in which they came; of a second cloud those without colours of their own. */
  readonly #drawn: { readonly points: ProfilePoints; readonly second: boolean }[] = [];
  #colours: PointColours = { by: "rgb", bits: 16 };
  #words: AxisWords = { along: "chainage (m)", up: "height (m)" };
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

  /** @throws Error where the browser gives no WebGL 2 */
  constructor(canvas: HTMLCanvasElement, axes: SVGSVGElement, events: PlotEvents) {
    this.#canvas = new PlotCanvas(canvas);
    this.#root = canvas;
    this.#axes = axes;
    this.#events = events;
    new ResizeObserver(() => this.#ask()).observe(canvas);
    watchPlot(canvas, MARGIN, {
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

  /** Begins another profile. @param from chainage of its start, metres @param length of its line, metres */
  clear(from: number, length: number, words: AxisWords, colours: PointColours): void {
    this.#canvas.clear();
    this.#index.clear();
    this.#parts.length = 0;
    this.#drawn.length = 0;
    [this.#from, this.#length, this.#words, this.#colours] = [from, length, words, colours];
    this.#least = Number.POSITIVE_INFINITY;
    this.#greatest = Number.NEGATIVE_INFINITY;
    this.#ground = [];
    this.#secondGround = [];
    this.#measured = [];
    this.#hover = undefined;
    this.fit();
  }

  /** @param second whether they are those of a second cloud, which have one colour and are not pointed at */
  add(points: ProfilePoints, second = false): void {
    for (const height of points.height) {
      if (height < this.#least) this.#least = height;
      if (height > this.#greatest) this.#greatest = height;
    }
    this.#canvas.add(points, coloursOf(points, second ? SECOND : this.#colours));
    this.#drawn.push({ points, second });
    if (!second) {
      this.#index.add(points);
      this.#parts.push(points);
    }
    if (this.view.isFitted) this.fit();
    this.#ask();
  }

  set colours(colours: PointColours) {
    this.#colours = colours;
    for (const [part, { points, second }] of this.#drawn.entries())
      if (!second) this.#canvas.recolour(part, coloursOf(points, colours));
    this.#ask();
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

  #point(x: number | undefined, y: number | undefined): void {
    const found =
      x === undefined || y === undefined ? undefined : this.#index.nearest(this.view, x, y, REACH);
    if (found?.points === this.#hover?.points && found?.index === this.#hover?.index) return;
    this.#hover = found;
    this.#events.hovered(found);
    this.#ask();
  }

  #click(x: number, y: number): void {
    const found = this.#index.nearest(this.view, x, y, REACH);
    this.#events.clicked(found ? placeOf(found) : this.view.placeOf(x, y), found);
  }

  #ask(): void {
    this.#frame ||= requestAnimationFrame(() => {
      this.#frame = 0;
      this.#draw();
    });
  }

  #measure(): void {
    const { clientWidth, clientHeight } = this.#root;
    this.view.resize(clientWidth - MARGIN.left - MARGIN.right, clientHeight - MARGIN.top - MARGIN.bottom);
  }

  #draw(): void {
    if (this.#root.clientWidth === 0 || this.#root.clientHeight === 0) return;
    this.#measure();
    this.#canvas.draw(this.view, MARGIN.left, MARGIN.bottom);
    drawAxes(this.#axes, this.view, {
      along: `${this.#words.along}, heights × ${this.view.exaggeration.toPrecision(3)}`,
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
