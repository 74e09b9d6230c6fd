import type { PointCloud } from "../cloud/index.js";
import type { ClipAnswers } from "../drawing/clip-answers.js";
import type { FrameAllowance } from "../drawing/frame-allowance.js";
import { bufferPixel, windowPixels } from "../drawing/pick-window.js";
import { numberProgramsOf, pointProgramsOf, programsOf } from "../drawing/program-needs.js";
import {
  drawsOffscreen,
  type EffectPlan,
  nodeUniforms,
  type PointCloudStyle,
  type SceneFacts,
  withoutClips,
} from "../effects/index.js";
import type { ByteLedger, OctreeNode, Selection } from "../octree/index.js";
import { ClipRecords } from "./clip-records.js";
import type { DrawnNode } from "./drawn-node.js";
import type { Command, Context, FrameState, PickId } from "./engine/cesium-private.js";
import { GpuObjects } from "./engine/gpu-objects.js";
import type { Look } from "./look.js";
import { Looks } from "./looks.js";
import { NodeUploads } from "./node-uploads.js";
import { OffscreenPass } from "./offscreen-pass.js";
import { candidatesAt } from "./pick-candidates.js";
import { type GpuMilliseconds, PointDrawing, spheresOf } from "./point-drawing.js";
import { fitFrustum, isOrthographic } from "./point-frustum.js";
import { PointPicker } from "./point-picker.js";
import { PointPrograms } from "./point-programs.js";
import { SilhouetteProbe } from "./silhouette-probe.js";
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

/** All that a layer has and does on the GPU, in one context. */
export class LayerRenderer {
  readonly objects: GpuObjects;
  readonly #pickId: PickId;
  readonly #programs: PointPrograms;
  readonly #uploads = new NodeUploads();
  readonly #pass = new OffscreenPass();
  readonly #drawing: PointDrawing;
  readonly #looks: Looks;
  readonly #picker: PointPicker;
  readonly #probe: SilhouetteProbe;
  readonly #clips = new ClipRecords();
  #nodes: DrawnNode[] = [];
  #frameState: FrameState | undefined;

  /**
   * @param owner the primitive
   * @param picked what `scene.pick` returns
   * @param generation how often the context was lost before
   */
  constructor(context: Context, owner: object, picked: object, generation: number) {
    this.objects = new GpuObjects(context, generation);
    this.#pickId = context.createPickId(picked);
    this.#programs = new PointPrograms(this.objects, owner);
    this.#drawing = new PointDrawing(this.objects, owner, this.#pickId, this.#programs, this.#pass);
    this.#looks = new Looks(this.objects, this.#drawing.uniforms.map);
    this.#picker = new PointPicker(this.objects, this.#pass);
    this.#probe = new SilhouetteProbe(this.objects, this.#pass);
  }

  /** Nodes of the last frame, as they were drawn. */
  get nodes(): readonly DrawnNode[] {
    return this.#nodes;
  }

  /** The set of effects that the last frame showed. */
  get plan(): EffectPlan | undefined {
    return this.#looks.shown?.plan;
  }

  /** The style that the last frame showed. */
  get style(): PointCloudStyle | undefined {
    return this.#looks.shown?.style;
  }

  get gpuMilliseconds(): GpuMilliseconds {
    return this.#drawing.milliseconds(this.plan);
  }

