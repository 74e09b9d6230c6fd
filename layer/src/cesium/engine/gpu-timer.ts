import { ClearCommand, type Command, type Context, Pass } from "./cesium-private.js";
import type { GpuObjects } from "./gpu-objects.js";

/** `EXT_disjoint_timer_query_webgl2`. */
interface TimerExtension {
  readonly TIME_ELAPSED_EXT: number;
  readonly GPU_DISJOINT_EXT: number;
}

/** Frames in flight at once; further frames go unmeasured until one is answered. */
const IN_FLIGHT = 4;

/** Frames of which one is measured once a label has a mean: to begin, end, ask for and free a query takes some 0.05 ms of script. */
const EVERY = 4;

/** Share of a new value in the running mean. */
const SHARE = 0.5;

/** Labels whose means are remembered: styles and filters come in numbers without end. */
const REMEMBERED = 64;

/** One measured stretch of the GPU's work. */
interface Measurement {
  readonly label: string;
  readonly frame: number;
  readonly query: WebGLQuery;
  destroy(): void;
}

/**
 * GPU time of stretches of a frame, as running means in milliseconds, by `EXT_disjoint_timer_query_webgl2`. Where the
 * browser lacks it, nothing is measured and {@link supported} is false. Answers come some frames later; the GPU is
 * never waited for.
 */
export class GpuTimer {
  readonly supported: boolean;
  readonly #gl: WebGL2RenderingContext;
  readonly #extension: TimerExtension | undefined;
  readonly #objects: GpuObjects;
  readonly #pending: Measurement[] = [];
  readonly #means = new Map<string, number>();
  #open: Measurement | undefined;
  #frame = 0;

  constructor(context: Context, objects: GpuObjects) {
    this.#gl = context._gl;
    this.#objects = objects;
    const extension: unknown = this.#gl.getExtension("EXT_disjoint_timer_query_webgl2");
    this.#extension = isTimer(extension) ? extension : undefined;
    this.supported = this.#extension !== undefined;
  }

  /** Milliseconds of a label's stretch, running mean; undefined until one was measured. */
  milliseconds(label: string): number | undefined {
    return this.#means.get(label);
  }

  /** Begins a frame, and takes the answers that are here. */
  nextFrame(): void {
    this.#frame++;
    this.#collect();
  }

  /** Runs what sends work to the GPU and measures it; stretches do not nest. */
  measure(label: string, work: () => void): void {
    this.begin(label);
    try {
      work();
    } finally {
      this.end();
    }
  }

  /** Begins a stretch. Those of one label in one frame, as in several frusta, are added up: all are measured, or none. */
  begin(label: string): void {
    // Means come with a new frame alone.
    if (this.#means.has(label) && this.#frame % EVERY !== 0) return;
    const behind = this.#frame - (this.#pending[0]?.frame ?? this.#frame);
    if (!this.#extension || this.#open || behind >= IN_FLIGHT) return;
    const gl = this.#gl;
    const query = gl.createQuery();
    if (!query) return;
    this.#open = { label, frame: this.#frame, query, destroy: () => gl.deleteQuery(query) };
    this.#objects.own("queries", this.#open);
    gl.beginQuery(this.#extension.TIME_ELAPSED_EXT, query);
  }

  end(): void {
    if (!this.#extension || !this.#open) return;
    this.#gl.endQuery(this.#extension.TIME_ELAPSED_EXT);
    this.#pending.push(this.#open);
    this.#open = undefined;
  }

  #collect(): void {
    for (let first = this.#pending[0]; first && this.#extension; first = this.#pending[0]) {
      const { frame } = first;
      const stretches = this.#pending.filter((stretch) => stretch.frame === frame);
      const gl = this.#gl;
      // What ran while the GPU changed its clock cannot be trusted.
      const disjoint = gl.getParameter(this.#extension.GPU_DISJOINT_EXT) === true;
      const here = ({ query }: Measurement) =>
        gl.getQueryParameter(query, gl.QUERY_RESULT_AVAILABLE) === true;
      if (!disjoint && !stretches.every(here)) return;
      const sums = new Map<string, number>();
      for (const stretch of stretches) {
        const { label, query } = stretch;
        if (!disjoint) {
          const nanoseconds = Number(gl.getQueryParameter(query, gl.QUERY_RESULT));
          sums.set(label, (sums.get(label) ?? 0) + nanoseconds / 1e6);
        }
        this.#objects.free(stretch);
      }
      this.#pending.splice(0, stretches.length);
      for (const [label, milliseconds] of sums) this.#note(label, milliseconds);
    }
  }

  #note(label: string, milliseconds: number): void {
    const mean = this.#means.get(label);
    // The one measured last stands last.
    this.#means.delete(label);
    this.#means.set(label, mean === undefined ? milliseconds : mean + SHARE * (milliseconds - mean));
    const [oldest] = this.#means.keys();
    if (this.#means.size > REMEMBERED && oldest !== undefined) this.#means.delete(oldest);
  }
}

function isTimer(extension: unknown): extension is TimerExtension {
  return typeof extension === "object" && extension !== null && "TIME_ELAPSED_EXT" in extension;
}

/**
 * A command that clears nothing and calls a function where Cesium comes to it: in every frustum, between the commands
 * of its pass before and after it in the list.
 */
export function hookCommand(owner: object, call: () => void): Command {
  const command = new ClearCommand({ owner, pass: Pass.OPAQUE });
  return Object.assign(command, { execute: call });
}
