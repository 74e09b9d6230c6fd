import type { Vertex } from "../measure/index.js";
import { courseOf } from "./course.js";
import type { Grip } from "./grip.js";
import { placeLabels, type ScreenBox, seenAnchor } from "./labels.js";
import { aroundPole } from "./pole-ring.js";
import type { ScreenPoint, ViewAdapter } from "./view-adapter.js";
import type { MeasureWords } from "./words.js";

/** A figure as it is shown. */
export interface ShownFigure {
  /** Of the measurement; undefined for the one being drawn. */
  readonly id: string | undefined;
  readonly name: string;
  readonly vertices: readonly Vertex[];
  /** Where the figure being drawn would go on, pointed at on whatever view. */
  readonly ahead?: Vertex | undefined;
  readonly shape: "points" | "line" | "ring";
  /** Whether its vertices can be taken hold of. */
  readonly open: boolean;
  /** Whether vertices may come in between. */
  readonly grows: boolean;
  readonly label: string;
  /** Whether the label tells what is wrong. */
  readonly wrong: boolean;
}

/** What the overlay tells of grips that are used. */
export interface OverlayEvents {
  readonly grabbed: (grip: Grip, event: PointerEvent) => void;
  readonly key: (grip: Grip, event: KeyboardEvent) => void;
  readonly chosen: (id: string) => void;
}

/** What grips are called. */
type GripWords = Pick<MeasureWords, "measurements" | "vertex" | "vertexAfter">;

interface Elements {
  readonly group: SVGGElement;
  readonly line: SVGPathElement;
  /** Of a ring around a pole, on a map: its line alone encloses nothing there. */
  readonly fill: SVGPathElement;
  readonly grips: { readonly element: SVGElement; readonly grip: Grip }[];
  readonly dots: SVGCircleElement[];
  readonly label: HTMLElement;
  /** Where the label stood last. */
  slot?: number;
}

/** Where a figure is seen. */
interface Seen {
  readonly places: readonly (ScreenPoint | undefined)[];
  /** Where it leads on to, while it is drawn. */
  readonly ahead: ScreenPoint | undefined;
  /** The way through all of it, long edges along the earth; a ring is closed. */
  readonly way: readonly (ScreenPoint | undefined)[];
  /** What it encloses, where that is not what its way goes around. */
  readonly inside?: readonly ScreenPoint[] | undefined;
}

const SVG = "http://www.w3.org/2000/svg";

/** How figures look where the application's CSS says nothing: no rule of it weighs less. */
const LOOK = `
:where(.groma-measure) { color: #e8eef5; font: 13px / 1.4 system-ui, sans-serif }
:where(.groma-line) { fill: none; stroke: #f2b84b; stroke-width: 2.5; stroke-linejoin: round }
:where(.groma-ring) { fill: rgb(242 184 75 / 18%) }
:where(.groma-measure circle) { fill: #f2b84b; stroke: #10161d; stroke-width: 1.5 }
:where(.groma-measure) :where(.groma-grip, .groma-between) { fill: rgb(242 184 75 / 35%); stroke: #f2b84b }
:where(.groma-crosshair) { stroke: #fff; stroke-width: 1.5; filter: drop-shadow(0 0 1px #000) }
:where(.groma-label) { padding: 2px 7px; border-radius: 6px; background: rgb(14 21 30 / 92%); text-align: center; cursor: pointer }
:where(.groma-wrong) { background: #3d1716 }
`;

/** Labels that are shown at once. More of them cover each other, and finding room for each would take the frame's time. */
const MOST_LABELS = 200;

/** Figures and labels laid over a view, moved with it. Their classes, `groma-line` and so on, are the application's to style. */
export class Overlay {
  readonly root = document.createElement("div");
  /** Where the next vertex would be placed by keyboard. */
  crosshair: ScreenPoint | undefined;
  /** Where the figure being drawn leads on to. */
  pointer: ScreenPoint | undefined;

