import { BoundingSphere } from "cesium";
import type { PointCloud } from "../cloud/index.js";
import {
  drawsOffscreen,
  type EffectPlan,
  nodeUniforms,
  type PointCloudStyle,
  type PointPass,
  type QuadPass,
  type SceneFacts,
  withoutClips,
} from "../effects/index.js";
import type { ByteLedger, OctreeNode, Selection } from "../octree/index.js";
import { type Command, type Context, type FrameState, Pass, type PickId } from "./cesium-private.js";
import type { ClipAnswers } from "./clip-answers.js";
import { ClipRecords } from "./clip-records.js";
import { CompositeQuad } from "./composite-quad.js";
import type { DrawnNode } from "./drawn-node.js";
import type { FrameAllowance } from "./frame-allowance.js";
import { GpuObjects } from "./gpu-objects.js";
import { GpuTimer } from "./gpu-timer.js";
import { Look } from "./look.js";
import { NodeUploads } from "./node-uploads.js";
import { OffscreenPass } from "./offscreen-pass.js";
import { OffscreenTarget } from "./offscreen-target.js";
import { candidatesAt } from "./pick-candidates.js";
import { bufferPixel, windowPixels } from "./pick-window.js";
import { PictureUniforms } from "./picture-uniforms.js";
import { fitFrustum, isOrthographic, type PointFrustum } from "./point-frustum.js";
import { PointPicker } from "./point-picker.js";
import { PointPrograms, type ProgramNeed } from "./point-programs.js";
import { SceneStates } from "./scene-states.js";
import { SilhouetteProbe } from "./silhouette-probe.js";
import { hookCommand } from "./timing-hook.js";
import type { AttributeSet } from "./vertex-attributes.js";

/** What a frame is to show. */
export interface RenderRequest {
  readonly selection: Selection;
  readonly cloud: PointCloud;
  readonly plan: EffectPlan;
  readonly style: PointCloudStyle;
  readonly facts: SceneFacts;
  readonly clips: ClipAnswers;
  /** What of it may be prepared in this frame. */
  readonly allowance: FrameAllowance;
}

/** How a place of the picture is asked for its point. */
export interface PickOptions {
  /** Edge of the square around it in which the nearest point counts, CSS pixels. Default: 9. */
  readonly window?: number | undefined;
  readonly signal?: AbortSignal | undefined;
}

/** Stretches of a frame that are measured: drawing the points, and putting their picture into the scene. */
type Stretch = "points" | "picture";

/** GPU milliseconds, running means of the set of effects that is shown; undefined where the browser does not say. */
export type GpuMilliseconds = Readonly<Record<Stretch, number | undefined>>;

/** All that a layer has and does on the GPU, in one context. */
export class LayerRenderer {
  readonly objects: GpuObjects;
  readonly #timer: GpuTimer;
  readonly #owner: object;
  readonly #pickId: PickId;
  readonly #programs: PointPrograms;
  readonly #uploads = new NodeUploads();
  readonly #states = new SceneStates();
  readonly #pass = new OffscreenPass();
  readonly #target: OffscreenTarget;
  readonly #quad: CompositeQuad;
  readonly #picker: PointPicker;
  readonly #probe: SilhouetteProbe;
  readonly #picture: PictureUniforms;
  readonly #clips = new ClipRecords();
  #look: Look | undefined;
  /** The look to come, while nodes still lack attributes that it reads. */
  #next: Look | undefined;
  #nodes: DrawnNode[] = [];
  #commands: Command[] = [];
  #frameState: FrameState | undefined;

  /**
   * @param owner the primitive
   * @param picked what `scene.pick` returns
   * @param generation how often the context was lost before
   */
  constructor(context: Context, owner: object, picked: object, generation: number) {
    this.#owner = owner;
    this.objects = new GpuObjects(context, generation);
    this.#timer = new GpuTimer(context, this.objects);
    this.#pickId = context.createPickId(picked);
    this.#picture = new PictureUniforms(this.#pickId);
    this.#programs = new PointPrograms(this.objects, owner);
    this.#target = new OffscreenTarget(this.objects);
    this.#quad = new CompositeQuad(this.objects, owner, this.#states);
    this.#picker = new PointPicker(this.objects, this.#pass);
    this.#probe = new SilhouetteProbe(this.objects, this.#pass);
  }

