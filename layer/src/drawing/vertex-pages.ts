import type { ColumnData } from "../workers/index.js";
import type { Gpu, GpuTypes, VertexInput } from "./gpu.js";
import { bytesOf, type VertexNumbers } from "./vertex-numbers.js";

/** Vertices of the first page; each further one is twice as large as all before it together, up to {@link LARGEST}. */
const SMALLEST = 32_768;
/** Vertices of a page at most, but for a node that has more: some forty nodes. */
const LARGEST = 524_288;
/** Pages are made fewer once less than this share of their vertices is in use. */
const LEAST_USE = 0.5;

const KINDS: readonly PagePositions[] = ["uint16", "float32"];

/** Who lies in a page. */
export interface PageTenant {
  /** Goes to another place, since its page is given up. */
  move(to: PageSlot<GpuTypes>): void;
}

/** How the positions of a page are stored, which is the same for all of its nodes. */
export type PagePositions = Extract<VertexNumbers, "uint16" | "float32">;

/** A run of the vertices of a page. */
export interface PageSlot<T extends GpuTypes> {
  readonly page: VertexPage<T>;
  /** Its first vertex. */
  readonly first: number;
  readonly count: number;
}

/** Vertices that nobody has. */
interface Gap {
  first: number;
  count: number;
}

/** What several nodes of a page use, and how many of them do. */
interface Shared<Thing> {
  readonly thing: Thing;
  users: number;
}

/**
 * Vertices of several nodes: a buffer for each column that one of them has, and a vertex array for each set of columns that
 * programs read, so that nodes which lie here can be drawn by one call.
 */
export class VertexPage<T extends GpuTypes> {
  /** Its number among the pages that there are; one that is given up leaves it to another. */
  readonly number: number;
  readonly capacity: number;
  readonly positions: PagePositions;
  readonly #gpu: Gpu<T>;
  readonly #gaps: Gap[];
  readonly #tenants = new Map<PageSlot<T>, PageTenant>();
  readonly #buffers = new Map<string, Shared<T["buffer"]>>();
  readonly #arrays = new Map<string, Shared<T["vertexArray"]>>();
  #used = 0;

  constructor(gpu: Gpu<T>, number: number, capacity: number, positions: PagePositions) {
    this.#gpu = gpu;
    this.number = number;
    this.capacity = capacity;
    this.positions = positions;
    this.#gaps = [{ first: 0, count: capacity }];
  }

  /** Vertices that nodes have. */
  get used(): number {
    return this.#used;
  }

  get tenants(): ReadonlyMap<PageSlot<T>, PageTenant> {
    return this.#tenants;
  }

  /** Gives a tenant vertices that follow each other; undefined where there are not so many. */
  reserve(count: number, tenant: PageTenant): PageSlot<T> | undefined {
    const at = this.#gaps.findIndex((gap) => gap.count >= count);
    if (at < 0) return undefined;
    const gap = this.#gaps[at];
    const slot = { page: this, first: gap.first, count };
    gap.first += count;
    gap.count -= count;
    if (gap.count === 0) this.#gaps.splice(at, 1);
    this.#used += count;
    this.#tenants.set(slot, tenant);
    return slot;
  }

