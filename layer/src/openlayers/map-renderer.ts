import {
  containsCoordinate,
  type Extent,
  getBottomLeft,
  getBottomRight,
  getTopLeft,
  getTopRight,
  getWidth,
} from "ol/extent.js";
import Feature from "ol/Feature.js";
import Point from "ol/geom/Point.js";
import type Layer from "ol/layer/Layer.js";
import type { FrameState } from "ol/Map.js";
import type Projection from "ol/proj/Projection.js";
import OlLayerRenderer from "ol/renderer/Layer.js";
import { apply } from "ol/transform.js";
import type { PointCloud, PointRecord } from "../cloud/index.js";
import type { DrawnNode } from "../drawing/drawn-node.js";
import { FrameFailures } from "../drawing/frame-failures.js";
import type { GlView } from "../webgl2/node-drawable.js";
import type { Corners } from "./extent-mask.js";
import type { LayerDrawing } from "./layer-drawing.js";
import { MapCanvas } from "./map-canvas.js";
import { PlacedFrames } from "./placed-frames.js";
import type { PointCloudSource } from "./point-cloud-source.js";
import { projectionOfMap } from "./projections.js";

/** Milliseconds after which a frame is drawn again while nodes are on their way. */
const PATIENCE = 50;

/** A point that was found on the map. */
interface Found {
  readonly drawn: DrawnNode<GlView>;
  readonly index: number;
  /** Where it is drawn, in the world in which it was found, units of the projection. */
  readonly coordinate: readonly [number, number];
}

/** A layer of points, as OpenLayers knows it. */
type MapLayer = Layer<PointCloudSource>;

