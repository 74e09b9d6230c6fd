import { BoundingSphere } from "cesium";
import { passesOf, quadPassOf } from "../drawing/program-needs.js";
import { drawsOffscreen, type EffectPlan, type PointPass } from "../effects/index.js";
import { CompositeQuad } from "./composite-quad.js";
import type { DrawnNode } from "./drawn-node.js";
import { type Command, type FrameState, Pass, type PickId } from "./engine/cesium-private.js";
import type { GpuObjects } from "./engine/gpu-objects.js";
import { GpuTimer, hookCommand } from "./engine/gpu-timer.js";
import type { Look } from "./look.js";
import type { OffscreenPass, PassSetting } from "./offscreen-pass.js";
import { OffscreenTarget } from "./offscreen-target.js";
import { PictureUniforms } from "./picture-uniforms.js";
import { fitFrustum, type PointFrustum } from "./point-frustum.js";
import type { PointPrograms } from "./point-programs.js";
import { SceneStates } from "./scene-states.js";

/** Stretches of a frame that are measured: drawing the points, and putting their picture into the scene. */
type Stretch = "points" | "picture";

/** GPU milliseconds, running means of the set of effects that is shown; undefined where the browser does not say. */
export type GpuMilliseconds = Readonly<Record<Stretch, number | undefined>>;

/** How nodes get into the scene: by commands of their own, or through a picture that a quad puts there; measured. */
export class PointDrawing {
  /** Uniforms that the drawing side itself fills. */
  readonly uniforms: PictureUniforms;
  readonly #objects: GpuObjects;
  readonly #owner: object;
  readonly #programs: PointPrograms;
  readonly #pass: OffscreenPass;
  readonly #timer: GpuTimer;
  readonly #states = new SceneStates();
  readonly #target: OffscreenTarget;
  readonly #quad: CompositeQuad;

  /**
   * @param owner the primitive
   * @param pickId colour of the points in Cesium's passes of picking
   */
  constructor(
    objects: GpuObjects,
    owner: object,
    pickId: PickId,
    programs: PointPrograms,
    pass: OffscreenPass,
  ) {
    this.#objects = objects;
    this.#owner = owner;
    this.#programs = programs;
    this.#pass = pass;
    this.#timer = new GpuTimer(objects.context, objects);
    this.uniforms = new PictureUniforms(pickId);
    this.#target = new OffscreenTarget(objects);
    this.#quad = new CompositeQuad(objects, owner, this.#states);
  }

  /** Whether the browser says how long the GPU takes. */
  get measuresGpu(): boolean {
    return this.#timer.supported;
  }

  /** What a set of effects takes. */
  milliseconds(plan: EffectPlan | undefined): GpuMilliseconds {
    const of = (stretch: Stretch) => plan && this.#timer.milliseconds(labelOf(plan, stretch));
    return { points: of("points"), picture: of("picture") };
  }

  /** Begins a frame. */
  nextFrame(): void {
    this.#timer.nextFrame();
  }

  /** Commands that draw a frame's nodes; what goes into a picture of its own is drawn at once. */
  draw(frameState: FrameState, look: Look, nodes: readonly DrawnNode[]): Command[] {
    if (nodes.length === 0) return [];
    const { plan } = look;
    if (!drawsOffscreen(plan)) return this.#timed(labelOf(plan, "points"), this.sceneCommands(nodes));
    const quad = this.#drawOffscreen(frameState, look, nodes);
    // Cesium executes translucent commands in an order of its own.
    return plan.active.has("opacity") ? [quad] : this.#timed(labelOf(plan, "picture"), [quad]);
  }

  /** Commands that draw nodes straight into the scene. */
  sceneCommands(nodes: readonly DrawnNode[]): Command[] {
    const common = { owner: this.#owner, renderState: this.#states.opaque, pass: Pass.OPAQUE };
    return nodes.map(({ drawable, uniforms, count, plan }) => {
      const program = this.#programs.points(plan, "color", "scene");
      return drawable.sceneCommand({ ...common, program, uniformMap: uniforms.map }, count);
    });
  }

  /** How a pass of the layer's own draws its points. */
  setting(pass: PointPass, frustum: PointFrustum): Omit<PassSetting, "target"> {
    const programOf = ({ plan }: DrawnNode) =>
      this.#programs.points(plan, pass, "own", !frustum.orthographic);
    return { context: this.#objects.context, frustum, owner: this.#owner, programOf };
  }

  /** Frees the picture; it is made again when it is next drawn. */
  release(): void {
    this.#target.release();
  }

  destroy(): void {
    this.#target.release();
    this.#quad.destroy();
    this.#states.destroy();
  }

  /** Draws the points into a picture of their own. @returns the command that puts it into the scene */
  #drawOffscreen(frameState: FrameState, { plan, map }: Look, nodes: readonly DrawnNode[]): Command {
    const { context, camera } = frameState;
    const blended = plan.active.has("splats");
    const picture = this.#target.prepare(context.drawingBufferWidth, context.drawingBufferHeight, blended);
    const frustum = fitFrustum(camera, spheresOf(nodes));
    this.#timer.measure(labelOf(plan, "points"), () => {
      this.#pass.clear(context, picture.points, true);
      const [first, second] = passesOf(plan);
      this.#pass.draw(first, nodes, { ...this.setting(first, frustum), target: picture.points });
      if (!picture.blending || !second) return;
      this.#pass.clear(context, picture.blending, false);
      this.#pass.draw(second, nodes, { ...this.setting(second, frustum), target: picture.blending });
    });
    context.uniformState.updateFrustum(camera.frustum as PointFrustum["frustum"]);
    this.uniforms.take(picture, frustum);
    const program = this.#programs.quad(plan, quadPassOf(plan));
    const sphere = BoundingSphere.fromBoundingSpheres([...spheresOf(nodes)]);
    return this.#quad.command(program, map, sphere, plan.active.has("opacity"));
  }

  /** Commands between two that measure them. */
  #timed(label: string, commands: Command[]): Command[] {
    if (!this.#timer.supported) return commands;
    const begin = hookCommand(this.#owner, () => this.#timer.begin(label));
    const end = hookCommand(this.#owner, () => this.#timer.end());
    return [begin, ...commands, end];
  }
}

/** What is measured is told apart by the set of effects: answers come frames later. */
function labelOf({ key }: EffectPlan, stretch: Stretch): string {
  return `${key} ${stretch}`;
}

/** Spheres around nodes as they are drawn, ECEF, metres. */
export function* spheresOf(nodes: readonly DrawnNode[]): Generator<BoundingSphere> {
  for (const { drawable } of nodes) yield drawable.sphere;
}
