import type { ClipSet } from "../clips/index.js";
import type { PlacedOctree, PointCloud, StreamProgress } from "../cloud/index.js";
import {
  asksForSilhouettes,
  type CloudPlacing,
  cloudPlacing,
  type EffectName,
  type EffectPlan,
  type Forced,
  type LedgerRow,
  type PointCloudStyle,
  type PointFilter,
  placingFacts,
  planEffects,
  type SceneFacts,
} from "../effects/index.js";
import type { NodeBounds, Selection, SharedBudget } from "../octree/index.js";
import type { NodeVertices } from "../workers/index.js";
import { ClipAnswers } from "./clip-answers.js";
import { Completion, type FrameChange } from "./completion.js";
import { CostMeter } from "./cost-meter.js";
import type { ViewTypes } from "./drawn-node.js";
import { FrameAllowance } from "./frame-allowance.js";
import type { FrameCamera } from "./frame-camera.js";
import type { ContentRequest, LayerContent } from "./layer-content.js";
import { sceneFacts } from "./scene-facts.js";
import type { NodesHere } from "./spacing-facts.js";
import { cameraGround, type FrameGround, StillFrame } from "./still-frame.js";

/** What a layer is asked to show, as its properties stand at a frame. */
export interface LayerSettings {
  readonly maximumScreenSpaceError: number;
  readonly pointBudget: number;
  readonly budget: SharedBudget | undefined;
  readonly clips: ClipSet;
  readonly style: PointCloudStyle;
  readonly filter: PointFilter | undefined;
  readonly forced: Forced;
}

type SelectionSettings = Pick<LayerSettings, "maximumScreenSpaceError" | "pointBudget" | "budget">;

/** GPU milliseconds, running means of the set of effects that is shown; undefined where the browser does not say. */
export interface GpuMilliseconds {
  /** Drawing the points. */
  readonly points: number | undefined;
  /** Putting their picture into the scene, where they are drawn into one of their own. */
  readonly picture: number | undefined;
}

/** What silhouettes are measured by. */
export interface ProbeRequest extends Pick<ContentRequest, "plan" | "depth" | "allowance"> {
  readonly clips: Pick<ClipAnswers, "held">;
}

/** What draws a layer in one context of a view. */
export interface LayerRenderer<V extends ViewTypes> {
  readonly content: LayerContent<V>;
  /** Whether half-float colours can be drawn into, which weighted sums of colours need. */
  readonly blends: boolean;
  /** Share of the pixels that show points whose depth steps by 1 % or more; undefined where it was not measured. */
  readonly silhouettes: number | undefined;
  readonly gpuMilliseconds: GpuMilliseconds;
  /** Whether the browser says how long the GPU takes. */
  readonly measuresGpu: boolean;
  /** Draws what the content has prepared. */
  draw(): void;
  /**
   * Shows once more what was drawn last, since when nothing has changed that it rests on.
   * @returns whether points were drawn for it: a picture of their own may still be there
   */
  drawAgain(): boolean;
  /**
   * Measures the silhouettes of the frame that was just drawn, or no more.
   * @returns whether an answer is awaited
   */
  probe(asked: boolean, request: ProbeRequest): boolean;
}

/** What a view tells its users of a frame. */
export interface FrameReport extends FrameChange {
  readonly progress: StreamProgress;
}

/** Whether layers that share a budget have what is due to each, and none is to give anything up. */
function roomIn(budget: SharedBudget | undefined): boolean {
  return !budget || (budget.balanced && budget.cpu.excess === 0 && budget.gpu.excess === 0);
}

/** Milliseconds; what lies further apart are frames on demand, whose distance says nothing. */
const LONGEST_FRAME = 1000;

/** Radii of a data set from which nothing but its root is wanted. */
const FAR = 1000;

/** Parts of a frame whose first run takes long. */
const PARTS = ["selection", "facts", "plan"] as const;
type Part = (typeof PARTS)[number];

/**
 * The frames of one layer in one view, whatever library draws them. The order of a frame: the volumes are followed, the
 * octree selects nodes, facts of the scene are gathered, effects are planned by them, content is prepared and drawn, and
 * what waits for a later frame is counted.
 */
export class LayerFrames<V extends ViewTypes> {
  readonly #cloud: PointCloud;
  readonly #owner: object;
  readonly #octree: PlacedOctree;
  readonly #placing: CloudPlacing;
  readonly #completion = new Completion();
  readonly #costs = new CostMeter();
  readonly #clips = new ClipAnswers();
  readonly #still = new StillFrame();
  /** Parts that have run before. */
  readonly #begun = new Set<Part>();
  #selection: Selection | undefined;
  #ledger: readonly LedgerRow[] = [];
  /** Effects that the last frame called for. */
  #active: ReadonlySet<EffectName> = new Set();
  /** Whether a frame has shown points. */
  #shown = false;
  /** Whether the last frame drew its points, and did not only show a picture of them that was there. */
  #drawn = false;
  #frameStart = 0;
  /** Of the last selection's nodes, their slots, and how far away they begin, metres; longer, so that they serve many. */
  #slots = new Int32Array(0);
  #nearest = new Float32Array(0);
  /** Milliseconds from the frame before this one to it; 0 where they did not follow each other. */
  #interval = 0;

