import { byGroup, pointOf } from "../drawing/drawn-node.js";
import type { GpuMilliseconds, LayerRenderer as Renderer } from "../drawing/frame.js";
import { LayerContent } from "../drawing/layer-content.js";
import { nearestId, windowPixels } from "../drawing/pick-window.js";
import { quadProgramOf } from "../drawing/program-needs.js";
import type { Program } from "../drawing/programs.js";
import { type EffectPlan, FRONT, type PointPass, passesOf } from "../effects/index.js";
import type { FlatCamera } from "./flat-camera.js";
import { GlObjects, type GlTypes } from "./gl-objects.js";
import { GlUniforms } from "./gl-uniforms.js";
import { type GlView, NodeDrawable } from "./node-drawable.js";
import { Picture } from "./picture.js";
import { clear, drawPoints, drawQuad, type PassTarget, placeNodes } from "./point-passes.js";

const UNMEASURED: GpuMilliseconds = { points: undefined, picture: undefined };

/** All that a layer has and does on the GPU, in a context of its own. */
export class LayerRenderer implements Renderer<GlView> {
  readonly content: LayerContent<GlView>;
  readonly blends: boolean;
  readonly silhouettes = undefined;
  readonly measuresGpu = false;
  readonly gpuMilliseconds = UNMEASURED;
  readonly objects: GlObjects;
  readonly #gl: WebGL2RenderingContext;
  /** Values that the view itself fills. */
  readonly #view = new GlUniforms();
  readonly #picture: Picture;
  readonly #numbers: Picture;
  #camera: FlatCamera | undefined;
  #finish: ((screen: PassTarget) => void) | undefined;
  /** Frames in which something was drawn, for tests and benches. */
  #drawn = 0;

  constructor(gl: WebGL2RenderingContext) {
    this.#gl = gl;
    this.objects = new GlObjects(gl);
    const float = gl.getExtension("EXT_color_buffer_float") ?? gl.getExtension("EXT_color_buffer_half_float");
    this.blends = float !== null;
    this.#picture = new Picture(this.objects);
    this.#numbers = new Picture(this.objects);
    this.content = new LayerContent<GlView>(
      this.objects,
      this.#view,
      (pages, vertices, slot) => new NodeDrawable(pages, vertices, slot),
    );
  }

  /** How often the canvas was drawn. */
  get framesDrawn(): number {
    return this.#drawn;
  }

  /**
   * What is drawn from now on is seen by this camera.
   * @param finish draws over it
   */
  begin(camera: FlatCamera, finish?: (screen: PassTarget) => void): void {
    this.#camera = camera;
    this.#finish = finish;
  }

  /**
   * Draws what the content has prepared.
   * @param how `over`: whether what the canvas shows stays; `kept`: how many nodes, from the first, it shows already
   */
  draw(how: { readonly over?: boolean; readonly kept?: number } = {}): void {
    const camera = this.#camera;
    if (!camera) return;
    this.#drawn++;
    const screen: PassTarget = { framebuffer: undefined, viewport: [0, 0, camera.width, camera.height] };
    const { over = false, kept = 0 } = how;
    if (!over) this.#clear(camera, screen);
    this.#drawPoints(camera, screen, kept);
    this.#finish?.(screen);
  }

  /** Draws all: a map or a plot whose canvas shows what it is to show asks for no frame. */
  drawAgain(): boolean {
    this.draw();
    return true;
  }

  probe(): boolean {
    return false;
  }

  /** Nothing of the layer is in the next frame. */
  rest(): void {
    this.content.rest();
    this.#picture.release();
    this.#numbers.release();
  }