  readonly #view: ViewAdapter;
  readonly #events: OverlayEvents;
  readonly #words: GripWords;
  readonly #covering: () => readonly Element[];
  readonly #svg = svgElement("svg");
  readonly #cross = svgElement("path");
  readonly #elements = new Map<string, Elements>();
  readonly #unwatch: () => void;
  #figures: readonly ShownFigure[] = [];
  /** What was laid out last; a frame in which nothing has moved changes nothing. */
  #last = "";

  /** @param covering elements that lie over the view, asked for anew each time */
  constructor(
    view: ViewAdapter,
    events: OverlayEvents,
    words: GripWords,
    covering: () => readonly Element[],
  ) {
    this.#view = view;
    this.#events = events;
    this.#words = words;
    this.#covering = covering;
    this.root.className = "groma-measure";
    this.root.style.cssText = "position:absolute;inset:0;overflow:hidden;pointer-events:none";
    this.#svg.style.cssText = "position:absolute;inset:0;width:100%;height:100%";
    // As a picture it would hide the vertices in it from screen readers.
    this.#svg.setAttribute("role", "group");
    const named = view.name === undefined ? words.measurements : `${words.measurements}, ${view.name}`;
    this.#svg.setAttribute("aria-label", named);
    this.#cross.classList.add("groma-crosshair");
    this.#svg.append(this.#cross);
    const look = document.createElement("style");
    look.textContent = LOOK;
    this.root.append(look, this.#svg);
    view.element.after(this.root);
    const { parentElement: around } = this.root;
    // What is laid over the view is placed in what holds the view.
    if (around && getComputedStyle(around).position === "static") around.style.position = "relative";
    this.#unwatch = view.onFrame(() => this.layout());
  }

  /** Shows figures; elements of those that stay are kept, and with them the reader's focus. */
  show(figures: readonly ShownFigure[]): void {
    this.#figures = figures;
    const keys = new Set(figures.map(keyOf));
    for (const [key, { group, label }] of this.#elements) {
      if (keys.has(key)) continue;
      group.remove();
      label.remove();
      this.#elements.delete(key);
    }
    for (const figure of figures) this.#fill(figure);
    // While a figure is drawn, clicks are its own: a label may lie where a vertex belongs.
    const hears = keys.has("") ? "none" : "auto";
    for (const { label } of this.#elements.values()) label.style.pointerEvents = hears;
    this.#last = "";
    this.layout();
  }

  /** Gives the keyboard to a vertex. */
  focus(id: string, vertex: number): void {
    const found = this.#elements.get(id)?.grips.find(({ grip }) => !grip.between && grip.vertex === vertex);
    found?.element.focus();
  }

  destroy(): void {
    this.#unwatch();
    this.root.remove();
  }

  #fill(figure: ShownFigure): void {
    const key = keyOf(figure);
    const elements = this.#elements.get(key) ?? this.#make(figure);
    this.#elements.set(key, elements);
    elements.group.classList.toggle("groma-open", figure.open);
    elements.label.classList.toggle("groma-wrong", figure.wrong);
    if (elements.label.textContent !== figure.label) elements.label.textContent = figure.label;
    const count = figure.vertices.length;
    while (elements.dots.length > count) elements.dots.pop()?.remove();
    while (elements.dots.length < count) {
      const dot = svgElement("circle");
      dot.setAttribute("r", "3.5");
      elements.dots.push(dot);
      elements.group.append(dot);
    }
    const wanted = figure.open ? gripsOf(figure) : [];
    const same =
      wanted.length === elements.grips.length &&
      wanted.every(({ vertex, between }, i) => {
        const { grip } = elements.grips[i];
        return grip.vertex === vertex && grip.between === between;
      });
    if (same) return;
    const held = elements.grips.find(({ element }) => element === document.activeElement)?.grip.vertex;
    for (const { element } of elements.grips.splice(0)) element.remove();
    for (const grip of wanted) elements.grips.push(this.#grip(grip, figure, elements.group));
    // Who moves vertices by keyboard goes on at the same one, or at the last.
    if (held === undefined) return;
    if (figure.open && count > 0) this.focus(key, Math.min(held, count - 1));
    else this.#view.element.focus({ preventScroll: true });
  }

  #make(figure: ShownFigure): Elements {
    const group = svgElement("g");
    const [fill, line] = [svgElement("path"), svgElement("path")];
    line.classList.add("groma-line");
    group.append(fill, line);
    this.#svg.insertBefore(group, this.#cross);
    const label = document.createElement("div");
    label.className = "groma-label";
    label.style.cssText = "position:absolute;left:0;top:0;white-space:pre";
    const { id } = figure;
    if (id !== undefined) label.addEventListener("click", () => this.#events.chosen(id));
    this.root.append(label);
    return { group, line, fill, grips: [], dots: [], label };
  }

  #grip(grip: Grip, { name }: ShownFigure, group: SVGGElement): Elements["grips"][number] {
    const element = svgElement("circle");
    element.classList.add(grip.between ? "groma-between" : "groma-grip");
    element.setAttribute("r", grip.between ? "5" : "8");
    element.setAttribute("role", "button");
    const called = grip.between ? this.#words.vertexAfter : this.#words.vertex;
    element.setAttribute("aria-label", called(grip.vertex + 1, name));
    element.style.cssText = "pointer-events:all;touch-action:none;cursor:move";
    if (!grip.between) element.tabIndex = 0;
    element.addEventListener("pointerdown", (event) => this.#events.grabbed(grip, event));
    element.addEventListener("keydown", (event) => this.#events.key(grip, event));
    group.append(element);
    return { element, grip };
  }

  /** Puts everything where the view shows it now. */
  layout(): void {
    const seen = this.#figures.map((figure) => this.#see(figure));
    const { clientWidth: width, clientHeight: height } = this.root;
    const covered = this.#figures.length > 0 ? this.#covered() : [];
    const state = JSON.stringify([seen, this.crosshair, width, height, covered]);
    if (state === this.#last) return;
    this.#last = state;
    const all = this.#figures.map((figure, i) => {
      const elements = this.#elements.get(keyOf(figure))!;
      const wished = this.#place(figure, elements, seen[i]);
      return figure.label === "" ? undefined : wished && { elements, wished, of: seen[i] };
    });
    // The figure that is being drawn is the last one.
    const shown = all.filter((one) => one !== undefined).slice(-MOST_LABELS);
    const named = new Set(shown.map(({ elements }) => elements));
    for (const elements of this.#elements.values()) elements.label.hidden = !named.has(elements);
    const labels = shown.map(({ elements, wished, of }) => {
      const way = of.way.length > 0 ? of.way : of.places;
      return { elements, anchor: seenAnchor(wished, way, covered, { width, height }), of };
    });
    const wishes = labels.map(({ elements: { label, slot }, anchor }) => ({
      ...{ anchor, slot, width: label.offsetWidth, height: label.offsetHeight },
    }));
    const points = [...labels.flatMap(({ of }) => [...of.places, of.ahead]), this.crosshair].filter(
      (place) => place !== undefined,
    );
    const obstacles = { points, lines: labels.map(({ of }) => of.way), covered };
    for (const [i, { x, y, slot }] of placeLabels(wishes, obstacles, { width, height }).entries()) {
      const { elements } = labels[i];
      elements.slot = slot;
      elements.label.style.transform = `translate(${Math.round(x)}px, ${Math.round(y)}px)`;
    }
    const { crosshair: at } = this;
    this.#cross.setAttribute("d", at ? `M${at.x - 12} ${at.y}h24M${at.x} ${at.y - 12}v24` : "");
  }

  /** What lies over the view, in its own pixels. */
  #covered(): ScreenBox[] {
    const { left, top } = this.root.getBoundingClientRect();
    return this.#covering().flatMap((element) => {
      const box = element.getBoundingClientRect();
      if (box.width === 0 || box.height === 0) return [];
      return { left: box.left - left, top: box.top - top, right: box.right - left, bottom: box.bottom - top };
    });
  }

