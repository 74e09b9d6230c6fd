import { DrawList } from "../drawing/draw-list.js";
import type { GroupedNodes } from "../drawing/drawn-node.js";
import type { NodeGroup } from "../drawing/node-group.js";
import type { Program } from "../drawing/programs.js";
import { type EffectPlan, NODE_NUMBER, type PointPass, writeMatrix } from "../effects/index.js";
import type { FlatCamera } from "./flat-camera.js";
import type { GlObjects, GlTypes } from "./gl-objects.js";
import type { GlFramebuffer, GlVertexArray } from "./gl-types.js";
import type { GlView } from "./node-drawable.js";

/** What is drawn into, in pixels: the canvas, or a picture of the layer's own. */
export interface PassTarget {
  /** Undefined: the canvas. */
  readonly framebuffer: GlFramebuffer | undefined;
  /** Lower left corner, width and height of the whole picture in it. */
  readonly viewport: readonly [x: number, y: number, width: number, height: number];
}

/** Binds a target, and clears it: colours to nothing, depths to the farthest. */
export function clear(gl: WebGL2RenderingContext, target: PassTarget): void {
  bind(gl, target);
  gl.colorMask(true, true, true, true);
  gl.depthMask(true);
  gl.clearColor(0, 0, 0, 0);
  gl.clearDepth(1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
}

/** Has the nodes seen by a camera, once for each world that shows, in whatever is drawn of them next. */
export function placeNodes(groups: readonly NodeGroup<GlView>[], camera: FlatCamera): void {
  const { worlds, modelView } = camera;
  for (const group of groups) {
    const toEye = group.placeIn("u_modelView");
    const toGlobe = group.placeIn("u_onGlobe");
    group.place(worlds.length, [camera], ({ uploaded: { vertices, onGlobe } }, copy, table, begin) => {
      const { step = 1 } = vertices;
      if (toEye !== undefined) {
        writeMatrix(table, begin + toEye, modelView(vertices.frame.origin, worlds[copy]), step);
      }
      if (toGlobe !== undefined) writeMatrix(table, begin + toGlobe, onGlobe, step);
    });
  }
}

/** Draws nodes that have been placed. */
export function drawPoints(
  { gl, draws }: GlObjects,
  pass: PointPass,
  nodes: GroupedNodes<GlView>,
  camera: FlatCamera,
  target: PassTarget,
  programOf: (plan: EffectPlan) => Program<GlTypes>,
): void {
  bind(gl, target);
  setState(gl, pass);
  const list = new DrawList<GlVertexArray>();
  for (const [group, members] of nodes) {
    const { program, reads } = programOf(group.plan);
    // Nodes may be given attributes here, which binds arrays and buffers of theirs.
    list.fill(members, reads);
    program.use(group.uniforms);
    const number = (row: number) => program.setInteger(NODE_NUMBER, row);
    camera.worlds.forEach((_, copy) => {
      draws.draw(list, { bind: (array) => bindArray(gl, array), number }, copy * group.rows);
    });
  }
  gl.bindVertexArray(null);
}

/** Has points read from a vertex array, and its constants. */
function bindArray(gl: WebGL2RenderingContext, { array, constants }: GlVertexArray): void {
  gl.bindVertexArray(array);
  for (const { location, value } of constants) {
    const [x = 0, y = 0, z = 0, w = 1] = value;
    gl.vertexAttrib4f(location, x, y, z, w);
  }
}

/** Draws a triangle over the whole of a target. */
export function drawQuad(gl: WebGL2RenderingContext, target: PassTarget): void {
  bind(gl, target);
  setState(gl, "color");
  gl.bindVertexArray(null);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
}

function bind(gl: WebGL2RenderingContext, { framebuffer, viewport }: PassTarget): void {
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer?.framebuffer ?? null);
  gl.viewport(...viewport);
}

/** How colour and depth are treated: the nearest wins, but splats within the blend depth of the nearest add up. */
function setState(gl: WebGL2RenderingContext, pass: PointPass): void {
  gl.enable(gl.DEPTH_TEST);
  gl.depthFunc(gl.LEQUAL);
  gl.disable(gl.CULL_FACE);
  gl.disable(gl.DITHER);
  const shown = pass !== "depth";
  gl.colorMask(shown, shown, shown, shown);
  gl.depthMask(pass !== "splat");
  if (pass !== "splat") {
    gl.disable(gl.BLEND);
    return;
  }
  gl.enable(gl.BLEND);
  gl.blendEquation(gl.FUNC_ADD);
  gl.blendFunc(gl.ONE, gl.ONE);
}