/** Draws a layer of points for OpenLayers. */
export class MapRenderer extends OlLayerRenderer<MapLayer> {
  readonly #drawing: LayerDrawing;
  readonly #raise: (error: Error) => void;
  readonly #canvas: MapCanvas;
  readonly #failures = new FrameFailures();
  #placed: PlacedFrames | undefined;
  /** The projection that the points are placed in, or are being placed in. */
  #projection: Projection | undefined;
  /** Grows whenever what is placed or wanted is another: answers that come late are told by it. */
  #turn = 0;
  #cloud: PointCloud | undefined;
  /** What the canvas shows; undefined: it has to be drawn. */
  #shown: string | undefined;
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
  }

  /** The frames that are drawn now, for statistics. */
  get placed(): PlacedFrames | undefined {
    return this.#placed;
  }

  override prepareFrame(): boolean {
    const cloud = this.getLayer().getSource()?.cloud;
    // What is left of another data set is not to be seen in its place.
    if (this.#cloud && cloud !== this.#cloud) {
      this.#release();
      this.#cloud = undefined;
    }
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
    this.#placed?.rest(false);
    this.#shown = undefined;
    this.ready = true;
    clearTimeout(this.#timer);
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
    if (!found || !this.#placed) return [];
    const feature = featureOf(found);
    const record = await this.#read(found);
    feature.setProperties({ ...record.attributes, record }, true);
    return [feature];
  }

  /** The colour of the map's picture at a place: RGBA, 0 to 255; null where the layer shows nothing. */
  override getData(pixel: number[]): Uint8ClampedArray | null {
    const colour = this.#placed?.renderer.colourAt({ x: pixel[0], y: pixel[1] });
    return colour && colour[3] > 0 ? new Uint8ClampedArray(colour) : null;
  }

  /** The point that the map shows nearest to a place, as it is recorded. @param window CSS pixels */
  async pick(pixel: number[], window: number, signal?: AbortSignal) {
    const found = this.#find(pixel, window);
    const cloud = this.#cloud;
    if (!found || !cloud) return undefined;
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
    if (viewState.projection !== this.#projection || cloud !== this.#cloud)
      this.#place(cloud, frameState, gl);
    const placed = this.#placed;
    // What was drawn for another projection stays until the points are placed in this one.
    if (!placed || !settings || placed.octree.plane?.code !== viewState.projection.getCode()) return;
    const key = this.#keyOf(frameState);
    if (this.#shown === key) return;
    const worldWidth = worldWidthOf(viewState.projection);
    const view = { view: viewState, size, pixelRatio, worldWidth };
    const report = placed.draw(settings, view, this.#cornersIn(frameState));
    this.#tell(placed.frames.takeFailure());
    if (report === "blocked") {
      placed.rest(true);
      this.ready = true;
      return;
    }
    this.ready = report !== "unfinished" && report.done;
    this.#shown = this.ready ? key : undefined;
    if (this.ready) this.#failures.clear();
    else if (
      report === "unfinished" ||
      report.progress.pending === 0 ||
      placed.renderer.content.undrawn > 0
    ) {
      frameState.animate = true;
    } else this.#wait();
  }

  /** Corners of the layer's extent, CSS pixels. */
  #cornersIn(frameState: FrameState): Corners | undefined {
    const extent = extentIn(frameState);
    const corners =
      extent && [getBottomLeft, getBottomRight, getTopRight, getTopLeft].map((of) => of(extent));
    return corners?.map((corner) => apply(frameState.coordinateToPixelTransform, [...corner]));
  }

  /** What a picture depends on. */
  #keyOf(frameState: FrameState): string {
    const { viewState, size, pixelRatio } = frameState;
    const { center, resolution, rotation } = viewState;
    const { revision, clips } = this.#drawing;
    return `${center} ${resolution} ${rotation} ${size} ${pixelRatio} ${revision} ${clips.revision} ${extentIn(frameState)}`;
  }

  /** Has the points placed in the projection of the map. */
  #place(cloud: PointCloud, { viewState }: FrameState, gl: WebGL2RenderingContext): void {
    this.#projection = viewState.projection;
    this.#cloud = cloud;
    this.#turn++;
    this.ready = false;
    const map = this.getLayer().getMapInternal();
    const finest = map?.getView().getMinResolution() ?? viewState.resolution;
    const projection = projectionOfMap(viewState.projection, finest, cloud.name);
    void this.#replace(cloud, projection, gl, this.#turn);
  }

  async #replace(
    cloud: PointCloud,
    projection: ReturnType<typeof projectionOfMap>,
    gl: WebGL2RenderingContext,
    turn: number,
  ): Promise<void> {
    try {
      const octree = await cloud.maps.acquire(projection);
      if (turn !== this.#turn || this.#destroyed) {
        cloud.maps.release(octree);
        return;
      }
      this.#placed?.destroy();
      this.#placed = new PlacedFrames(cloud, octree, gl, this.getLayer(), {
        changed: () => this.#changed(),
        failed: (error) => this.#tell(error),
      });
    } catch (thrown) {
      if (turn !== this.#turn) return;
      this.#tell(thrown);
      this.#placed?.destroy();
      this.#placed = undefined;
      this.ready = true;
    }
    this.#changed();
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
    const error = this.#failures.note(thrown, this.#cloud?.name ?? "map");
    if (error) this.#raise(error);
  }

  #release(): void {
    this.#turn++;
    this.#projection = undefined;
    this.#placed?.destroy();
    this.#placed = undefined;
    this.#shown = undefined;
    clearTimeout(this.#timer);
  }

  #find([x, y]: number[], window: number): Found | undefined {
    const [width, height] = this.#frameState?.size ?? [0, 0];
    if (x < 0 || y < 0 || x >= width || y >= height) return undefined;
    const point = this.#placed?.renderer.pick({ x, y }, window);
    const frameState = this.#frameState;
    if (!point || !frameState) return undefined;
    const coordinate = this.#coordinateOf(point, apply(frameState.pixelToCoordinateTransform, [x, y]));
    const extent = extentIn(frameState);
    return extent && !containsCoordinate(extent, coordinate) ? undefined : { ...point, coordinate };
  }

  #read({ drawn, index }: Found, signal?: AbortSignal): Promise<PointRecord> {
    return this.#placed!.cloud.readPoint(drawn.node, index, { signal });
  }

  /** Where a point is drawn, units of the projection. @param near a place in the world in which it was found */
  #coordinateOf({ drawn, index }: Omit<Found, "coordinate">, near: readonly number[]): [number, number] {
    const { positions, frame } = drawn.uploaded.vertices;
    const { metresPerUnit = 1 } = this.#placed?.octree.plane ?? {};
    const [x, y] = [0, 1].map((axis) => (frame.origin[axis] + positions[3 * index + axis]) / metresPerUnit);
    const width = this.#projection && worldWidthOf(this.#projection);
    return [width ? x + width * Math.round((near[0] - x) / width) : x, y];
  }
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

/** Beyond which nothing of the layer is to show, units of the projection. */
function extentIn({ layerStatesArray, layerIndex }: FrameState): Extent | undefined {
  return layerStatesArray[layerIndex].extent;
}
