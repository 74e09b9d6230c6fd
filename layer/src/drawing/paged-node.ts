import { inSteps } from "../effects/index.js";
import type { Column, ColumnData } from "../workers/index.js";
import type { DrawnVertices } from "./drawn-vertices.js";
import type { GpuTypes, VertexInput } from "./gpu.js";
import { type AttributeSet, POSITION, storedConstant } from "./vertex-attributes.js";
import { bytesOf, numbersFor, numbersOf, repeated, type VertexNumbers } from "./vertex-numbers.js";
import type { PagePositions, PageSlot, PageTenant, VertexPages } from "./vertex-pages.js";

/** A column that a node has in its page. */
interface PagedColumn {
  /** Name of the page's buffer. */
  readonly buffer: string;
  readonly numbers: VertexNumbers;
  readonly components: number;
  /** Bytes that the node's points take there. */
  readonly bytes: number;
}

/** A vertex array that a node is drawn with. */
interface PagedArray<T extends GpuTypes> {
  readonly set: AttributeSet;
  readonly name: string;
  readonly array: T["vertexArray"];
}

/**
 * The points of a node on the GPU: vertices of a page that it shares with others, their places and each attribute that is
 * asked for.
 */
export class PagedNode<T extends GpuTypes> implements PageTenant {
  readonly vertices: DrawnVertices;
  readonly count: number;
  readonly slot: number;
  readonly #pages: VertexPages<T>;
  /** The colours that it was made with. */
  readonly #colours: Column | undefined;
  readonly #columns = new Map<string, PagedColumn>();
  readonly #arrays = new Map<string, PagedArray<T>>();
  /** What was last asked for, most likely the next as well. */
  #lastSet: AttributeSet | undefined;
  #lastArray: T["vertexArray"] | undefined;
  #place: PageSlot<T> | undefined;
  // What each frame reads of its place stands in the node itself, whose memory it reads in any case.
  #page = 0;
  #first = 0;
  #bytes = 0;

  /** @param slot its number among all that is on the GPU */
  constructor(pages: VertexPages<T>, vertices: DrawnVertices, slot: number) {
    this.#pages = pages;
    this.vertices = vertices;
    this.count = vertices.count;
    this.slot = slot;
    this.#colours = vertices.columns.get("rgb");
  }

  /** Whether the node has other colours by now: those of foreign files may turn out to be of 16 bits. */
  get outdated(): boolean {
    return this.vertices.columns.get("rgb") !== this.#colours;
  }

  /** Bytes of its page that the node fills. */
  get bytes(): number {
    return this.#bytes;
  }

  /** Number of its page; nodes of one page can be drawn by one call. */
  get page(): number {
    return this.#page;
  }

  /** How its positions are stored: four uint16 where they lie at whole steps, else three float32. */
  get positions(): PagePositions {
    return this.vertices.step === undefined ? "float32" : "uint16";
  }

  /** Its first vertex in the page. */
  get first(): number {
    return this.#first;
  }

  /** Whether programs that read these attributes can draw the node. */
  has(set: AttributeSet): boolean {
    return this.#lastSet === set || this.#arrays.has(set.signature);
  }

  /** Puts on the GPU what programs with these attributes need. */
  upload(set: AttributeSet): void {
    this.arrayOf(set);
  }

  /** The vertex array that programs with these attributes read, made where it is not there. */
  arrayOf(set: AttributeSet): T["vertexArray"] {
    if (this.#lastSet === set && this.#lastArray) return this.#lastArray;
    const found = this.#arrays.get(set.signature);
    if (found) {
      this.#lastSet = set;
      this.#lastArray = found.array;
      return found.array;
    }
    const slot = this.#place ?? this.#take(this.#pages.reserve(this.count, this, this.positions));
    const { page } = slot;
    const inputs = set.attributes.map((attribute): VertexInput<T["buffer"]> => {
      const { location, normalized, column } = attribute;
      const paged = this.#columns.get(column) ?? this.#write(slot, attribute);
      if (!paged) return { location, value: storedConstant(attribute.components, undefined) };
      const { buffer, numbers, components } = paged;
      return { location, components, normalized, numbers, buffer: page.bufferOf(buffer) };
    });
    const stored = set.columns.map((column) => this.#columns.get(column)?.numbers ?? "");
    const name = `${set.signature} ${stored}`;
    const array = page.array(name, inputs);
    this.#arrays.set(set.signature, { set, name, array });
    return array;
  }

  /** Frees what programs with other attributes than these read. */
  keep(sets: readonly AttributeSet[]): void {
    this.#forget();
    const signatures = new Set(sets.map(({ signature }) => signature));
    for (const [signature, { name }] of this.#arrays) {
      if (signatures.has(signature)) continue;
      this.#place?.page.leaveArray(name);
      this.#arrays.delete(signature);
    }
    const columns = new Set([POSITION, ...sets.flatMap((set) => set.columns)]);
    for (const [column, { buffer, bytes }] of this.#columns) {
      if (columns.has(column)) continue;
      this.#place?.page.leave(buffer);
      this.#columns.delete(column);
      this.#bytes -= bytes;
    }
  }

  move(to: PageSlot<T>): void {
    const sets = [...this.#arrays.values()].map(({ set }) => set);
    this.destroy();
    this.#take(to);
    for (const set of sets) this.upload(set);
  }

  /** Frees all that the node has on the GPU. */
  destroy(): void {
    const slot = this.#place;
    if (!slot) return;
    for (const { name } of this.#arrays.values()) slot.page.leaveArray(name);
    for (const { buffer } of this.#columns.values()) slot.page.leave(buffer);
    this.#arrays.clear();
    this.#forget();
    this.#columns.clear();
    this.#bytes = 0;
    this.#place = undefined;
    this.#pages.release(slot);
  }

  #take(slot: PageSlot<T>): PageSlot<T> {
    this.#place = slot;
    this.#page = slot.page.number;
    this.#first = slot.first;
    return slot;
  }

  #forget(): void {
    this.#lastSet = undefined;
    this.#lastArray = undefined;
  }

  /** Writes a column into the page; undefined where the data set has no such attribute. */
  #write(
    slot: PageSlot<T>,
    { column: name, components, normalized }: AttributeSet["attributes"][number],
  ): PagedColumn | undefined {
    const { count } = this;
    const { positions, step, columns } = this.vertices;
    if (name === POSITION) {
      if (step === undefined) return this.#put(slot, name, 3, "float32", positions);
      return this.#put(slot, name, 4, "uint16", inSteps(positions, step));
    }
    const column = columns.get(name);
    const recorded = column?.data;
    if (!recorded || (recorded.length === 0 && !column.constant)) return undefined;
    let numbers = numbersOf(recorded);
    let data = recorded;
    if (recorded.length === 0) {
      const values = storedConstant(components, column);
      // As the nodes beside it have theirs, so that they are drawn together.
      const fit = numbersFor(values).filter((each) => !normalized || each === "uint8");
      numbers = slot.page.numbersOf(name, fit) ?? fit[0] ?? "uint8";
      data = repeated(values, count, numbers);
    }
    return this.#put(slot, name, components, numbers, data);
  }

  #put(
    slot: PageSlot<T>,
    name: string,
    components: number,
    numbers: VertexNumbers,
    data: ColumnData,
  ): PagedColumn {
    const buffer = slot.page.write(slot, name, components, numbers, data);
    const paged = { buffer, numbers, components, bytes: slot.count * components * bytesOf(numbers) };
    this.#columns.set(name, paged);
    this.#bytes += paged.bytes;
    return paged;
  }
}
