import type { Column, ColumnData } from "../workers/index.js";
import type { DrawnVertices } from "./drawn-vertices.js";
import type { Gpu, GpuTypes, VertexInput } from "./gpu.js";
import { type AttributeSet, constantValue, POSITION } from "./vertex-attributes.js";

/**
 * The points of a node on the GPU: a buffer for their places and one for each attribute that is asked for, and the
 * vertex arrays that programs read them through.
 */
export class NodeBuffers<T extends GpuTypes> {
  readonly vertices: DrawnVertices;
  readonly #gpu: Gpu<T>;
  /** The colours that it was made with. */
  readonly #colours: Column | undefined;
  readonly #buffers = new Map<string, T["buffer"]>();
  readonly #arrays = new Map<string, T["vertexArray"]>();
  #bytes = 0;

  constructor(gpu: Gpu<T>, vertices: DrawnVertices) {
    this.#gpu = gpu;
    this.vertices = vertices;
    this.#colours = vertices.columns.get("rgb");
  }

  /** Whether the node has other colours by now: those of foreign files may turn out to be of 16 bits. */
  get outdated(): boolean {
    return this.vertices.columns.get("rgb") !== this.#colours;
  }

  /** Bytes on the GPU. */
  get bytes(): number {
    return this.#bytes;
  }

  /** Whether programs that read these attributes can draw the node. */
  has({ signature }: AttributeSet): boolean {
    return this.#arrays.has(signature);
  }

  /** Puts on the GPU what programs with these attributes need. */
  upload(set: AttributeSet): void {
    this.array(set);
  }

  /** Frees what programs with other attributes than these read. */
  keep(sets: readonly AttributeSet[]): void {
    const signatures = new Set(sets.map(({ signature }) => signature));
    for (const [signature, array] of this.#arrays) {
      if (signatures.has(signature)) continue;
      this.#gpu.free(array);
      this.#arrays.delete(signature);
    }
    const columns = new Set([POSITION, ...sets.flatMap((set) => set.columns)]);
    for (const [column, buffer] of this.#buffers) {
      if (columns.has(column)) continue;
      this.#buffers.delete(column);
      this.#bytes -= buffer.sizeInBytes;
      this.#gpu.free(buffer);
    }
  }

  /** Frees all that the node has on the GPU. */
  destroy(): void {
    for (const array of this.#arrays.values()) this.#gpu.free(array);
    for (const buffer of this.#buffers.values()) this.#gpu.free(buffer);
    this.#arrays.clear();
    this.#buffers.clear();
    this.#bytes = 0;
  }

  /** The vertex array of a set of attributes, made where it is not there. */
  protected array({ attributes, signature }: AttributeSet): T["vertexArray"] {
    const found = this.#arrays.get(signature);
    if (found) return found;
    const inputs = attributes.map((attribute): VertexInput<T["buffer"]> => {
      const { location, components, normalized, column } = attribute;
      const data = this.#data(column);
      if (data) return { location, components, normalized, data, buffer: this.#buffer(column, data) };
      return { location, value: constantValue(attribute, this.vertices.columns.get(column)) };
    });
    const array = this.#gpu.vertexArray(inputs);
    this.#arrays.set(signature, array);
    return array;
  }

  #buffer(column: string, data: ColumnData): T["buffer"] {
    const found = this.#buffers.get(column);
    if (found) return found;
    const buffer = this.#gpu.vertexBuffer(data);
    this.#buffers.set(column, buffer);
    this.#bytes += buffer.sizeInBytes;
    return buffer;
  }

  /** The numbers of a column; undefined where all points share one value. */
  #data(column: string): ColumnData | undefined {
    if (column === POSITION) return this.vertices.positions;
    const data = this.vertices.columns.get(column)?.data;
    return data && data.length > 0 ? data : undefined;
  }
}
