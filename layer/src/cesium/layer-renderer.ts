import { type Camera, type Cartesian3, Matrix4 } from "cesium";
import type { PickOptions } from "../drawing/drawing-options.js";
import { pointOf } from "../drawing/drawn-node.js";
import type { GpuMilliseconds, ProbeRequest, LayerRenderer as Renderer } from "../drawing/frame.js";
import { LayerContent } from "../drawing/layer-content.js";
import { bufferPixel, nearestId, type Size, windowPixels } from "../drawing/pick-window.js";
import { numberProgramsOf } from "../drawing/program-needs.js";
import { type ProbedFrame, type Relief, SilhouetteProbe } from "../drawing/silhouette-probe.js";
import type { Context, FrameState, PickId } from "./engine/cesium-private.js";
import { GpuObjects } from "./engine/gpu-objects.js";
import { RenderStates } from "./engine/render-states.js";
import type { WindowPosition } from "./layer-options.js";
import { type CesiumNode, type CesiumView, matrixOf, NodeDrawable, NodePlaces } from "./node-drawable.js";
import { NumberPicture } from "./number-picture.js";
import { OffscreenPass } from "./offscreen-pass.js";
import { candidatesAt } from "./pick-candidates.js";
import { PointDrawing, spheresOf } from "./point-drawing.js";
import { fitFrustum, type PointFrustum } from "./point-frustum.js";
import { drawnPlace, pointsNear } from "./points-near.js";

/** All that a layer has and does on the GPU, in one context of Cesium. */
export class LayerRenderer implements Renderer<CesiumView> {
  readonly objects: GpuObjects;
  readonly content: LayerContent<CesiumView>;
  readonly #pickId: PickId;
  readonly #states = new RenderStates();
  readonly #drawing: PointDrawing;
  readonly #picked: NumberPicture;
  readonly #probed: NumberPicture;
  readonly #probe = new SilhouetteProbe<CesiumView>();
  #frameState: FrameState | undefined;
  #destroyed = false;

