import type { Vector } from "@groma/georef";
import {
  ArcType,
  Cartesian3,
  Color,
  GeometryInstance,
  Material,
  type PointPrimitive,
  PointPrimitiveCollection,
  PolylineGeometry,
  PolylineMaterialAppearance,
  Primitive,
  PrimitiveCollection,
  type Scene,
} from "cesium";
import { ACCENT } from "./looks.js";

/** Width of lines and vertices on the globe, CSS pixels. */
const WIDTHS = { line: 3, vertex: 9 };

/** A line on the globe, or points that no line joins: places of ECEF. */
export interface GlobeLine {
  readonly vertices: readonly Vector[];
  /** The way through the vertices, none where no line joins them. */
  readonly way: readonly Vector[];
}

/** What is drawn of one feature. */
interface Drawn {
  readonly lines: Primitive[];
  readonly ways: readonly (readonly Vector[])[];
  readonly points: PointPrimitive[];
}

/**
 * Lines and vertices on a globe, by the feature that they belong to. They lie on points of the cloud, and would be half
 * hidden by them: nothing hides them.
 */
export class GlobeLines<Feature extends object> {
  readonly #scene: Scene;
  readonly #lines: PrimitiveCollection;
  readonly #points: PointPrimitiveCollection;
  readonly #drawn = new Map<Feature, Drawn>();

  constructor(scene: Scene) {
    this.#scene = scene;
    this.#lines = scene.primitives.add(new PrimitiveCollection());
    this.#points = scene.primitives.add(new PointPrimitiveCollection());
  }

  /** Features of which something is drawn. */
  get features(): Feature[] {
    return [...this.#drawn.keys()];
  }

  /** Draws a feature as it is now; without lines: nothing of it. */
  show(feature: Feature, lines: readonly GlobeLine[]): void {
    const before = this.#drawn.get(feature);
    for (const line of before?.lines ?? []) this.#lines.remove(line);
    for (const point of before?.points ?? []) this.#points.remove(point);
    this.#drawn.delete(feature);
    if (lines.length > 0) {
      const ways = lines.map(({ way }) => way).filter((way) => way.length > 1);
      this.#drawn.set(feature, {
        ways,
        lines: ways.filter(hasLength).map((way) => this.#line(way)),
        points: lines.flatMap(({ vertices }) => vertices.map((place) => this.#point(place))),
      });
    }
    this.#scene.requestRender();
  }

  /** Places that are drawn of a feature, ECEF. */
  placesOf(feature: Feature): { readonly vertices: Vector[]; readonly ways: Vector[][] } {
    const { ways = [], points = [] } = this.#drawn.get(feature) ?? {};
    const vector = ({ x, y, z }: Cartesian3): Vector => [x, y, z];
    return {
      vertices: points.map(({ position }) => vector(position)),
      ways: ways.map((way) => [...way]),
    };
  }

  dispose(): void {
    if (this.#scene.isDestroyed()) return;
    this.#scene.primitives.remove(this.#lines);
    this.#scene.primitives.remove(this.#points);
    this.#scene.requestRender();
  }

  #line(way: readonly Vector[]): Primitive {
    const positions = way.map((place) => new Cartesian3(...place));
    const { VERTEX_FORMAT: vertexFormat } = PolylineMaterialAppearance;
    const width = WIDTHS.line + 2;
    const geometry = new PolylineGeometry({ positions, width, vertexFormat, arcType: ArcType.NONE });
    const material = Material.fromType("PolylineOutline", {
      color: Color.fromCssColorString(ACCENT),
      outlineColor: Color.BLACK,
      outlineWidth: 1,
    });
    const appearance = new PolylineMaterialAppearance({
      material,
      renderState: { depthTest: { enabled: false }, depthMask: false },
    });
    const geometryInstances = new GeometryInstance({ geometry });
    return this.#lines.add(
      new Primitive({ geometryInstances, appearance, asynchronous: false, allowPicking: false }),
    );
  }

  #point(place: Vector): PointPrimitive {
    return this.#points.add({
      position: new Cartesian3(...place),
      pixelSize: WIDTHS.vertex,
      color: Color.fromCssColorString(ACCENT),
      outlineColor: Color.BLACK,
      outlineWidth: 1,
      disableDepthTestDistance: Number.POSITIVE_INFINITY,
    });
  }
}

/** Whether a way goes anywhere: two vertices in one place make no line. */
function hasLength([first, ...others]: readonly Vector[]): boolean {
  return others.some((place) => place.some((value, axis) => value !== first[axis]));
}