  /** Takes vertices back; others may have them from now on. */
  release(slot: PageSlot<T>): void {
    if (!this.#tenants.delete(slot)) return;
    const { first, count } = slot;
    this.#used -= count;
    const gaps = this.#gaps;
    const after = gaps.findIndex((gap) => gap.first > first);
    const at = after < 0 ? gaps.length : after;
    gaps.splice(at, 0, { first, count });
    this.#join(at);
    if (at > 0) this.#join(at - 1);
  }

  /** How the numbers of a column are stored here; undefined where no node has it. */
  numbersOf(column: string, among: readonly VertexNumbers[]): VertexNumbers | undefined {
    return among.find((numbers) => this.#buffers.has(`${column}:${numbers}`));
  }

  /** Writes a node's numbers of a column. @returns the name of the buffer, to be given back by {@link leave} */
  write(
    { first }: PageSlot<T>,
    column: string,
    components: number,
    numbers: VertexNumbers,
    data: ColumnData,
  ): string {
    const name = `${column}:${numbers}`;
    const bytes = components * bytesOf(numbers);
    const shared = share(this.#buffers, name, () => this.#gpu.vertexBuffer(this.capacity * bytes));
    this.#gpu.writeBuffer(shared, data, first * bytes);
    return name;
  }

  /** A buffer that a node has written to. */
  bufferOf(name: string): T["buffer"] {
    const shared = this.#buffers.get(name);
    if (!shared) throw new Error(`a page has no buffer ${name}`);
    return shared.thing;
  }

  /** The vertex array of a name, for one more node; to be given back by {@link leaveArray}. */
  array(name: string, inputs: readonly VertexInput<T["buffer"]>[]): T["vertexArray"] {
    return share(this.#arrays, name, () => this.#gpu.vertexArray(inputs));
  }

  leave(buffer: string): void {
    this.#leave(this.#buffers, buffer);
  }

  leaveArray(array: string): void {
    this.#leave(this.#arrays, array);
  }

  #leave(things: Map<string, Shared<T["buffer"] | T["vertexArray"]>>, name: string): void {
    const shared = things.get(name);
    if (!shared) return;
    shared.users--;
    if (shared.users > 0) return;
    things.delete(name);
    this.#gpu.free(shared.thing);
  }

  /** Joins a gap with the one behind it where they touch. */
  #join(at: number): void {
    const gap = this.#gaps[at];
    const next = this.#gaps[at + 1];
    if (!next || gap.first + gap.count !== next.first) return;
    gap.count += next.count;
    this.#gaps.splice(at + 1, 1);
  }
}

/** A thing by name for one more user, made where it is not there. */
function share<Thing>(things: Map<string, Shared<Thing>>, name: string, make: () => Thing): Thing {
  const there = things.get(name);
  if (there) {
    there.users++;
    return there.thing;
  }
  const thing = make();
  things.set(name, { thing, users: 1 });
  return thing;
}

/**
 * The vertices of a layer's nodes on the GPU, in pages that nodes share: buffers as few as they can be, and no more than
 * twice as large as what lies in them once {@link tidy} has done its work, but for one page of each kind: positions are stored
 * in 8 bytes or in 12, and what a call draws is stored in one way.
 */
export class VertexPages<T extends GpuTypes> {
  readonly #gpu: Gpu<T>;
  #pages: VertexPage<T>[] = [];
  /** Whether vertices were given back since the pages were looked at. */
  #released = false;

  constructor(gpu: Gpu<T>) {
    this.#gpu = gpu;
  }

  get pages(): readonly VertexPage<T>[] {
    return this.#pages;
  }

  /** Vertices for a tenant: in a page that has as many left in a row, else in a new one. */
  reserve(count: number, tenant: PageTenant, positions: PagePositions): PageSlot<T> {
    const pages = this.#of(positions);
    for (const page of pages) {
      const slot = page.reserve(count, tenant);
      if (slot) return slot;
    }
    const capacity = Math.max(count, grown(sumOf(pages, "capacity")));
    return reserved(this.#add(capacity, positions), count, tenant);
  }

  /** Takes vertices back; a page that is empty is given up. */
  release(slot: PageSlot<T>): void {
    slot.page.release(slot);
    this.#released = true;
    if (slot.page.used === 0) this.#pages = this.#pages.filter((page) => page !== slot.page);
  }

  /**
   * Moves the nodes of the two pages that are least full into one, where much of all that store positions alike is empty. To be
   * called before what is drawn in a frame is listed.
   */
  tidy(): void {
    if (!this.#released) return;
    // Both kinds have their turn.
    this.#released = KINDS.map((positions) => this.#join(positions)).includes(true);
  }

  /** @returns whether pages were joined, so that there may be others to join */
  #join(positions: PagePositions): boolean {
    const pages = this.#of(positions);
    if (sumOf(pages, "used") >= LEAST_USE * sumOf(pages, "capacity")) return false;
    const emptiest = pages.sort((a, b) => a.used / a.capacity - b.used / b.capacity).slice(0, 2);
    const capacity = Math.max(SMALLEST, sumOf(emptiest, "used"));
    if (capacity >= sumOf(emptiest, "capacity")) return false;
    const page = this.#add(capacity, positions);
    for (const { tenants } of emptiest) {
      for (const [{ count }, tenant] of [...tenants]) tenant.move(reserved(page, count, tenant));
    }
    return true;
  }

  #of(positions: PagePositions): VertexPage<T>[] {
    return this.#pages.filter((page) => page.positions === positions);
  }

  #add(capacity: number, positions: PagePositions): VertexPage<T> {
    let number = 0;
    while (this.#pages.some((page) => page.number === number)) number++;
    const page = new VertexPage(this.#gpu, number, capacity, positions);
    this.#pages.push(page);
    return page;
  }
}

/** Vertices that pages have room for, or that are used of them. */
function sumOf(
  pages: readonly Pick<VertexPage<GpuTypes>, "used" | "capacity">[],
  of: "used" | "capacity",
): number {
  return pages.reduce((sum, page) => sum + page[of], 0);
}

/** Vertices of the page after so many. */
function grown(capacity: number): number {
  return Math.min(LARGEST, Math.max(SMALLEST, 2 * capacity));
}

function reserved<T extends GpuTypes>(page: VertexPage<T>, count: number, tenant: PageTenant): PageSlot<T> {
  const slot = page.reserve(count, tenant);
  if (!slot) throw new Error(`a page of ${page.capacity} vertices has no room for ${count}`);
  return slot;
}
