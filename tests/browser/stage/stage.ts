import { ClipSet, PointCloud, PointCloudLayer } from "@groma/layer/cesium";
import {
  BoxGeometry,
  Cartesian3,
  CesiumWidget,
  Color,
  ColorGeometryInstanceAttribute,
  EllipsoidTerrainProvider,
  GeometryInstance,
  HeadingPitchRange,
  JulianDate,
  Matrix4,
  OrthographicFrustum,
  PerInstanceColorAppearance,
  Primitive,
  type SkyBox,
  Transforms,
} from "cesium";
import { type LayerOptions, MIDDLE, type Pose, type StageOptions } from "./setting.js";

/** Scans that are open. */
const clouds = new Map<string, Promise<PointCloud>>();

/** A small Cesium scene that draws a frame only when it is told to, so that what it shows does not hang on time. */
export class Stage {
  readonly widget: CesiumWidget;
  readonly #container: HTMLElement;
  #ahead = false;
  layer!: PointCloudLayer;

  constructor(options: StageOptions = {}) {
    this.#container = document.createElement("div");
    this.resize(options.width ?? 256, options.height ?? 192);
    document.body.append(this.#container);
    const credits = document.createElement("div");
    this.widget = new CesiumWidget(this.#container, {
      baseLayer: false,
      ...(options.globe ? { terrainProvider: new EllipsoidTerrainProvider() } : { globe: false as const }),
      skyBox: false as unknown as SkyBox,
      skyAtmosphere: false,
      shouldAnimate: false,
      useDefaultRenderLoop: false,
      useBrowserRecommendedResolution: false,
      scene3DOnly: options.scene3DOnly ?? true,
      msaaSamples: options.msaa ?? 1,
      requestRenderMode: options.requestRenderMode ?? false,
      creditContainer: credits,
    });
    const { scene } = this.widget;
    this.widget.resolutionScale = (options.pixelRatio ?? 1) / window.devicePixelRatio;
    scene.backgroundColor = Color.fromBytes(24, 28, 40);
    scene.highDynamicRange = options.hdr ?? false;
    scene.logarithmicDepthBuffer = options.logDepth ?? true;
    scene.rethrowRenderErrors = true;
    if (scene.sun) scene.sun.show = false;
    if (scene.moon) scene.moon.show = false;
    if (scene.globe) {
      scene.globe.baseColor = Color.fromBytes(60, 80, 110);
      scene.globe.showGroundAtmosphere = false;
      scene.globe.enableLighting = false;
      scene.fog.enabled = false;
    }
  }

  get scene() {
    return this.widget.scene;
  }

  /** Shows a scan of the server alone; each is opened once, for all stages. */
  async show(name: string, options: LayerOptions = {}): Promise<PointCloudLayer> {
    this.scene.primitives.removeAll();
    return this.add(name, options);
  }

  /** Shows a scan of the server besides what is shown. */
  async add(name: string, { clips, tolerance, ...options }: LayerOptions = {}): Promise<PointCloudLayer> {
    const key = `${name} ${tolerance}`;
    const cloud =
      clouds.get(key) ?? PointCloud.fromUrl(`/clouds/${name}.copc.laz`, { workers: { size: 1 }, tolerance });
    clouds.set(key, cloud);
    this.layer = PointCloudLayer.fromCloud(await cloud, {
      ...options,
      ...(clips && { clips: new ClipSet(clips) }),
    });
    this.scene.primitives.add(this.layer);
    return this.layer;
  }

  /** Adds a red box. @param edge metres @returns the box; its `modelMatrix` moves it, ECEF, metres */
  box(at: Pose["at"] = MIDDLE, edge = 1): Primitive {
    const middle = Cartesian3.fromArray([...this.layer.cloud.place(...at)]);
    const geometry = BoxGeometry.fromDimensions({
      dimensions: new Cartesian3(edge, edge, edge),
      vertexFormat: PerInstanceColorAppearance.FLAT_VERTEX_FORMAT,
    });
    const color = ColorGeometryInstanceAttribute.fromColor(Color.RED);
    const modelMatrix = Transforms.eastNorthUpToFixedFrame(middle);
    return this.scene.primitives.add(
      new Primitive({
        geometryInstances: new GeometryInstance({ geometry, modelMatrix, attributes: { color } }),
        appearance: new PerInstanceColorAppearance({ flat: true, translucent: false }),
        asynchronous: false,
      }),
    );
  }

  /** Sends the camera somewhere. */
  look({ at = MIDDLE, heading = 0, pitch = -90, range }: Pose): void {
    const { camera } = this.scene;
    const target = Cartesian3.fromArray([...this.layer.cloud.place(...at)]);
    const toRadians = Math.PI / 180;
    camera.lookAt(target, new HeadingPitchRange(heading * toRadians, pitch * toRadians, range));
    camera.lookAtTransform(Matrix4.IDENTITY);
  }

  /** Moves the camera a millimetre ahead, and back at the next call: what stands still need not be drawn anew. */
  sway(): void {
    this.#ahead = !this.#ahead;
    this.scene.camera.moveForward(this.#ahead ? 0.001 : -0.001);
  }

  /** From now on without perspective; `width` metres fill the picture. */
  orthographic(width: number): void {
    const { camera, canvas } = this.scene;
    const frustum = new OrthographicFrustum();
    frustum.aspectRatio = canvas.clientWidth / canvas.clientHeight;
    frustum.width = width;
    camera.frustum = frustum;
  }

  /** Gives the picture another size, CSS pixels. */
  resize(width: number, height: number): void {
    this.#container.style.cssText = `width:${width}px;height:${height}px`;
  }

  /** Draws one frame. */
  frame(): void {
    this.widget.resize();
    this.scene.render(JulianDate.fromIso8601("2024-06-21T11:00:00Z"));
  }

  /** Draws frames until all layers show what their view wants. */
  async settle(layers: readonly PointCloudLayer[] = [this.layer], timeout = 20_000): Promise<void> {
    const end = performance.now() + timeout;
    for (;;) {
      this.frame();
      this.wait();
      if (layers.every((layer) => layer.settled) && (this.scene.globe?.tilesLoaded ?? true)) return;
      if (performance.now() > end) throw new Error(`not settled: ${JSON.stringify(layers[0]?.statistics)}`);
      await new Promise((done) => setTimeout(done, 5));
    }
  }

  /** Waits until the GPU has drawn all that it was given. */
  wait(): void {
    const { gl } = this;
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  /** Draws a frame and returns it as an address of a PNG. */
  picture(): string {
    this.frame();
    return this.scene.canvas.toDataURL("image/png");
  }

  /** WebGL errors that stand, by number. */
  errors(): number[] {
    const gl = this.gl;
    const found: number[] = [];
    for (let error = gl.getError(); error !== gl.NO_ERROR && found.length < 10; error = gl.getError()) {
      found.push(error);
    }
    return found;
  }

  get gl(): WebGL2RenderingContext {
    return this.scene.canvas.getContext("webgl2") as WebGL2RenderingContext;
  }

  destroy(): void {
    this.widget.destroy();
    this.#container.remove();
  }
}