  /** Nodes of the last frame, as they were drawn. */
  get nodes(): readonly DrawnNode[] {
    return this.#nodes;
  }

  /** The set of effects that the last frame showed. */
  get plan(): EffectPlan | undefined {
    return this.#look?.plan;
  }

  /** The style that the last frame showed. */
  get style(): PointCloudStyle | undefined {
    return this.#look?.style;
  }

  get gpuMilliseconds(): GpuMilliseconds {
    const of = (stretch: Stretch) => this.#timer.milliseconds(this.#label(stretch));
    return { points: of("points"), picture: of("picture") };
  }

  /** Whether the browser says how long the GPU takes. */
  get measuresGpu(): boolean {
    return this.#timer.supported;
  }

  /** Share of the pixels that show points whose depth steps by 1 % or more; undefined where it was not measured. */
  get silhouettes(): number | undefined {
    return this.#probe.share;
  }

  /** Metres above their places at which nodes are drawn. */
  get heightOffset(): number {
    return this.#uploads.heightOffset;
  }

  lift(heightOffset: number): void {
    this.#uploads.lift(heightOffset);
  }

  /** Frees what a node has on the GPU. */
  free(node: OctreeNode): void {
    this.#uploads.free(node);
    this.#nodes = this.#nodes.filter((drawn) => drawn.node !== node);
  }

