import { geodesicFrom } from "@groma/georef";
import { Clip, ClipSet, PointCloud, PointCloudLayer } from "@groma/layer/cesium";
import { onPoints } from "../../browser/stage/point-calls.js";
import { Stage } from "../../browser/stage/stage.js";
import { ManyNodes } from "./many-nodes.js";
import { frame, phase, within, wrap } from "./marks.js";
import { markGl, markLayer, markMessages } from "./parts.js";

/** CSS pixels. */
const SIZE = { width: 960, height: 600 };

/** Frames of a flight, and of something dragged. */
const FLIGHT = 60;
const DRAG = 20;

/** Milliseconds. */
const LONGEST = 120_000;

type Point = readonly [number, number, number];

/** A scene of one scan that is taken through what a user does, with marks for {@link phase} and {@link frame}. */
class Frames {
  readonly #stage: Stage;
  readonly #clips = new ClipSet();

  constructor() {
    this.#stage = new Stage(SIZE);
    const { gl, scene } = this.#stage;
    // Points are not rasterised: in software that is done by the same cores, and is none of the layer's.
    onPoints(gl, (call) => call.draw("none"));
    markGl(gl);
    markLayer();
    markMessages();
    wrap(scene, ["render"], "scene");
  }

  /** @param at source coordinates of what is looked at */
  async run(address: string, at: Point): Promise<void> {
    const cloud = await PointCloud.fromUrl(address, { limits: { cacheBytes: 2 ** 30 } });
    const stage = this.#stage;
    const look = (range: number, heading: number) => stage.look({ at, range, heading, pitch: -35 });
    await this.#phase("first view", 1, () => {
      stage.layer = PointCloudLayer.fromCloud(cloud, { clips: this.#clips });
      stage.scene.primitives.add(stage.layer);
      look(900, 0);
    });
    await this.#phase("at rest", 30, () => {});
    await this.#phase("flight", FLIGHT, (step) => look(900 - 11 * step, 2 * step));
    await this.#restyle();
    await this.#cut(cloud, at);
  }

  async #restyle(): Promise<void> {
    const plain = {
      color: "rgb",
      size: "fixed",
      shape: "square",
      eyeDomeLighting: false,
      splats: false,
    } as const;
    const styles = {
      intensity: { color: "intensity" },
      elevation: { color: "elevation" },
      "attenuated size": { size: "attenuated" },
      "adaptive size": { size: "adaptive" },
      discs: { shape: "disc" },
      "Eye-Dome Lighting": { eyeDomeLighting: true },
      splats: { splats: true },
      "as at first": plain,
    } as const;
    for (const [name, style] of Object.entries(styles)) {
      await this.#phase(`style: ${name}`, 1, () => {
        this.#stage.layer.style = style;
      });
    }
  }

  async #cut(cloud: PointCloud, at: Point): Promise<void> {
    const box = (step: number) => {
      const center = { source: [at[0] + 5 * step, at[1], at[2]] } as const;
      return Clip.box({ center, size: [300, 300, 400], heading: 0.3 });
    };
    const { longitude, latitude } = middleOf(cloud);
    const star = (corners: number, step: number) =>
      Clip.polygon(ring(longitude, latitude, corners, step / 100));
    const wide = (step: number) =>
      Clip.polygon(sourceRing(at, 500, step / 100), { coordinates: "source", mode: "outside" });
    await this.#clip("box", box);
    await this.#clip("500 corners", (step) => star(500, step));
    await this.#clip("500 corners, source", wide);
    await this.#clip("20,000 corners", (step) => star(20_000, step), 0);
  }

  async #clip(name: string, clip: (step: number) => Clip, steps = DRAG): Promise<void> {
    // Made beforehand: what the application's own rings take is none of the layer's.
    const places = Array.from({ length: steps + 1 }, (_, step) => clip(step));
    let shown = places[0]!;
    await this.#phase(`${name}: added`, 1, () => void this.#clips.add(shown));
    if (steps > 0) {
      await this.#phase(`${name}: dragged`, steps, (step) => {
        shown = this.#clips.replace(shown, places[step]!);
      });
    }
    await this.#phase(`${name}: removed`, 1, () => void this.#clips.remove(shown));
  }

  /** Draws frames with something done before each, then until all is shown, and some more. */
  async #phase(name: string, frames: number, act: (step: number) => void): Promise<void> {
    phase(name);
    const end = performance.now() + LONGEST;
    for (let step = 1; step <= frames; step++) await this.#frame(() => act(step));
    do await this.#frame();
    while (!this.#stage.layer.settled && performance.now() < end);
    if (performance.now() >= end) throw new Error(`${name} does not settle`);
    // What a change leaves for later is its own.
    for (let left = 5; left > 0; left--) await this.#frame();
  }

  async #frame(before?: () => void): Promise<void> {
    frame();
    if (before) within("call", before);
    this.#stage.frame();
    // The GPU, and its software, are let finish, so that no call of the next frame waits for them.
    this.#stage.wait();
    await new Promise((done) => setTimeout(done, 5));
  }
}

/** Longitude and latitude of the middle of the points, radians. */
function middleOf({ bounds: { x, y, z } }: PointCloud) {
  return { longitude: Math.atan2(y, x), latitude: Math.atan2(z, 0.9933056 * Math.hypot(x, y)) };
}

/** A star whose points reach 100 to 300 m far. */
function ring(longitude: number, latitude: number, corners: number, turn: number) {
  return Array.from({ length: corners }, (_, index) => {
    const azimuth = (-2 * Math.PI * index) / corners + turn;
    const end = geodesicFrom(longitude, latitude, azimuth, reach(index));
    return [end.longitude, end.latitude] as const;
  });
}

function sourceRing([x, y]: Point, corners: number, turn: number) {
  return Array.from({ length: corners }, (_, index) => {
    const angle = (2 * Math.PI * index) / corners + turn;
    return [x + reach(index) * Math.cos(angle), y + reach(index) * Math.sin(angle)] as const;
  });
}

function reach(index: number): number {
  return 200 + 100 * Math.sin(0.3 * index);
}

Object.assign(window, { Frames, ManyNodes });
document.body.dataset.ready = "true";