  /**
   * @param owner the layer, by which stream and budgets know it
   * @param octree the data set's own, as it lies in the view: on the globe, or on a map
   */
  constructor(cloud: PointCloud, owner: object, octree: PlacedOctree = cloud.globe) {
    this.#cloud = cloud;
    this.#owner = owner;
    this.#octree = octree;
    this.#placing = cloudPlacing(cloud);
  }

  /** Nodes that the last frame's view wants, and how far they are. */
  get progress(): StreamProgress {
    return this.#completion.progress;
  }

  /** Whether the point budget, not the screen-space error, ended the last frame's refinement. */
  get limited(): boolean {
    return this.#selection?.limited ?? false;
  }

  /**
   * Every effect that the last frame could have had, with what it costs as far as that was measured.
   * @param active effects that are shown
   */
  ledger(active: ReadonlySet<EffectName> = new Set()): readonly LedgerRow[] {
    return this.#costs.complete({ active, ledger: this.#ledger });
  }

  /** Whether the last frame showed all that can be had of what it was to show, and its camera stands where it stood. */
  settled(show: boolean): boolean {
    return this.#completion.settled(show);
  }

  /** Why volumes could not be prepared or held against a node; each failure is given once. */
  takeFailure(): unknown {
    return this.#clips.takeFailure();
  }

