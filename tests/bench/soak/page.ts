import {
  Clip,
  type ClipSet,
  PointCloud,
  PointCloudLayer,
  type PointFilter,
  type StyleParts,
} from "@groma/layer/cesium";
import { onPoints } from "../../browser/stage/point-calls.js";
import { Stage } from "../../browser/stage/stage.js";

/** CSS pixels. */
const SIZE = { width: 480, height: 300 };

/** Vertices that are kept, bytes: little, so that nodes come and go from the beginning. */
const CACHE = 48 * 2 ** 20;

/** Frames of one flight. */
const FLIGHT = 8;

/** Milliseconds within which a view has to be complete: many, for a machine may be busy with other things. */
const PATIENCE = 15 * 60_000;

type Point = readonly [number, number, number];

/** How the layer is drawn when it is measured. */
const PLAIN = {
  color: "rgb",
  size: "fixed",
  shape: "square",
  opacity: 1,
  gamma: 1,
  eyeDomeLighting: false,
  splats: false,
  dithering: false,
  blend: undefined,
} as const satisfies StyleParts;

/** A layer that is flown about, restyled, filtered and cut without end, as by a user who leaves a page open all day. */
class Soak {
  readonly #stage: Stage;
  readonly #at: Point;
  #rounds = 0;
  #seed = 1;

  private constructor(stage: Stage, at: Point) {
    this.#stage = stage;
    this.#at = at;
  }

  /** @param at source coordinates of the middle of what is looked at */
  static async open(address: string, at: Point): Promise<Soak> {
    const cloud = await PointCloud.fromUrl(address, { limits: { cacheBytes: CACHE }, workers: { size: 1 } });
    const stage = new Stage(SIZE);
    const { gl } = stage;
    const scene = stage.scene as typeof stage.scene & { initializeFrame(): void };
    // As Cesium's widgets do: it is here that Cesium gives up programs that were freed.
    const render = scene.render.bind(scene);
    scene.render = (time) => {
      scene.initializeFrame();
      render(time);
    };
    // Points are not rasterised: in software that takes the time of many a change.
    onPoints(gl, (call) => call.draw("none"));
    stage.layer = PointCloudLayer.fromCloud(cloud, { pointBudget: 500_000 });
    stage.scene.primitives.add(stage.layer);
    return new Soak(stage, at);
  }

  /** Flies, restyles, filters, cuts and picks for so many milliseconds, then comes home. @returns what there is then */
  async run(milliseconds: number) {
    const end = performance.now() + milliseconds;
    while (performance.now() < end) await this.#round();
    await this.#home();
    const { gpuBytes, gpuObjects, pointsDrawn } = this.#stage.layer.statistics;
    if (pointsDrawn === 0) throw new Error("nothing is drawn");
    return { rounds: this.#rounds, gpuBytes, gpuObjects, pointsDrawn };
  }

  async #round(): Promise<void> {
    this.#rounds++;
    const { layer } = this.#stage;
    layer.style = this.#style();
    layer.filter = this.#filter();
    this.#cut(layer.clips);
    const [heading, range] = [this.#up(360), 150 + this.#up(900)];
    for (let step = 1; step <= FLIGHT; step++) {
      this.#look(heading + 3 * step, range * (1 - step / 30));
      this.#stage.frame();
      await new Promise((done) => setTimeout(done));
    }
    if (this.#rounds % 2 === 0) await this.#stage.settle(undefined, PATIENCE);
    const window = 1 + 2 * Math.floor(this.#up(20));
    await layer.pick({ x: this.#up(SIZE.width), y: this.#up(SIZE.height) }, { window });
  }

  /** The state in which all is measured. */
  async #home(): Promise<void> {
    const { layer } = this.#stage;
    layer.style = PLAIN;
    layer.filter = undefined;
    layer.clips.clear();
    this.#look(0, 600);
    await this.#stage.settle(undefined, PATIENCE);
    await layer.pick({ x: SIZE.width / 2, y: SIZE.height / 2 });
  }

  #style(): StyleParts {
    const colours = ["rgb", "intensity", "classification", "elevation", "levelOfDetail", "gpsTime"];
    return {
      color: this.#one(colours),
      gradient: this.#one(["viridis", "turbo", "greyscale"] as const),
      size: this.#one(["fixed", "attenuated", "adaptive"] as const),
      shape: this.#one(["square", "disc", "paraboloid"] as const),
      gamma: this.#one([1, 1 + this.#up(1)]),
      opacity: this.#one([1, 1, 0.6]),
      eyeDomeLighting: this.#one([true, false, "auto"] as const),
      splats: this.#one([true, false, "auto"] as const),
      dithering: this.#one([true, false]),
      blend: this.#one([undefined, { color: this.#one(colours), share: this.#up(1) }]),
    };
  }

  #filter(): PointFilter | undefined {
    const columns = ["intensity", "gpsTime", "elevation", "returnNumber", "scanAngle"];
    const ranges = columns.flatMap((name) => {
      const found = this.#stage.layer.cloud.attributes.find((attribute) => attribute.name === name);
      const [least = 0, greatest = 1] = found?.range ?? [];
      const width = greatest - least;
      return found && this.#up(1) < 0.3 ? [[name, [least + this.#up(width / 4), greatest]] as const] : [];
    });
    const classes = this.#one([undefined, [2, 5, 6]]);
    const returns = this.#one([undefined, ["first", "last"] as const]);
    return this.#one([undefined, { classes, returns, ranges: Object.fromEntries(ranges) }]);
  }

  #cut(clips: ClipSet): void {
    const [x, y, z] = this.#at;
    const near = (width: number) => (this.#up(2) - 1) * width;
    const center = { source: [x + near(200), y + near(200), z] as const };
    const mode = this.#one(["inside", "outside", "highlight"] as const);
    const edge = 100 + this.#up(400);
    const ring = Array.from({ length: 40 }, (_, corner) => {
      const angle = (2 * Math.PI * corner) / 40;
      return [x + edge * Math.cos(angle), y + (corner % 2 ? 0.6 : 1) * edge * Math.sin(angle)] as const;
    });
    clips.clear();
    if (this.#up(1) < 0.6)
      clips.add(Clip.box({ center, mode, size: [edge, edge, 500], heading: this.#up(3) }));
    if (this.#up(1) < 0.4) clips.add(Clip.polygon(ring, { coordinates: "source", mode }));
  }

  #look(heading: number, range: number): void {
    this.#stage.look({ at: [...this.#at], heading, range, pitch: -40 });
  }

  /** A number from 0 up to another: the same ones in every run (D. Lehmer's generator, modulus 2³¹ − 1). */
  #up(to: number): number {
    this.#seed = (48_271 * this.#seed) % 2_147_483_647;
    return (to * this.#seed) / 2_147_483_647;
  }

  #one<T>(choices: readonly T[]): T {
    return choices[Math.floor(this.#up(choices.length))]!;
  }
}

Object.assign(window, { Soak });
document.body.dataset.ready = "true";
