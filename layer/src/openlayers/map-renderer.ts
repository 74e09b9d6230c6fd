import {
  containsCoordinate,
  type Extent,
  getBottomLeft,
  getBottomRight,
  getIntersection,
  getTopLeft,
  getTopRight,
  getWidth,
  isEmpty,
} from "ol/extent.js";
import Feature from "ol/Feature.js";
import Point from "ol/geom/Point.js";
import type Layer from "ol/layer/Layer.js";
import type { FrameState } from "ol/Map.js";
import type Projection from "ol/proj/Projection.js";
import OlLayerRenderer from "ol/renderer/Layer.js";
import { apply } from "ol/transform.js";
import type { PointRecord } from "../cloud/index.js";
import type { DrawnNode } from "../drawing/drawn-node.js";
import type { FrameReport } from "../drawing/frame.js";
import { FrameFailures } from "../drawing/frame-failures.js";
import type { GlView } from "../webgl2/node-drawable.js";
import type { Corners } from "./extent-mask.js";
import type { LayerDrawing } from "./layer-drawing.js";
import { MapCanvas } from "./map-canvas.js";
import { MapPlacing } from "./map-placing.js";
import type { PlacedFrames } from "./placed-frames.js";
import type { PointCloudSource } from "./point-cloud-source.js";

/** Milliseconds after which a frame is drawn again while nodes are on their way. */
const PATIENCE = 50;

/** Corners of an extent that nothing of is in the picture, CSS pixels. */
const NOWHERE: Corners = [
  [-2, -2],
  [-1, -2],
  [-1, -1],
  [-2, -1],
];

/** A point that was found on the map. */
interface Found {
  readonly placed: PlacedFrames;
  readonly drawn: DrawnNode<GlView>;
  readonly index: number;
  /** Where it is drawn, in the world in which it was found, units of the projection. */
  readonly coordinate: readonly [number, number];
}

/** A frame that did not show all. */
interface Unfinished {
  readonly report: FrameReport | "unfinished";
  readonly placed: PlacedFrames;
}

/** A layer of points, as OpenLayers knows it. */
type MapLayer = Layer<PointCloudSource>;

/** Draws a layer of points for OpenLayers. */
export class MapRenderer extends OlLayerRenderer<MapLayer> {
  readonly #drawing: LayerDrawing;
  readonly #raise: (error: Error) => void;
  readonly #canvas: MapCanvas;
  readonly #failures = new FrameFailures();
  readonly #placing: MapPlacing;
  /** What the canvas shows; undefined: it has to be drawn. */
  #shown: string | undefined;
  /** Whether there may be something on the canvas. */
  #lit = false;
  #frameState: FrameState | undefined;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #destroyed = false;