  /**
   * @param owner the primitive
   * @param picked what `scene.pick` returns
   * @param generation how often the context was lost before
   */
  constructor(context: Context, owner: object, picked: object, generation: number) {
    const objects = new GpuObjects(context, owner, generation);
    const pass = new OffscreenPass(this.#states);
    const places = new NodePlaces();
    this.objects = objects;
    this.#pickId = context.createPickId(picked);
    this.#drawing = new PointDrawing(objects, owner, this.#pickId, pass, this.#states);
    this.content = new LayerContent<CesiumView>(
      objects,
      this.#drawing.uniforms.values,
      (pages, vertices, slot, heightOffset) => new NodeDrawable(pages, vertices, slot, places, heightOffset),
    );
    this.#picked = new NumberPicture(objects, pass);
    this.#probed = new NumberPicture(objects, pass);
  }

  get blends(): boolean {
    return this.objects.context.colorBufferHalfFloat;
  }

  get gpuMilliseconds(): GpuMilliseconds {
    return this.#drawing.milliseconds(this.content.material?.plan);
  }

  get measuresGpu(): boolean {
    return this.#drawing.measuresGpu;
  }

  get silhouettes(): number | undefined {
    return this.#probe.share;
  }

  /** What is drawn from now on goes into this frame of Cesium's. */
  begin(frameState: FrameState): void {
    this.#frameState = frameState;
  }

  draw(): void {
    const frameState = this.#frameState;
    frameState?.commandList.push(...this.#drawing.draw(frameState, this.content));
  }

  drawAgain(): boolean {
    const again = this.#drawing.drawAgain(this.content);
    if (again) this.#frameState?.commandList.push(...again);
    else this.draw();
    return again === undefined;
  }

  probe(asked: boolean, { allowance, plan: wanted, clips, depth }: ProbeRequest): boolean {
    const frameState = this.#frameState;
    const { material, nodes, programs, heightOffset } = this.content;
    if (!asked || !material || !frameState || nodes.length === 0) {
      this.#endProbe();
      return false;
    }
    const { plan, style } = material;
    if (!programs.prepare(numberProgramsOf(plan, depth), allowance)) return true;
    const by = [
      ...cameraNumbers(frameState.camera),
      heightOffset,
      plan.key,
      style,
      wanted.scene.facts.filter,
      clips.held,
    ];
    return this.#probe.follow(this.#probedFrame(frameState, by));
  }

  /** Puts the points of the last frame into Cesium's list for a pass of picking or of depth. */
  repeat(frameState: FrameState): void {
    this.#drawing.place(this.content, frameState.camera);
    frameState.commandList.push(...this.#drawing.sceneCommands(this.content));
  }

  /** Nothing of the layer is in the next frame. */
  rest(): void {
    this.content.rest();
    this.#drawing.release();
    this.#endProbe();
  }

  /**
   * The point that the last frame shows nearest to a place of the canvas.
   * @param position CSS pixels from the upper left
   */
  async pick(position: WindowPosition, { window = 9, signal }: PickOptions) {
    const frameState = this.#frameState;
    const { nodes, widestPoint } = this.content;
    if (!frameState || nodes.length === 0) return undefined;
    const { context, camera, pixelRatio } = frameState;
    const picture = sizeOf(context);
    const edge = windowPixels(window, pixelRatio);
    const candidates = candidatesAt(camera, position, edge / pixelRatio / 2 + widestPoint + 1, nodes);
    if (candidates.length === 0) return undefined;
    signal?.throwIfAborted();
    context.uniformState.update(frameState);
    this.#drawing.place(this.content, camera);
    const setting = this.#drawing.setting("id", fitFrustum(camera, spheresOf(candidates)), this.content);
    const reach = (edge - 1) / 2;
    const { x, y } = bufferPixel(position, context._gl.canvas as HTMLCanvasElement, picture);
    const square = { x: x - reach, y: y - reach, size: { width: edge, height: edge }, picture };
    const until = { gone: () => this.#destroyed, signal };
    const answer = this.#picked.read(square, candidates, setting, until);
    // Between Cesium's frames nobody else sends it to the GPU, or unbinds what was drawn with.
    context._gl.flush();
    context.endFrame();
    const pixels = await answer;
    const id = pixels && nearestId(pixels, edge);
    return id ? pointOf(nodes, id - 1) : undefined;
  }

  /** Where a point that was picked is drawn, ECEF, metres. */
  placeOf({ drawn, index }: { readonly drawn: CesiumNode; readonly index: number }): Cartesian3 {
    const { vertices, modelMatrix } = drawn.uploaded;
    return drawnPlace(modelMatrix, vertices.positions, 3 * index);
  }

  /**
   * Where the points on the GPU are drawn, those that clips and filter leave out among them, that lie near a place.
   * @param radius metres
   * @returns x, y, z of each, ECEF, metres
   */
  near(place: Cartesian3, radius: number): number[] {
    return pointsNear(place, radius, this.content.uploaded);
  }

  /** Frees all. */
  destroy(): void {
    this.#destroyed = true;
    this.#picked.release();
    this.#endProbe();
    this.content.destroy();
    this.#drawing.destroy();
    this.#states.destroy();
    this.#pickId.destroy();
    this.objects.destroy();
  }

  #endProbe(): void {
    this.#probe.rest();
    this.#probed.release();
  }

  #probedFrame(frameState: FrameState, by: readonly unknown[]): ProbedFrame<CesiumView> {
    const { camera, context, pixelRatio } = frameState;
    const { nodes, widestPoint, heightOffset } = this.content;
    const picture = sizeOf(context);
    const points = fitFrustum(camera, spheresOf(nodes));
    const setting = this.#drawing.setting("id", points, this.content);
    return {
      nodes,
      size: picture,
      by,
      reliefOf: (node) => reliefOf(node, camera, points, heightOffset),
      numbersIn: (middles, size, gone) => {
        const reach = Math.hypot(size.width, size.height) / 2 / pixelRatio + widestPoint;
        const answers = middles.map((middle) => {
          const position = { x: middle.x / pixelRatio, y: (picture.height - middle.y) / pixelRatio };
          const window = {
            x: Math.round(middle.x - size.width / 2),
            y: Math.round(middle.y - size.height / 2),
            ...{ size, picture },
          };
          const candidates = candidatesAt(camera, position, reach, nodes);
          return this.#probed.read(window, candidates, setting, { gone });
        });
        context.uniformState.updateFrustum(camera.frustum as PointFrustum["frustum"]);
        return Promise.all(answers);
      },
    };
  }
}

/** Where a camera is, where it looks and what it sees of that. */
function cameraNumbers({ positionWC, directionWC, upWC, frustum }: Camera): number[] {
  const axes = [positionWC, directionWC, upWC].flatMap(({ x, y, z }) => [x, y, z]);
  return [...axes, ...Matrix4.toArray((frustum as PointFrustum["frustum"]).projectionMatrix)];
}

function sizeOf({ drawingBufferWidth, drawingBufferHeight }: Context): Size {
  return { width: drawingBufferWidth, height: drawingBufferHeight };
}

/** What Eye-Dome Lighting compares of a node's points, from their eye depths in float64. */
function reliefOf(
  { uploaded: { vertices } }: CesiumNode,
  { viewMatrix }: Camera,
  { frustum, orthographic }: PointFrustum,
  heightOffset: number,
): Relief {
  const matrix = matrixOf(vertices, heightOffset);
  const toEye = Matrix4.multiplyTransformation(viewMatrix, matrix, new Matrix4());
  const [, , x, , , , y, , , , z, , , , w] = Matrix4.toArray(toEye);
  const { positions } = vertices;
  const perMetre = frustum.projectionMatrix[5] / (Math.sqrt(3) * Math.LN2);
  return (index) => {
    const at = 3 * index;
    const depth = -(x * positions[at] + y * positions[at + 1] + z * positions[at + 2] + w);
    return orthographic ? depth * perMetre : Math.log2(depth);
  };
}