  /**
   * The point that the last frame shows nearest to a place of the map. Waits for the GPU.
   * @param position CSS pixels from the upper left
   * @param window edge of the square around it in which the nearest point counts, CSS pixels
   */
  pick(position: { readonly x: number; readonly y: number }, window: number) {
    const camera = this.#camera;
    const { nodes } = this.content;
    const gl = this.#gl;
    if (!camera || nodes.length === 0 || gl.isContextLost()) return undefined;
    const { pixelRatio } = camera;
    const edge = windowPixels(window, pixelRatio);
    const reach = (edge - 1) / 2;
    const x = Math.floor(position.x * pixelRatio) - reach;
    const y = camera.height - 1 - Math.floor(position.y * pixelRatio) - reach;
    this.#numbers.prepare(edge, edge, "byte");
    this.#setView(camera, camera.width, camera.height);
    // The whole picture, shifted so that the window comes to lie in the corner.
    const target = this.#numbers.target([-x, -y, camera.width, camera.height]);
    clear(gl, target);
    drawPoints(this.objects, "id", byGroup<GlView>(nodes), camera, target, this.#programs("id", "own"));
    const pixels = new Uint8Array(4 * edge * edge);
    gl.readPixels(0, 0, edge, edge, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    const id = nearestId(pixels, edge);
    return id ? pointOf(nodes, id - 1) : undefined;
  }

  /** RGBA of the canvas at a place, 0 to 255. @param position CSS pixels from the upper left */
  colourAt(position: { readonly x: number; readonly y: number }): Uint8Array | undefined {
    const camera = this.#camera;
    const gl = this.#gl;
    if (!camera || gl.isContextLost()) return undefined;
    const { pixelRatio } = camera;
    const pixel = new Uint8Array(4);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    const y = camera.height - 1 - Math.floor(position.y * pixelRatio);
    gl.readPixels(Math.floor(position.x * pixelRatio), y, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    return pixel;
  }

  /** Frees all. */
  destroy(): void {
    this.content.destroy();
    this.objects.destroy();
  }

  #clear({ width, height }: FlatCamera, screen: PassTarget): void {
    const { canvas } = this.#gl;
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    clear(this.#gl, screen);
  }

  #drawPoints(camera: FlatCamera, screen: PassTarget, kept: number): void {
    const gl = this.#gl;
    const { material, nodes: all } = this.content;
    if (!material || all.length === 0) return;
    const { offscreen, points, readsFront } = passesOf(material.plan);
    // A nearer point changes what blends behind it.
    const stays = points.length > 1 ? 0 : kept;
    if (stays >= all.length && !offscreen) return;
    const nodes = stays > 0 ? byGroup<GlView>(all.slice(stays)) : this.content.grouped;
    this.#setView(camera, camera.width, camera.height);
    placeNodes(this.content.groups, camera);
    if (!offscreen) {
      this.#picture.release();
      drawPoints(this.objects, "color", nodes, camera, screen, this.#programs("color", "scene"));
      return;
    }
    this.#picture.prepare(camera.width, camera.height, points.includes("splat") ? "halfFloat" : "byte");
    const target = this.#picture.target();
    if (stays === 0) clear(gl, target);
    for (const pass of points) {
      const front = readsFront && pass !== points[0] ? this.#picture.copyDepth() : undefined;
      if (front) this.#view.setTexture(FRONT, front);
      drawPoints(this.objects, pass, nodes, camera, target, this.#programs(pass, "own"));
    }
    const { colour, depth } = this.#picture;
    if (colour) this.#view.setTexture("u_color", colour);
    if (depth) this.#view.setTexture("u_depth", depth);
    const quad = this.content.programs.of(quadProgramOf(material.plan, this.content.depth));
    quad.program.use(material.uniforms);
    drawQuad(gl, screen);
  }

  #setView({ projection, pixelRatio }: FlatCamera, width: number, height: number): void {
    this.#view.set({
      u_projection: projection,
      u_viewport: [0, 0, width, height],
      u_pixelRatio: pixelRatio,
    });
  }

  /** The programs of a pass. */
  #programs(pass: PointPass, into: "scene" | "own"): (plan: EffectPlan) => Program<GlTypes> {
    const { programs } = this.content;
    return (plan) => programs.of({ plan, pass, into, logarithmic: false });
  }
}
