import {
  isSameRecord,
  MEASUREMENT_KINDS,
  type Measurement,
  type MeasurementKind,
  type Vertex,
} from "../measure/index.js";

/** A figure that is being drawn. */
export interface Draft {
  readonly kind: MeasurementKind;
  readonly vertices: readonly Vertex[];
}

/** All that is drawn. Never changed, only replaced. */
export interface Drawn {
  readonly measurements: readonly Measurement[];
  readonly draft: Draft | undefined;
}

/** States that are kept to go back to. */
const KEPT = 500;

/** What is drawn, with the way back and forth. */
export class History {
  readonly #past: Drawn[] = [];
  #present: Drawn = { measurements: [], draft: undefined };
  #future: Drawn[] = [];

  get present(): Drawn {
    return this.#present;
  }

  get canUndo(): boolean {
    return this.#past.length > 0;
  }

  get canRedo(): boolean {
    return this.#future.length > 0;
  }

  /** Goes on to another state; the way forth ends. */
  go(next: Drawn): void {
    this.#past.push(this.#present);
    if (this.#past.length > KEPT) this.#past.shift();
    this.#present = next;
    this.#future = [];
  }

  /** Begins a figure: no step to go back to as long as it has no vertex. */
  begin(kind: MeasurementKind): void {
    this.#present = { ...this.#present, draft: { kind, vertices: [] } };
  }

  /** Gives such a figure up. */
  giveUp(): void {
    this.#present = { ...this.#present, draft: undefined };
  }

  /** Has every state, those before and after too, made of other vertices. */
  replaceVertices(other: (vertex: Vertex) => Vertex): void {
    const drawn = ({ measurements, draft }: Drawn): Drawn => ({
      measurements: measurements.map((one) => ({ ...one, vertices: one.vertices.map(other) })),
      draft: draft && { ...draft, vertices: draft.vertices.map(other) },
    });
    this.#past.splice(0, this.#past.length, ...this.#past.map(drawn));
    this.#future = this.#future.map(drawn);
    this.#present = drawn(this.#present);
  }

  /** @returns whether there was anything to go back to */
  undo(): boolean {
    const before = this.#past.pop();
    if (!before) return false;
    this.#future.push(this.#present);
    this.#present = before;
    return true;
  }

  /** @returns whether anything had been taken back */
  redo(): boolean {
    const after = this.#future.pop();
    if (!after) return false;
    this.#past.push(this.#present);
    this.#present = after;
    return true;
  }
}

/** What of a measurement may become another. */
export type MeasurementChange = Partial<Pick<Measurement, "name" | "vertices" | "volume" | "note">>;

/**
 * The vertices of a figure with a further one, and whether that ends it: once more in one place, or back at the beginning of
 * an area, does and adds nothing.
 */
export function grown(
  { kind, vertices }: Draft,
  vertex: Vertex,
): { readonly vertices: readonly Vertex[]; readonly ends: boolean } {
  const { shape, most } = MEASUREMENT_KINDS[kind];
  const last = vertices[vertices.length - 1];
  const closes = shape === "ring" && vertices.length > 2 && isSame(vertices[0], vertex);
  if (closes || (last && isSame(last, vertex))) return { vertices, ends: true };
  return { vertices: [...vertices, vertex], ends: vertices.length + 1 === most };
}

/** Measurements with others behind them. One whose `id` is taken gets another: two of one file may have the same. */
export function withAdded(
  measurements: readonly Measurement[],
  added: readonly Measurement[],
): readonly Measurement[] {
  const taken = new Set(measurements.map(({ id }) => id));
  const fresh = added.map((one) => {
    const id = taken.has(one.id) ? crypto.randomUUID() : one.id;
    taken.add(id);
    return { ...one, id };
  });
  return [...measurements, ...fresh];
}

/** Measurements of which one is changed. */
export function withChange(
  measurements: readonly Measurement[],
  id: string,
  change: MeasurementChange,
): readonly Measurement[] {
  return measurements.map((one) => (one.id === id ? { ...one, ...change } : one));
}

/** A name that none of the measurements has: its kind and a number. */
export function freshName(measurements: readonly Measurement[], title: string): string {
  const names = new Set(measurements.map(({ name }) => name));
  let number = 1;
  while (names.has(`${title} ${number}`)) number++;
  return `${title} ${number}`;
}

/** Whether two vertices are one: the same record, or the same place where they are none. */
export function isSame(a: Vertex, b: Vertex): boolean {
  if (a.record && b.record) return isSameRecord(a, b);
  return a.ecef.every((value, axis) => value === b.ecef[axis]);
}