  /** Whether the browser says how long the GPU takes. */
  get measuresGpu(): boolean {
    return this.#drawing.measuresGpu;
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
    this.#drawing.nextFrame();
    const { selection, cloud, plan, style, facts, clips, allowance } = request;
    const looks = this.#looks;
    const look = looks.want(plan);
    const needs = programsOf(look.plan, isLogarithmic(frameState));
    const linked = this.#programs.prepare(needs, frameState.useLogDepth, allowance);
    const vertices = (node: OctreeNode) => cloud.stream.vertices(node);
    const unformed = clips.form(
      selection.nodes.flatMap((node) => vertices(node) ?? []),
      allowance,
    );
    const next = linked ? look : looks.shown;
    const waiting = next
      ? this.#uploads.upload(this.objects, selection.nodes, vertices, this.#reads(next), allowance)
      : 0;
    const ready = looks.coming && linked && unformed === 0 && (waiting === 0 || !looks.shown);
    // The first frame of a look makes what it draws into.
    if (ready && allowance.grants()) this.#change();
    if (unformed === 0 && looks.shown?.plan.key === plan.key) clips.advance();
    const { shown } = looks;
    if (shown === look) shown.update(plan, style, facts);
    this.#nodes = shown ? this.#collect(shown, request) : [];
    const commands: Command[] = shown ? this.#drawing.draw(frameState, shown, this.#nodes) : [];
    frameState.commandList.push(...commands);
    return waiting + unformed + (looks.coming ? 1 : 0);
  }

  /**
   * Measures the silhouettes of the frame that was just drawn, or no more.
   * @returns whether an answer is awaited
   */
  probe(asked: boolean, { allowance, facts, clips }: RenderRequest): boolean {
    const { plan } = this;
    if (!asked || !plan || !this.#frameState || this.#nodes.length === 0) {
      this.#probe.rest();
      return false;
    }
    const needs = numberProgramsOf(plan, isLogarithmic(this.#frameState));
    if (!this.#programs.prepare(needs, false, allowance)) return true;
    const frustum = fitFrustum(this.#frameState.camera, spheresOf(this.#nodes));
    return this.#probe.follow({
      frameState: this.#frameState,
      nodes: this.#nodes,
      heightOffset: this.heightOffset,
      widest: this.#widest,
      setting: this.#drawing.setting("id", frustum),
      by: [plan.key, this.style, facts.filter, clips.held],
    });
  }

  /** Puts the points of the last frame into Cesium's list for a pass of picking or of depth. */
  repeat(frameState: FrameState): void {
    frameState.commandList.push(...this.#drawing.sceneCommands(this.#nodes));
  }

  /** Nothing of the layer is in the next frame. */
  rest(): void {
    this.#nodes = [];
    this.#drawing.release();
    this.#probe.rest();
  }

  /**
   * The point that the last frame shows nearest to a place of the canvas.
   * @param position CSS pixels from the upper left
   */
  async pick(position: { readonly x: number; readonly y: number }, { window = 9, signal }: PickOptions) {
    const frameState = this.#frameState;
    if (!frameState || this.#nodes.length === 0) return undefined;
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
      setting: this.#drawing.setting("id", fitFrustum(camera, spheresOf(candidates))),
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
    this.#looks.destroy();
    this.#drawing.destroy();
    this.#programs.destroy();
    this.#pass.destroy();
    this.#pickId.destroy();
    this.objects.destroy();
  }

  /** Greatest width of a point, CSS pixels. */
  get #widest(): number {
    const { style } = this;
    return style?.size === "fixed" ? style.pointSize : (style?.maximumSize ?? 0);
  }

  /** Draws the look that was prepared from now on, and frees what only the former one read. */
  #change(): void {
    this.#looks.change();
    const { shown } = this.#looks;
    if (!shown) return;
    this.#uploads.keep(this.#reads(shown));
    if (!drawsOffscreen(shown.plan)) this.#drawing.release();
  }

  /** What the programs of a look read of a node. */
  #reads({ plan }: Look): AttributeSet[] {
    return this.#programs.reads(pointProgramsOf(plan, isLogarithmic(this.#frameState)));
  }

  #collect(look: Look, { selection, style, facts, clips: answers }: RenderRequest): DrawnNode[] {
    const reads = this.#reads(look);
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
}

/** Whether the layer's own passes write logarithmic depth: in perspective. */
function isLogarithmic(frameState: FrameState | undefined): boolean {
  return frameState !== undefined && !isOrthographic(frameState.camera.frustum);
}