  /**
   * Draws a frame: prepares what it may, and puts commands into Cesium's list. A new look and new volumes show once
   * all that they need is there; until then the former ones are drawn.
   * @returns steps that wait for a later frame: nodes to be uploaded or held against volumes, and a new look
   */
  render(frameState: FrameState, request: RenderRequest): number {
    this.#frameState = frameState;
    this.#timer.nextFrame();
    const { selection, cloud, plan, style, facts, clips, allowance } = request;
    const look = this.#wanted(plan);
    const linked = this.#programs.prepare(this.#needs(look.plan), frameState.useLogDepth, allowance);
    const vertices = (node: OctreeNode) => cloud.stream.vertices(node);
    const unformed = clips.form(
      selection.nodes.flatMap((node) => vertices(node) ?? []),
      allowance,
    );
    const next = linked ? look : this.#look;
    const waiting = next
      ? this.#uploads.upload(this.objects, selection.nodes, vertices, this.#reads(next.plan), allowance)
      : 0;
    if (this.#next && linked && unformed === 0 && (waiting === 0 || !this.#look)) this.#change(this.#next);
    if (unformed === 0 && this.#look?.plan.key === plan.key) clips.advance();
    const shown = this.#look;
    if (shown === look) shown.update(plan, style, facts);
    this.#nodes = shown ? this.#collect(shown, request) : [];
    this.#commands = shown ? this.#draw(frameState, shown) : [];
    frameState.commandList.push(...this.#commands);
    return waiting + unformed + (this.#next ? 1 : 0);
  }

  /**
   * Measures the silhouettes of the frame that was just drawn, or no more.
   * @returns whether an answer is awaited
   */
  probe(asked: boolean): boolean {
    if (!asked || !this.#frameState || this.#nodes.length === 0) {
      this.#probe.rest();
      return false;
    }
    const frustum = fitFrustum(this.#frameState.camera, spheresOf(this.#nodes));
    return this.#probe.follow({
      frameState: this.#frameState,
      nodes: this.#nodes,
      heightOffset: this.heightOffset,
      widest: this.#widest,
      setting: this.#setting("id", frustum),
    });
  }

  /** Puts the points of the last frame into Cesium's list for a pass of picking or of depth. */
  repeat(frameState: FrameState): void {
    frameState.commandList.push(...this.#sceneCommands());
  }

  /** Nothing of the layer is in the next frame. */
  rest(): void {
    this.#nodes = [];
    this.#commands = [];
    this.#target.release();
    this.#probe.rest();
  }

  /**
   * The point that the last frame shows nearest to a place of the canvas.
   * @param position CSS pixels from the upper left
   */
  async pick(position: { readonly x: number; readonly y: number }, { window = 9, signal }: PickOptions) {
    const frameState = this.#frameState;
    const look = this.#look;
    if (!frameState || !look || this.#nodes.length === 0) return undefined;
    const { context, camera, pixelRatio } = frameState;
    const size = { width: context.drawingBufferWidth, height: context.drawingBufferHeight };
    const nodes = this.#nodes;
    const candidates = candidatesAt(camera, position, window / 2 + this.#widest + 1, nodes);
    if (candidates.length === 0) return undefined;
    context.uniformState.update(frameState);
    return this.#picker.pick({
      ...bufferPixel(position, context._gl.canvas as HTMLCanvasElement, size),
      window: windowPixels(window, pixelRatio),
      size,
      nodes,
      candidates,
      setting: this.#setting("id", fitFrustum(camera, spheresOf(candidates))),
      signal,
    });
  }

  /** Frees what the last frame did not show until the layers that share a budget keep it. */
  keepWithin(budget: ByteLedger, owner: object): void {
    const shown = new Set(this.#nodes.map(({ node }) => node));
    budget.report(owner, this.objects.bytes);
    for (const node of budget.excess > 0 ? this.#uploads.idle(shown) : []) {
      this.#uploads.free(node);
      budget.report(owner, this.objects.bytes);
      if (budget.excess === 0) return;
    }
  }

  /** Frees all. */
  destroy(): void {
    this.#nodes = [];
    this.#picker.destroy();
    this.#probe.rest();
    this.#uploads.destroy();
    this.#look?.destroy();
    this.#next?.destroy();
    this.#target.release();
    this.#quad.destroy();
    this.#programs.destroy();
    this.#pass.destroy();
    this.#states.destroy();
    this.#pickId.destroy();
    this.objects.destroy();
  }

  /** The look of a set of effects: the one that is drawn, or one that is being prepared. */
  #wanted(plan: EffectPlan): Look {
    if (this.#look?.plan.key === plan.key) {
      this.#next?.destroy();
      this.#next = undefined;
      return this.#look;
    }
    if (this.#next?.plan.key !== plan.key) {
      this.#next?.destroy();
      this.#next = new Look(this.objects, plan, this.#picture.map);
    }
    return this.#next;
  }

  /** A new style shows once all nodes have what it reads, and not node by node. */
  #change(next: Look): void {
    this.#look?.destroy();
    this.#look = next;
    this.#next = undefined;
    this.#uploads.keep(this.#reads(next.plan));
    if (!drawsOffscreen(next.plan)) this.#target.release();
  }

  /** The programs that a set of effects is drawn with. */
  #needs(plan: EffectPlan): ProgramNeed[] {
    const plans = new Set([plan, withoutClips(plan)]);
    if (!drawsOffscreen(plan)) {
      return [...plans].map((plan) => ({ plan, pass: "color", drawer: "scene", logarithmic: false }));
    }
    const camera = this.#frameState?.camera;
    const logarithmic = camera !== undefined && !isOrthographic(camera.frustum);
    const points = [...plans].flatMap((plan) =>
      passesOf(plan).map((pass) => ({ plan, pass, drawer: "own", logarithmic }) as const),
    );
    return [...points, { plan, pass: quadPassOf(plan), drawer: "quad" }];
  }

  /** What these programs read of a node. */
  #reads(plan: EffectPlan): AttributeSet[] {
    const sets = new Map<string, AttributeSet>();
    for (const need of this.#needs(plan)) {
      if (need.drawer === "quad") continue;
      const { reads } = this.#programs.points(need.plan, need.pass, need.drawer, need.logarithmic);
      sets.set(reads.signature, reads);
    }
    return [...sets.values()];
  }

  #collect(look: Look, { selection, style, facts, clips: answers }: RenderRequest): DrawnNode[] {
    const reads = this.#reads(look.plan);
    const plain = withoutClips(look.plan);
    const drawn: DrawnNode[] = [];
    let firstId = 0;
    selection.nodes.forEach((node, index) => {
      const drawable = this.#uploads.ready(node, reads);
      const clips = drawable && answers.of(drawable.vertices);
      if (!drawable || !clips || clips.state === "out") return;
      const count = Math.min(selection.counts[index], drawable.vertices.count);
      const plan = clips.state === "in" ? plain : look.plan;
      drawn.push({ node, drawable, count, firstId, uniforms: look.node(node), clips, plan });
      firstId += count;
    });
    const octreeIndices = look.showOctree(drawn);
    const clipRecords = this.#clips.show(look, drawn);
    drawn.forEach(({ node, drawable, firstId, uniforms }, index) => {
      const { columns, toCube } = drawable.vertices;
      const values = nodeUniforms(look.plan, look.style ?? style, facts, {
        columns: { get: (name) => columns[name] },
        firstId,
        level: node.key.depth,
        spacing: node.bounds?.spacing ?? 0,
        octreeIndex: octreeIndices?.[index] ?? 0,
        toCube,
        clips: clipRecords[index] ?? [0, 0],
      });
      uniforms.set(values);
    });
    return drawn;
  }

