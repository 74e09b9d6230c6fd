import { FrameAllowance } from "../drawing/frame-allowance.js";
import {
  layerUniforms,
  type PointCloudStyle,
  type PointFilter,
  passesOf,
  recordTest,
} from "../effects/index.js";
import { OctreeNode } from "../octree/index.js";
import { recordNumbers } from "../query/index.js";
import type { ProfilePoints } from "../tools/cut/profile.js";
import type { PlotView } from "../tools/plot/plot-view.js";
import type { FlatCamera } from "../webgl2/flat-camera.js";
import { LayerRenderer } from "../webgl2/layer-renderer.js";
import type { GlNode } from "../webgl2/node-drawable.js";
import { colourBits, type RecordedNode } from "../workers/index.js";
import { planSeries, plotStyle } from "./plot-plan.js";
import { geodeticOf, type PlottedCloud, SectionVertices } from "./section-vertices.js";

/** How a series is drawn: as a layer is. A `PointCloudLayer` is one. */
export interface PlotDrawing {
  readonly style: PointCloudStyle;
  readonly filter?: PointFilter | undefined;
}

/** The answer of volumes for all nodes: there are none in a plot. */
const WHOLE = { state: "in", count: 0, texels: [] } as const;
const NO_CLIPS = { form: () => 0, of: () => WHOLE, advance: () => undefined };

/** What the canvas shows of a series. */
interface Shown {
  /** All that its nodes look the same by. */
  readonly by: readonly unknown[];
  readonly nodes: readonly GlNode[];
}

/** The points of one cloud in a plot. */
export class PlotSeries {
  readonly #cloud: PlottedCloud;
  readonly #changed: () => void;
  readonly #vertices = new Map<OctreeNode, SectionVertices>();
  #drawing: PlotDrawing;
  #plotted: PointCloudStyle;
  /** What tells of the records of a node whether they are seen. */
  #tests = new WeakMap<RecordedNode, (record: number) => boolean>();
  #bits: 8 | 16;
  #points = 0;
  #deepest = 0;
  #reach = 0;
  #renderer: LayerRenderer | undefined;
  #shown: Shown | undefined;
  #next: Shown = { by: [], nodes: [] };

  /** @internal */
  constructor(cloud: PlottedCloud, drawing: PlotDrawing, changed: () => void) {
    this.#cloud = cloud;
    this.#drawing = drawing;
    this.#plotted = plotStyle(drawing.style);
    this.#changed = changed;
    this.#bits = cloud.appearance?.rgbBits ?? 8;
  }

  get style(): PointCloudStyle {
    return this.#drawing.style;
  }

  get filter(): PointFilter | undefined {
    return this.#drawing.filter;
  }

  /** Draws its points by another style and filter from now on; nothing happens where they are the same. */
  set drawing(drawing: PlotDrawing) {
    const { style, filter } = this.#drawing;
    if (style === drawing.style && filter === drawing.filter) return;
    this.#drawing = { style: drawing.style, filter: drawing.filter };
    this.#tests = new WeakMap();
    this.#plotted = plotStyle(drawing.style);
    this.#changed();
  }

  /** Points that it has. */
  get points(): number {
    return this.#points;
  }

  /** Greatest distance of a point from the line, metres. @internal */
  get reach(): number {
    return this.#reach;
  }

  /** Takes the points of a node: they are in the next pictures. */
  add(points: ProfilePoints): void {
    const { batch, offset } = points;
    if (batch.inside.length === 0) return;
    // Colours taken for 8 bits are of 16 as soon as one is above 255, as on the globe.
    const { appearance } = this.#cloud;
    if (appearance?.rgbBits === 16 || (!appearance?.rgbBitsKnown && colourBits(batch.records) === 16))
      this.#bits = 16;
    const vertices = new SectionVertices(this.#cloud, points, () => this.#bits);
    this.#vertices.set(new OctreeNode(batch.key), vertices);
    this.#points += offset.length;
    this.#deepest = Math.max(this.#deepest, batch.key.depth);
    this.#reach = Math.max(this.#reach, -vertices.box[2]);
    this.#changed();
  }

  /** Whether the style's classes and the filter let a point be seen, by its exact values. */
  shows({ batch: { records, inside } }: ProfilePoints, index: number): boolean {
    let test = this.#tests.get(records);
    if (!test) {
      const { style, filter } = this.#drawing;
      const cloud = this.#cloud;
      const geodetic = geodeticOf(cloud);
      test = recordTest(filter, style, (name) => recordNumbers(name, records, cloud, geodetic));
      this.#tests.set(records, test);
    }
    return test(inside[index]);
  }

  /** Prepares a picture as far as a frame may. @internal @returns how many steps wait for a later one */
  prepare(gl: WebGL2RenderingContext, view: PlotView, camera: FlatCamera): number {
    this.#renderer ??= new LayerRenderer(gl);
    const { content, blends } = this.#renderer;
    const nodes = [...this.#vertices.keys()];
    const series = {
      ...{ cloud: this.#cloud, style: this.#plotted, filter: this.filter },
      ...{ nodes: nodes.length, points: this.#points },
      ...{ deepest: this.#deepest, reach: this.#reach },
    };
    const plan = planSeries(series, view, camera.pixelRatio, blends);
    const waiting = content.prepare({
      selection: { nodes, counts: nodes.map(() => Number.POSITIVE_INFINITY) },
      ...{ vertices: nodes.map((node) => this.#vertices.get(node)), changes: nodes.length },
      ...{ plan, clips: NO_CLIPS, depth: { own: false, scene: false }, allowance: new FrameAllowance() },
    });
    this.#renderer.begin(camera);
    const { material } = content;
    const uniforms = material && layerUniforms(material.plan);
    const ranges = plan.scene.facts.attributes.map(({ range }) => range);
    const numbers = JSON.stringify([camera.projection, view.shown, camera.width, uniforms, ranges]);
    const by = [numbers, material, material?.style, this.filter];
    this.#next = { by, nodes: content.nodes };
    return waiting;
  }

  /** Whether its points fill a picture of their own, which is then put over the others'. @internal */
  get offscreen(): boolean {
    const plan = this.#renderer?.content.material?.plan;
    return plan !== undefined && passesOf(plan).offscreen;
  }

  /** How many of its nodes the canvas shows as they are to be; -1 where it has to be drawn anew. @internal */
  get kept(): number {
    const [shown, next] = [this.#shown, this.#next];
    if (!shown) return next.nodes.length === 0 ? 0 : -1;
    const same =
      shown.by.every((value, at) => value === next.by[at]) &&
      shown.nodes.length <= next.nodes.length &&
      shown.nodes.every(
        ({ uploaded, count }, at) => uploaded === next.nodes[at].uploaded && count === next.nodes[at].count,
      );
    return same ? shown.nodes.length : -1;
  }

  /** Draws what was prepared over what the canvas shows. @param kept nodes that it shows already @internal */
  draw(kept: number): void {
    this.#renderer?.draw({ kept, over: true });
    this.#shown = this.#next;
  }

  /** The canvas shows nothing of it any more. @internal */
  forget(): void {
    this.#shown = undefined;
  }

  /** Forgets what it has in a context. @param lost whether that is gone @internal */
  release(lost: boolean): void {
    if (!lost) this.#renderer?.destroy();
    this.#renderer = undefined;
    this.#shown = undefined;
    this.#next = { by: [], nodes: [] };
  }
}