  /** Nothing is drawn: the layer wants no nodes until the next frame. */
  rest(show: boolean): void {
    if (this.#selection) this.#octree.stream.detach(this.#owner);
    this.#selection = undefined;
    this.#still.note(undefined);
    this.#clips.rest();
    this.#completion.rest(show);
  }

  /**
   * Draws a frame.
   * @returns `unfinished` where the frame ended early, for another one to go on; `blocked` where there is nothing that may
   *   be drawn before the volumes are other ones, and the layer is to rest
   */
  draw(
    settings: LayerSettings,
    camera: FrameCamera,
    rendererOf: () => LayerRenderer<V>,
  ): FrameReport | "unfinished" | "blocked" {
    const { stream } = this.#octree;
    const { budget, style, clips: volumes } = settings;
    const allowance = FrameAllowance.after(this.#passed(), this.#shown);
    const clips = this.#clips;
    clips.follow(volumes, this.#cloud, allowance);
    if (clips.blocked) return "blocked";
    if (this.#still.stands) {
      const renderer = rendererOf();
      if (this.#still.holds(this.#ground(settings, camera, renderer)) && roomIn(budget)) {
        this.#measure(renderer, renderer.drawAgain());
        return { progress: this.#completion.progress, changed: false, finished: false, done: true };
      }
    }
    const selection = this.#select(settings, camera, allowance);
    if (this.#tooLong("selection", allowance)) return "unfinished";
    const renderer = rendererOf();
    const here = this.#here(selection);
    const facts = this.#facts(settings, camera, selection, here, renderer.silhouettes);
    if (this.#tooLong("facts", allowance)) return "unfinished";
    const forced = renderer.blends ? settings.forced : { ...settings.forced, splats: false };
    const plan = this.#plan(style, facts, forced);
    if (this.#tooLong("plan", allowance)) return "unfinished";
    const ground = this.#ground(settings, camera, renderer);
    const { depth } = camera;
    const vertices = this.#verticesOf(here);
    const request = {
      ...{ selection, vertices, changes: stream.changes, nearest: this.#nearest },
      ...{ plan, clips, allowance, depth },
    };
    const { content } = renderer;
    const waiting = content.prepare(request);
    renderer.draw();
    this.#shown ||= content.points > 0;
    const probing = renderer.probe(asksForSilhouettes(style, forced), request);
    if (budget) content.keepWithin(budget.gpu, this.#owner);
    this.#measure(renderer, true);
    const idle = stream.active === 0;
    const change = this.#completion.note({
      progress: stream.progress(this.#owner),
      undrawn: content.undrawn,
      drawn: waiting === 0 && !clips.pending && !probing && (budget?.balanced ?? true),
      idle,
      pose: camera.pose,
    });
    this.#still.note(change.done && idle ? ground : undefined);
    return { progress: this.#completion.progress, ...change };
  }

  /**
   * Runs what each frame runs before it draws, once, seen from so far away that the root alone is wanted: the browser compiles
   * that code now, where no frame waits for it.
   */
  rehearse({ style, forced }: Pick<LayerSettings, "style" | "forced">): void {
    const { x, y, z, radius } = this.#octree.bounds ?? this.#cloud.bounds;
    const camera: FrameCamera = {
      view: {
        ...{ position: [x + FAR * radius, y, z], direction: [-1, 0, 0], planes: [], height: 1 },
        ...{ projection: { kind: "perspective", fieldOfView: 1 }, horizon: false },
      },
      ...{ width: 1, pixelRatio: 1, near: radius, depth: { own: false, scene: true }, pose: () => [] },
    };
    const pointBudget = Number.POSITIVE_INFINITY;
    const limits = { maximumScreenSpaceError: 1, pointBudget, budget: undefined };
    const selection = this.#select(limits, camera, new FrameAllowance());
    const facts = this.#facts({ filter: undefined }, camera, selection, this.#here(selection), undefined);
    planEffects(style, facts, forced, this.#active);
    for (const part of PARTS) this.#begun.add(part);
  }

  /** What a frame rests on, as it stands now. */
  #ground(settings: LayerSettings, camera: FrameCamera, renderer: LayerRenderer<V>): FrameGround {
    const { maximumScreenSpaceError, pointBudget, budget, clips, style, filter, forced } = settings;
    const { silhouettes, blends, content } = renderer;
    return [
      ...[maximumScreenSpaceError, pointBudget, budget, budget?.points, clips, style, filter, forced],
      ...[this.#clips.held, this.#clips.pending, this.#octree.stream.changes],
      ...[renderer, silhouettes, blends, content.heightOffset],
      ...cameraGround(camera),
    ];
  }

  #select(settings: SelectionSettings, { view }: FrameCamera, allowance: FrameAllowance): Selection {
    const { maximumScreenSpaceError, pointBudget, budget } = settings;
    const rejects = (bounds: NodeBounds) => this.#clips.rejects(bounds.onGlobe ?? bounds, allowance);
    const options = { maximumScreenSpaceError, pointBudget, budget, rejects };
    this.#selection = this.#octree.stream.update(this.#owner, view, options);
    return this.#selection;
  }

  /** What is here of a selection's nodes. */
  #here({ nodes }: Selection): NodesHere {
    if (this.#slots.length < nodes.length) {
      this.#slots = new Int32Array(2 * nodes.length);
      this.#nearest = new Float32Array(2 * nodes.length);
    }
    const slots = this.#slots.subarray(0, nodes.length);
    const { shapes } = this.#octree;
    for (let index = 0; index < nodes.length; index++) slots[index] = shapes.slotOf(nodes[index]);
    return { slots, shapes };
  }

  /** Their points, at the same indices. */
  #verticesOf({ slots }: NodesHere): (NodeVertices | undefined)[] {
    const { shapes } = this.#octree;
    const vertices: (NodeVertices | undefined)[] = [];
    for (let index = 0; index < slots.length; index++) vertices.push(shapes.points(slots[index]));
    return vertices;
  }

  #facts(
    { filter }: Pick<LayerSettings, "filter">,
    camera: FrameCamera,
    selection: Selection,
    here: NodesHere,
    silhouettes: number | undefined,
  ): SceneFacts {
    const { attributes } = this.#cloud;
    const { volumes } = this.#clips;
    const known = {
      ...{ attributes, filter, silhouettes },
      ...{ clips: volumes?.cutting ?? 0, highlights: volumes?.highlighting ?? 0 },
      placing: placingFacts(this.#placing, here.slots, here.shapes),
    };
    return sceneFacts(camera, selection, here, known, this.#nearest);
  }

  #plan(style: PointCloudStyle, facts: SceneFacts, forced: Forced): EffectPlan {
    const plan = planEffects(style, facts, forced, this.#active);
    this.#active = plan.active;
    this.#ledger = plan.ledger;
    return plan;
  }

  /**
   * True the first time that a part of a frame runs, where that has taken what time the frame had. The browser compiles its
   * code then, which takes many times as long as a later run: the frame ends after it, and the next one begins from the start.
   */
  #tooLong(part: Part, allowance: FrameAllowance): boolean {
    if (this.#begun.has(part)) return false;
    this.#begun.add(part);
    return !allowance.left;
  }

  /** Begins a frame. @returns milliseconds since the last one began; 0 where they do not follow each other */
  #passed(): number {
    const now = performance.now();
    const interval = now - this.#frameStart;
    this.#frameStart = now;
    this.#interval = interval < LONGEST_FRAME ? interval : 0;
    return this.#interval;
  }

  /**
   * Notes what the frame cost: as the GPU says, else from frame to frame while they follow each other.
   * @param drawn whether it drew its points
   */
  #measure({ content, measuresGpu, gpuMilliseconds }: LayerRenderer<V>, drawn: boolean): void {
    const { points: drawing, picture = 0 } = gpuMilliseconds;
    const lasted = this.#drawn ? this.#interval : 0;
    this.#drawn = drawn;
    const plan = content.material?.plan;
    if (!plan) return;
    const { points } = content;
    if (drawing !== undefined) {
      this.#costs.note({ plan, points, milliseconds: drawing + picture, by: "timer query" });
    } else if (!measuresGpu && lasted > 0) {
      this.#costs.note({ plan, points, milliseconds: lasted, by: "frame difference" });
    }
  }
}