  /** Each place beside the one before: a map may show the earth more than once. */
  #see({ id, vertices, shape, ahead }: ShownFigure): Seen {
    let near: ScreenPoint | undefined;
    const see = (vertex: Vertex) => {
      const at = this.#view.project(vertex, near);
      near = at ?? near;
      return at;
    };
    const way: (ScreenPoint | undefined)[] = [];
    const places = vertices.map((vertex, i) => {
      const before = vertices[i - 1];
      if (before) way.push(...courseOf(before, vertex).map(see));
      const place = see(vertex);
      way.push(place);
      return place;
    });
    // The pointer, or what is pointed at on another view.
    const next = id === undefined ? (this.pointer ?? (ahead && see(ahead))) : undefined;
    const [first] = vertices;
    if (shape === "points" || !first) return { places, ahead: next, way: [] };
    if (next) way.push(next);
    if (shape !== "ring" || vertices.length + Number(next !== undefined) < 3) {
      return { places, ahead: next, way };
    }
    if (next) way.push(places[0]);
    else way.push(...[...courseOf(vertices[vertices.length - 1], first), first].map(see));
    const project = (vertex: Vertex, beside: ScreenPoint) => this.#view.project(vertex, beside);
    return { places, ahead: next, way, inside: next ? undefined : aroundPole(vertices, way, project) };
  }

  /** @returns where its label belongs; undefined where nothing of it is in the view */
  #place(
    { id, shape }: ShownFigure,
    { line, fill, dots, grips }: Elements,
    { places, way, ahead, inside }: Seen,
  ): ScreenPoint | undefined {
    line.setAttribute("d", pathOf(way));
    fill.setAttribute("d", inside ? `${pathOf(inside)}Z` : "");
    // One of the two is filled.
    line.classList.toggle("groma-ring", shape === "ring" && !inside);
    fill.classList.toggle("groma-ring", inside !== undefined);
    for (const [i, place] of places.entries()) move(dots[i], place);
    for (const { element, grip } of grips) {
      const a = places[grip.vertex];
      const b = places[(grip.vertex + 1) % places.length];
      move(element, grip.between ? middle([a, b]) : a);
    }
    if (id === undefined) return this.crosshair ?? ahead ?? middle(places);
    return middle(shape === "ring" ? places : places.slice(0, 2));
  }
}