  #draw(frameState: FrameState, look: Look): Command[] {
    if (this.#nodes.length === 0) return [];
    if (!drawsOffscreen(look.plan)) return this.#timed("points", this.#sceneCommands());
    const quad = this.#drawOffscreen(frameState, look);
    // Cesium executes translucent commands in an order of its own.
    return look.plan.active.has("opacity") ? [quad] : this.#timed("picture", [quad]);
  }

  /** Commands between two that measure them. */
  #timed(stretch: Stretch, commands: Command[]): Command[] {
    if (!this.#timer.supported) return commands;
    const label = this.#label(stretch);
    const begin = hookCommand(this.#owner, () => this.#timer.begin(label));
    const end = hookCommand(this.#owner, () => this.#timer.end());
    return [begin, ...commands, end];
  }

  /** What is measured is told apart by the set of effects: answers come frames later. */
  #label(stretch: Stretch): string {
    return `${this.#look?.plan.key} ${stretch}`;
  }

  #sceneCommands(): Command[] {
    const common = { owner: this.#owner, renderState: this.#states.opaque, pass: Pass.OPAQUE };
    return this.#nodes.map(({ drawable, uniforms, count, plan }) => {
      const program = this.#programs.points(plan, "color", "scene");
      return drawable.sceneCommand({ ...common, program, uniformMap: uniforms.map }, count);
    });
  }

  /** Draws the points into a picture of their own. @returns the command that puts it into the scene */
  #drawOffscreen(frameState: FrameState, look: Look): Command {
    const { context, camera } = frameState;
    const { plan } = look;
    const blended = plan.active.has("splats");
    const picture = this.#target.prepare(context.drawingBufferWidth, context.drawingBufferHeight, blended);
    const frustum = fitFrustum(camera, spheresOf(this.#nodes));
    this.#timer.measure(this.#label("points"), () => {
      this.#pass.clear(context, picture.points, true);
      const [first, second] = passesOf(plan);
      this.#pass.draw(first, this.#nodes, { ...this.#setting(first, frustum), target: picture.points });
      if (!picture.blending || !second) return;
      this.#pass.clear(context, picture.blending, false);
      this.#pass.draw(second, this.#nodes, {
        ...this.#setting(second, frustum),
        target: picture.blending,
      });
    });
    context.uniformState.updateFrustum(camera.frustum as PointFrustum["frustum"]);
    this.#picture.take(picture, frustum);
    const program = this.#programs.quad(plan, quadPassOf(plan));
    const sphere = BoundingSphere.fromBoundingSpheres([...spheresOf(this.#nodes)]);
    return this.#quad.command(program, look.map, sphere, plan.active.has("opacity"));
  }

  /** Greatest width of a point, CSS pixels. */
  get #widest(): number {
    const style = this.#look?.style;
    return style?.size === "fixed" ? style.pointSize : (style?.maximumSize ?? 0);
  }

  #setting(pass: PointPass, frustum: PointFrustum) {
    const programOf = ({ plan }: DrawnNode) =>
      this.#programs.points(plan, pass, "own", !frustum.orthographic);
    return { context: this.objects.context, frustum, owner: this.#owner, programOf };
  }
}

/** The passes over the points that make their picture. */
function passesOf({ active }: EffectPlan): readonly [PointPass, ...PointPass[]] {
  return active.has("splats") ? ["depth", "splat"] : ["color"];
}

function quadPassOf({ active }: EffectPlan): QuadPass {
  return active.has("eyeDomeLighting") ? "edl" : "splatNormalise";
}

function* spheresOf(nodes: readonly DrawnNode[]): Generator<BoundingSphere> {
  for (const { drawable } of nodes) yield drawable.sphere;
}