  /** @param raise tells the layer's users of an error */
  constructor(layer: MapLayer, drawing: LayerDrawing, raise: (error: Error) => void) {
    super(layer);
    this.#drawing = drawing;
    this.#raise = raise;
    this.#canvas = new MapCanvas(layer.getClassName(), {
      lost: () => this.#release(),
      restored: () => this.#changed(),
    });
    this.#placing = new MapPlacing(layer, {
      changed: () => this.#changed(),
      failed: (error) => this.#tell(error),
    });
  }

  /** The frames that are drawn now, for statistics. */
  get placed(): PlacedFrames | undefined {
    return this.#placing.shown;
  }

  override prepareFrame(): boolean {
    const cloud = this.getLayer().getSource()?.cloud;
    // What is left of another data set is not to be seen in its place.
    if (this.#placing.cloud && cloud !== this.#placing.cloud) this.#release();
    return cloud !== undefined;
  }

  override renderFrame(frameState: FrameState): HTMLElement {
    this.#frameState = frameState;
    const { layerStatesArray, layerIndex, size } = frameState;
    this.#canvas.lay(size, layerStatesArray[layerIndex].opacity);
    try {
      this.#draw(frameState);
    } catch (thrown) {
      this.#tell(thrown);
      this.ready = true;
    }
    return this.#canvas.element;
  }

  /** Nothing of the layer is in the map's frames for now. */
  rest(): void {
    this.#placing.rest();
    this.#shown = undefined;
    this.ready = true;
    clearTimeout(this.#timer);
  }

  /** Lets what failed be asked for again, by the next frame, and told again where it fails again. */
  retryFailed(): void {
    this.#placing.retryFailed();
    this.#failures.clear();
    // Only a frame that is drawn anew asks for what its view wants.
    this.#changed();
  }

  /** What is drawn was changed. */
  invalidate(): void {
    this.#shown = undefined;
  }

  override forEachFeatureAtCoordinate<T>(
    coordinate: number[],
    frameState: FrameState,
    hitTolerance: number,
    callback: (feature: Feature, layer: MapLayer, geometry: Point) => T | undefined,
  ): T | undefined {
    const pixel = apply(frameState.coordinateToPixelTransform, [...coordinate]);
    const found = this.#find(pixel, 2 * hitTolerance + 1);
    if (!found) return undefined;
    const feature = featureOf(found);
    return callback(feature, this.getLayer(), feature.getGeometry() as Point);
  }

  override async getFeatures(pixel: number[]): Promise<Feature[]> {
    const found = this.#find(pixel, 1);
    if (!found) return [];
    const feature = featureOf(found);
    const record = await this.#read(found);
    feature.setProperties({ ...record.attributes, record }, true);
    return [feature];
  }

  /** The colour of the map's picture at a place: RGBA, 0 to 255; null where the layer shows nothing. */
  override getData(pixel: number[]): Uint8ClampedArray | null {
    const colour = this.placed?.renderer.colourAt({ x: pixel[0], y: pixel[1] });
    return colour && colour[3] > 0 ? new Uint8ClampedArray(colour) : null;
  }

  /** The point that the map shows nearest to a place, as it is recorded. @param window CSS pixels */
  async pick(pixel: number[], window: number, signal?: AbortSignal) {
    const found = this.#find(pixel, window);
    if (!found) return undefined;
    const { cloud } = found.placed;
    const record = await this.#read(found, signal);
    return { ...record, cloud, coordinate: found.coordinate };
  }

  override disposeInternal(): void {
    this.#destroyed = true;
    this.#release();
    this.#canvas.destroy();
    super.disposeInternal();
  }

  #draw(frameState: FrameState): void {
    const { viewState, size, pixelRatio } = frameState;
    const cloud = this.getLayer().getSource()?.cloud;
    const gl = this.#canvas.gl;
    if (!cloud || !gl) return;
    this.#drawing.follow(cloud);
    const { settings } = this.#drawing;
    const placing = this.#placing;
    const { projection } = viewState;
    const finest = this.getLayer().getMapInternal()?.getView().getMinResolution() ?? viewState.resolution;
    placing.want({ cloud, projection, finest }, gl);
    if (!settings) return;
    const view = { view: viewState, size, pixelRatio, worldWidth: worldWidthOf(projection) };
    const coming = placing.advance(settings, view);
    this.ready = !placing.pending;
    if (coming) this.#goOn(frameState, coming);
    const placed = placing.shown;
    if (!placed && !placing.pending) this.#wipe();
    // What was drawn for another projection stays until the points are placed in this one.
    if (placed?.projection !== projection) return;
    const key = this.#keyOf(frameState);
    if (this.#shown === key) return;
    const report = placed.draw(settings, view, this.#cornersIn(frameState));
    this.#lit = true;
    this.#tell(placed.frames.takeFailure());
    if (report === "blocked") {
      placed.rest(true);
      return;
    }
    const done = report !== "unfinished" && report.done;
    this.#shown = done ? key : undefined;
    this.ready &&= done;
    if (this.ready) this.#failures.clear();
    if (!done) this.#goOn(frameState, { report, placed });
  }

  /** Has another frame drawn: the next one where there is something to do, else soon, while nodes are on their way. */
  #goOn(frameState: FrameState, { report, placed }: Unfinished): void {
    if (report === "unfinished" || report.progress.pending === 0 || placed.renderer.content.undrawn > 0) {
      frameState.animate = true;
    } else this.#wait();
  }

  /** Corners of the layer's extent, CSS pixels. */
  #cornersIn(frameState: FrameState): Corners | undefined {
    const extent = extentIn(frameState, this.placed);
    if (!extent) return undefined;
    if (isEmpty(extent)) return NOWHERE;
    const corners = [getBottomLeft, getBottomRight, getTopRight, getTopLeft].map((of) => of(extent));
    return corners.map((corner) => apply(frameState.coordinateToPixelTransform, [...corner]));
  }

  /** What a picture depends on. */
  #keyOf(frameState: FrameState): string {
    const { viewState, size, pixelRatio } = frameState;
    const { center, resolution, rotation } = viewState;
    const { revision, clips } = this.#drawing;
    return `${center} ${resolution} ${rotation} ${size} ${pixelRatio} ${revision} ${clips.revision} ${extentIn(frameState, this.placed)}`;
  }

  #changed(): void {
    this.#shown = undefined;
    clearTimeout(this.#timer);
    if (!this.#destroyed) this.getLayer().changed();
  }

  #wait(): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#changed(), PATIENCE);
  }

  #tell(thrown: unknown): void {
    const error = this.#failures.note(thrown, this.#placing.cloud?.name ?? "map");
    if (error) this.#raise(error);
  }

  #release(): void {
    this.#placing.clear();
    this.#drawing.budget?.gpu.report(this.getLayer(), 0);
    this.#wipe();
    this.#shown = undefined;
    clearTimeout(this.#timer);
  }

  #wipe(): void {
    if (this.#lit) this.#canvas.wipe();
    this.#lit = false;
  }

  #find([x, y]: number[], window: number): Found | undefined {
    const { placed } = this;
    const frameState = this.#frameState;
    if (!placed || placed.projection !== frameState?.viewState.projection) return undefined;
    const [width, height] = frameState.size;
    if (x < 0 || y < 0 || x >= width || y >= height) return undefined;
    const point = placed.renderer.pick({ x, y }, window);
    if (!point) return undefined;
    const near = apply(frameState.pixelToCoordinateTransform, [x, y]);
    const found = { ...point, placed, coordinate: coordinateOf(point, placed, near) };
    const extent = extentIn(frameState, placed);
    return extent && !containsCoordinate(extent, found.coordinate) ? undefined : found;
  }

  #read({ placed, drawn, index }: Found, signal?: AbortSignal): Promise<PointRecord> {
    return placed.cloud.readPoint(drawn.node, index, { signal });
  }
}

