import { eastNorthUp } from "@groma/georef";
import { PointCloud } from "../cloud/index.js";
import { WEBGL2 } from "../effects/webgl2-target.js";
import { tinyCopc } from "../sources/copc/tiny-copc.fixture.js";
import { BlobSource } from "../sources/index.js";
import type { NodeExecutor, NodeVertices } from "../workers/index.js";
import type { LayerRenderer } from "./frame.js";
import type { FrameCamera } from "./frame-camera.js";
import {
  type Destroyable,
  type Gpu,
  type GpuBuffer,
  type GpuKind,
  type GpuTypes,
  NO_OBJECTS,
  type Uniforms,
  type VertexInput,
} from "./gpu.js";
import { LayerContent } from "./layer-content.js";
import { PagedNode } from "./paged-node.js";

/** Points of the data set, all in one node. */
export const POINTS = 10;

/** Uniforms that nobody reads. */
class PlainUniforms implements Uniforms<GpuTypes["texture"]> {
  readonly values = new Map<string, unknown>();

  set(values: Readonly<Record<string, unknown>>): void {
    for (const [name, value] of Object.entries(values)) this.values.set(name, value);
  }

  setTexture(name: string, texture: GpuTypes["texture"]): void {
    this.values.set(name, texture);
  }
}

/** A buffer that keeps what is written into it. */
class TestBuffer implements GpuBuffer {
  readonly #bytes: Uint8Array<ArrayBuffer>;

  constructor(readonly sizeInBytes: number) {
    this.#bytes = new Uint8Array(sizeInBytes);
  }

  write(data: ArrayBufferView, at: number): void {
    this.#bytes.set(new Uint8Array(data.buffer, data.byteOffset, data.byteLength), at);
  }

  /** So many numbers of it, from one on. */
  written<T>(
    kind: new (buffer: ArrayBuffer) => { subarray(begin: number, end: number): T },
    from: number,
    count: number,
  ): T {
    return new kind(this.#bytes.buffer).subarray(from, from + count);
  }

  destroy(): void {}
}

export interface TestTypes extends GpuTypes {
  readonly buffer: TestBuffer;
  readonly uniforms: PlainUniforms;
}

export class TestNode extends PagedNode<TestTypes> {
  lifted = 0;

  lift(heightOffset: number): void {
    this.lifted = heightOffset;
  }
}

export interface TestView extends TestTypes {
  readonly node: TestNode;
}

/** A graphics library that draws nothing and counts what it made. */
export class TestGpu implements Gpu<TestTypes> {
  readonly target = WEBGL2;
  readonly #alive = new Map<Destroyable, { readonly kind: GpuKind; readonly bytes: number }>();
  readonly #read = new WeakMap<Destroyable, readonly TestBuffer[]>();

  get bytes(): number {
    return [...this.#alive.values()].reduce((sum, { bytes }) => sum + bytes, 0);
  }

  get counts() {
    const counts = { ...NO_OBJECTS } as Record<GpuKind, number>;
    for (const { kind } of this.#alive.values()) counts[kind]++;
    return counts;
  }

  /** Those that are alive, as they were made. */
  buffers(): TestBuffer[] {
    return [...this.#alive.keys()].filter((object) => object instanceof TestBuffer);
  }

  /** Those that a vertex array reads. */
  buffersOf(array: Destroyable): readonly TestBuffer[] {
    return this.#read.get(array) ?? [];
  }

  vertexBuffer(bytes: number) {
    return this.#own("buffers", new TestBuffer(bytes), bytes);
  }

  writeBuffer(buffer: TestBuffer, data: ArrayBufferView, at: number): void {
    buffer.write(data, at);
  }

  vertexArray(inputs: readonly VertexInput<TestBuffer>[]) {
    const array = this.#own("vertexArrays", { destroy() {} });
    this.#read.set(
      array,
      inputs.flatMap((input) => ("buffer" in input ? [input.buffer] : [])),
    );
    return array;
  }

  dataTexture({ width, height, data }: { width: number; height: number; data: ArrayBufferView }) {
    return this.#own("textures", { width, height, destroy() {} }, data.byteLength);
  }

  writeTexture(): void {}

  uniforms(): PlainUniforms {
    return new PlainUniforms();
  }

  program() {
    return this.#own("programs", { destroy() {} });
  }

  link(): void {}

  free(object: Destroyable | undefined): void {
    if (object) this.#alive.delete(object);
  }

  #own<T extends Destroyable>(kind: GpuKind, object: T, bytes = 0): T {
    this.#alive.set(object, { kind, bytes });
    return object;
  }
}

/** A view that draws nothing, and notes how many points each frame would draw. */
export class TestRenderer implements LayerRenderer<TestView> {
  readonly gpu = new TestGpu();
  readonly content = new LayerContent<TestView>(
    this.gpu,
    new PlainUniforms(),
    (pages, vertices, slot) => new TestNode(pages, vertices, slot),
  );
  readonly blends = true;
  readonly silhouettes = undefined;
  readonly gpuMilliseconds = { points: undefined, picture: undefined };
  readonly measuresGpu = false;
  readonly drawn: number[] = [];
  /** Whether there is a picture of the points that can be shown again. */
  pictured = false;

  draw(): void {
    this.drawn.push(this.content.nodes.reduce((sum, { count }) => sum + count, 0));
  }

  drawAgain(): boolean {
    if (!this.pictured) this.draw();
    return !this.pictured;
  }

  probe(): boolean {
    return false;
  }
}

/** A data set of one node, whose points are given out without being decoded. */
export async function testCloud(): Promise<PointCloud> {
  let origin: ArrayLike<number> = [0, 0, 0];
  const executor = {
    ...{ addDataSet: () => 1, removeDataSet: () => undefined, pending: 0, destroy: () => undefined },
    run: async () => verticesAt(origin),
  } as unknown as NodeExecutor;
  const source = new BlobSource(new Blob([tinyCopc({ points: POINTS }).slice()]), "tiny.copc.laz");
  const crs = "+proj=utm +zone=32 +ellps=WGS84 +towgs84=0,0,0,0,0,0,0 +units=m";
  const cloud = await PointCloud.fromUrl(source, { executor, crs, vertical: "ellipsoidal" });
  const { x, y, z } = cloud.bounds;
  origin = [x, y, z];
  return cloud;
}

function verticesAt(origin: ArrayLike<number>): NodeVertices {
  return {
    positions: new Float32Array(3 * POINTS),
    columns: new Map(),
    extent: new Float64Array([0, 0, 0, 1, 1, 1]),
    count: POINTS,
    bytes: 12 * POINTS,
    frame: eastNorthUp(origin),
    box: new Float32Array([-1, -1, -1, 1, 1, 1]),
    toCube: new Float32Array([0.1, 0, 0, 0, 0, 0.1, 0, 0, 0, 0, 0.1, 0]),
  } as unknown as NodeVertices;
}

/** A camera that looks at a data set from so many metres above its middle. */
export function cameraOver({ bounds }: PointCloud, metres: number): FrameCamera {
  const away = Math.hypot(bounds.x, bounds.y, bounds.z);
  const up = [bounds.x / away, bounds.y / away, bounds.z / away];
  return {
    view: {
      position: [bounds.x, bounds.y, bounds.z].map((at, axis) => at + metres * up[axis]),
      direction: up.map((part) => -part),
      planes: [],
      height: 600,
      projection: { kind: "perspective", fieldOfView: 1 },
      horizon: false,
    },
    width: 800,
    pixelRatio: 1,
    near: 0.1,
    depth: { own: false, scene: false },
    pose: () => [metres],
  };
}
