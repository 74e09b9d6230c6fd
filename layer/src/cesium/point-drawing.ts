import { type BoundingSphere, type Camera, Matrix4 } from "cesium";
import type { DrawnWith } from "../drawing/drawn-node.js";
import type { GpuMilliseconds } from "../drawing/frame.js";
import type { LayerContent } from "../drawing/layer-content.js";
import type { Material } from "../drawing/material.js";
import { quadProgramOf } from "../drawing/program-needs.js";
import { type EffectPlan, type PointPass, passesOf } from "../effects/index.js";
import { CompositeQuad } from "./composite-quad.js";
import { coveredPart } from "./covered-part.js";
import { type Command, type FrameState, Pass, type PickId } from "./engine/cesium-private.js";
import type { GpuObjects } from "./engine/gpu-objects.js";
import { GpuTimer, hookCommand } from "./engine/gpu-timer.js";
import type { RenderStates } from "./engine/render-states.js";
import { type CesiumNode, type CesiumView, PLACE, writeToEye } from "./node-drawable.js";
import type { OffscreenPass, PassSetting } from "./offscreen-pass.js";
import { OffscreenTarget, PictureUniforms } from "./offscreen-target.js";
import { NodesVolume, PointBatch } from "./point-batch.js";
import { fitFrustum, type PointFrustum } from "./point-frustum.js";

/** Stretches of a frame that are measured: drawing the points, and putting their picture into the scene. */
type Stretch = keyof GpuMilliseconds;

/** How nodes get into the scene: by commands of their own, or through a picture that a quad puts there; measured. */
export class PointDrawing {
  /** Uniforms that the drawing side itself fills. */
  readonly uniforms: PictureUniforms;
  readonly #objects: GpuObjects;
  readonly #owner: object;
  readonly #pass: OffscreenPass;
  readonly #states: RenderStates;
  readonly #timer: GpuTimer;
  readonly #target: OffscreenTarget;
  readonly #quad: CompositeQuad;
  /** Around the nodes of the picture. */
  readonly #volume = new NodesVolume();
  /** The command of each group; it goes with it, since what Cesium derives from it keeps programs and uniforms. */
  readonly #batches = new WeakMap<DrawnWith<CesiumView>, PointBatch>();
  /** What is in the picture, and the commands that put it into the scene. */
  #pictured: { readonly nodes: readonly CesiumNode[]; readonly commands: Command[] } | undefined;