/** Where a point is drawn, units of the projection. @param near a place in the world in which it was found */
function coordinateOf(
  { drawn, index }: Pick<Found, "drawn" | "index">,
  { octree, projection }: PlacedFrames,
  near: readonly number[],
): [number, number] {
  const { positions, frame } = drawn.uploaded.vertices;
  const { metresPerUnit = 1 } = octree.plane ?? {};
  const [x, y] = [0, 1].map((axis) => (frame.origin[axis] + positions[3 * index + axis]) / metresPerUnit);
  const width = worldWidthOf(projection);
  return [width ? x + width * Math.round((near[0] - x) / width) : x, y];
}

function featureOf({ drawn: { node, uploaded }, index, coordinate }: Found): Feature {
  const record = uploaded.vertices.order[index];
  const feature = new Feature({ geometry: new Point([...coordinate]), node: node.name, index: record });
  feature.setId(`${node.name}/${record}`);
  return feature;
}

/** Width of the world, units of the projection, where the map shows one beside the other. */
function worldWidthOf(projection: Projection): number | undefined {
  return projection.canWrapX() ? getWidth(projection.getExtent()) : undefined;
}

/** Beyond which nothing of the layer is to show, units of the projection: the layer's own extent, and the world's edges. */
function extentIn(
  { layerStatesArray, layerIndex, viewState, size }: FrameState,
  placed: PlacedFrames | undefined,
): Extent | undefined {
  const { extent } = layerStatesArray[layerIndex];
  if (!placed?.edges) return extent;
  const { center, resolution } = viewState;
  const [[south, north], reach] = [placed.edges, resolution * Math.hypot(...size)];
  const world = [center[0] - reach, south, center[0] + reach, north];
  return extent ? getIntersection(extent, world) : world;
}
