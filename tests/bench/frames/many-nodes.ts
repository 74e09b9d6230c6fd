import { PointCloud, PointCloudLayer } from "@groma/layer/cesium";
import { onPoints } from "../../browser/stage/point-calls.js";
import { Stage } from "../../browser/stage/stage.js";
import { frame, phase, within } from "./marks.js";

/** CSS pixels: few, since the frame's script is the same for many. */
const SIZE = { width: 320, height: 200 };

/** Pixels between points, so close that one cloud comes to half of the nodes. */
const ERROR = 0.105;

/** Nodes that are to be drawn at least. */
const NODES = 1000;

/** Poses of the camera that are taken in turn, and how often each is. */
const POSES = 12;
const TURNS = 5;

/** Milliseconds that a view may take until it is complete. */
const LONGEST = 300_000;

/** What was drawn. */
export interface Drawn {
  readonly clouds: number;
  /** Means over all poses. */
  readonly nodes: number;
  readonly points: number;
}

/** A scene of so many clouds that a thousand nodes are drawn, all of which are there before frames are marked. */
export class ManyNodes {
  readonly #stage = new Stage(SIZE);
  readonly #layers: PointCloudLayer[] = [];

  constructor() {
    // Points are not rasterised: in software that is done by the same cores, and is no script.
    onPoints(this.#stage.gl, (call) => call.draw("none"));
  }

  /**
   * Marks frames of a view that moves, of one that stands still, and of the same without any layer.
   * @param address of a scan, which is opened once for each cloud
   * @param at source coordinates of what is looked at
   */
  async run(address: string, at: readonly [number, number, number]): Promise<Drawn> {
    const stage = this.#stage;
    const look = (pose: number) => stage.look({ at, range: 1500 + 5 * pose, heading: pose / 2, pitch: -50 });
    do {
      const cloud = await PointCloud.fromUrl(address, { limits: { cacheBytes: 2 ** 30 } });
      stage.layer = PointCloudLayer.fromCloud(cloud, {
        ...{ pointBudget: Number.POSITIVE_INFINITY, maximumScreenSpaceError: ERROR },
        style: { color: "rgb", size: "fixed", shape: "square", pointSize: 2, eyeDomeLighting: false },
      });
      this.#layers.push(stage.layer);
      stage.scene.primitives.add(stage.layer);
      look(0);
      await stage.settle(this.#layers, LONGEST);
    } while (this.#sum("nodesLoaded") < NODES);
    let [nodes, points] = [0, 0];
    for (let pose = 0; pose < POSES; pose++) {
      look(pose);
      await stage.settle(this.#layers, LONGEST);
      nodes += this.#sum("nodesLoaded") / POSES;
      points += this.#sum("pointsDrawn") / POSES;
    }
    await this.#phase("moving", look);
    await this.#phase("still", () => undefined);
    for (const layer of this.#layers) layer.show = false;
    await this.#phase("empty", look);
    stage.destroy();
    return { clouds: this.#layers.length, nodes: Math.round(nodes), points: Math.round(points) };
  }

  async #phase(name: string, before: (pose: number) => void): Promise<void> {
    // The first frames are those of the phase before.
    for (let warm = 0; warm < POSES; warm++) await this.#frame(() => before(warm), false);
    phase(name);
    for (let count = 0; count < TURNS * POSES; count++) await this.#frame(() => before(count % POSES), true);
  }

  async #frame(before: () => void, marked: boolean): Promise<void> {
    before();
    if (marked) {
      frame();
      within("frame", () => this.#stage.frame());
    } else this.#stage.frame();
    // The GPU, and its software, are let finish, so that no call of the next frame waits for them.
    this.#stage.wait();
    await new Promise((done) => setTimeout(done, 5));
  }

  #sum(of: "nodesLoaded" | "pointsDrawn"): number {
    return this.#layers.reduce((sum, { statistics }) => sum + statistics[of], 0);
  }
}