  /**
   * @param owner the primitive
   * @param pickId colour of the points in Cesium's passes of picking
   */
  constructor(objects: GpuObjects, owner: object, pickId: PickId, pass: OffscreenPass, states: RenderStates) {
    this.#objects = objects;
    this.#owner = owner;
    this.#pass = pass;
    this.#states = states;
    this.#timer = new GpuTimer(objects.context, objects);
    this.uniforms = new PictureUniforms(pickId);
    this.#target = new OffscreenTarget(objects);
    this.#quad = new CompositeQuad(objects, owner, states);
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

  /** Commands that draw a frame's nodes; what goes into a picture of its own is drawn at once. */
  draw(frameState: FrameState, content: LayerContent<CesiumView>): Command[] {
    this.#timer.nextFrame();
    const { material, nodes } = content;
    if (!material) return [];
    const { plan } = material;
    const { offscreen, translucent } = passesOf(plan);
    if (!offscreen) this.release();
    if (nodes.length === 0) return [];
    this.place(content, frameState.camera);
    if (!offscreen) return this.#timed(labelOf(plan, "points"), this.sceneCommands(content));
    const quad = this.#drawOffscreen(frameState, material, content);
    // Cesium executes translucent commands in an order of its own.
    const commands = translucent ? [quad] : this.#timed(labelOf(plan, "picture"), [quad]);
    this.#pictured = { nodes, commands };
    return commands;
  }

  /**
   * Commands that show the last frame's picture of the points once more: nothing of it hangs on the scene, which the quad is
   * held against. Undefined where there is none, and where another one is to be drawn.
   */
  drawAgain({ nodes }: LayerContent<CesiumView>): Command[] | undefined {
    if (this.#pictured?.nodes !== nodes) return undefined;
    this.#timer.nextFrame();
    return this.#pictured.commands;
  }

  /** Commands that draw nodes straight into the scene, one for each program. */
  sceneCommands({ grouped, programs, depth }: LayerContent<CesiumView>): Command[] {
    const owner = this.#owner;
    const common = { owner, renderState: this.#states.of("opaque"), pass: Pass.OPAQUE };
    return [...grouped].map(([group, members]) => {
      const { plan, uniforms } = group;
      const program = programs.of({ plan, pass: "color", into: "scene", logarithmic: depth.scene });
      return this.#batchOf(group).command(members, { ...common, program, uniformMap: uniforms.map });
    });
  }

  /** Has the nodes seen by a camera, in float64, in whatever is drawn of them next. */
  place({ groups }: LayerContent<CesiumView>, { viewMatrix }: Camera): void {
    const by = Matrix4.toArray(viewMatrix);
    for (const group of groups) {
      const toEye = group.placeIn("u_modelView") ?? 0;
      group.place(1, by, ({ uploaded }, _, table, begin) => {
        const { places, slot } = uploaded;
        writeToEye(by, places.numbers, places.begin(slot) + PLACE.toGlobe, table, begin + toEye);
      });
    }
  }

  /** How a pass of the layer's own draws its points. */
  setting(
    pass: PointPass,
    frustum: PointFrustum,
    { programs }: LayerContent<CesiumView>,
  ): Omit<PassSetting, "target"> {
    const programOf = (plan: EffectPlan) =>
      programs.of({ plan, pass, into: "own", logarithmic: !frustum.orthographic });
    return { objects: this.#objects, frustum, owner: this.#owner, programOf };
  }

  /** Frees the picture; it is made again when it is next drawn. */
  release(): void {
    this.#target.release();
    this.#pictured = undefined;
  }

  destroy(): void {
    this.release();
    this.#quad.destroy();
  }

  /** Draws the points into a picture of their own. @returns the command that puts it into the scene */
  #drawOffscreen(
    frameState: FrameState,
    { plan, uniforms }: Material<CesiumView>,
    content: LayerContent<CesiumView>,
  ): Command {
    const { context, camera, pixelRatio } = frameState;
    const { nodes, grouped, programs, depth, widestPoint } = content;
    const { points: passes, readsFront, translucent } = passesOf(plan);
    const { drawingBufferWidth: width, drawingBufferHeight: height } = context;
    const picture = this.#target.prepare(width, height, passes.includes("splat") ? "halfFloat" : "byte");
    this.#volume.hold(nodes);
    const frustum = fitFrustum(camera, [this.#volume]);
    const setting = (pass: PointPass) => this.setting(pass, frustum, content);
    this.#timer.measure(labelOf(plan, "points"), () => {
      this.#pass.clear(context, picture.target);
      for (const pass of passes) {
        if (readsFront && pass !== passes[0]) this.uniforms.front = this.#target.copyDepth();
        this.#pass.draw(pass, grouped, { ...setting(pass), target: picture.target });
      }
    });
    context.uniformState.updateFrustum(camera.frustum as PointFrustum["frustum"]);
    this.uniforms.take(picture, frustum);
    // Half the width of a point, and a pixel for what is rounded; the picture is 2 by 2.
    const reach = widestPoint * pixelRatio + 2;
    const margin = [reach / width, reach / height] as const;
    coveredPart(camera.viewMatrix, frustum, spheresOf(nodes), margin, this.uniforms.coveredPart);
    const program = programs.of(quadProgramOf(plan, depth));
    return this.#quad.command(program, uniforms.map, this.#volume, translucent);
  }

  #batchOf(group: DrawnWith<CesiumView>): PointBatch {
    let batch = this.#batches.get(group);
    if (!batch) {
      batch = new PointBatch(this.#objects);
      this.#batches.set(group, batch);
    }
    return batch;
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
export function* spheresOf(nodes: readonly CesiumNode[]): Generator<BoundingSphere> {
  for (const { uploaded } of nodes) yield uploaded.sphere;
}