function keyOf({ id }: ShownFigure): string {
  return id ?? "";
}

function gripsOf({ id = "", vertices, shape, grows }: ShownFigure): Grip[] {
  const edges = shape === "points" ? 0 : vertices.length - (shape === "ring" ? 0 : 1);
  return [
    ...(grows ? Array.from({ length: edges }, (_, vertex) => ({ id, vertex, between: true })) : []),
    ...vertices.map((_, vertex) => ({ id, vertex, between: false })),
  ];
}

/** Lines between places that follow each other, with a gap where one is not in the view. */
function pathOf(places: readonly (ScreenPoint | undefined)[]): string {
  return places
    .map(
      (place, i) =>
        place && `${i === 0 || !places[i - 1] ? "M" : "L"}${place.x.toFixed(1)} ${place.y.toFixed(1)}`,
    )
    .filter((part) => part !== undefined)
    .join("");
}

function move(element: SVGElement, place: ScreenPoint | undefined): void {
  element.setAttribute("visibility", place ? "visible" : "hidden");
  if (!place) return;
  element.setAttribute("cx", place.x.toFixed(1));
  element.setAttribute("cy", place.y.toFixed(1));
}

function middle(places: readonly (ScreenPoint | undefined)[]): ScreenPoint | undefined {
  const seen = places.filter((place) => place !== undefined);
  if (seen.length === 0) return undefined;
  const sum = seen.reduce((total, { x, y }) => ({ x: total.x + x, y: total.y + y }), { x: 0, y: 0 });
  return { x: sum.x / seen.length, y: sum.y / seen.length };
}

function svgElement<Name extends keyof SVGElementTagNameMap>(name: Name): SVGElementTagNameMap[Name] {
  return document.createElementNS(SVG, name);
}
