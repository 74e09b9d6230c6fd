import type OlMap from "ol/Map.js";
import { fromLonLat } from "ol/proj.js";
import View from "ol/View.js";
import { describe, expect, it } from "vitest";
import { placeVertex } from "../tools/index.js";
import { measureView } from "./measure-view.js";

const DEGREE = Math.PI / 180;
const place = (longitude: number, latitude: number) => placeVertex(longitude * DEGREE, latitude * DEGREE, 0);

/** A map of 600 × 400 pixels around a longitude, as far as places on it matter. */
function viewAround(longitude: number, resolution: number) {
  const view = new View({ center: fromLonLat([longitude, 0]), resolution, multiWorld: true });
  const [east, north] = view.getCenter()!;
  const map = {
    getView: () => view,
    getViewport: () => undefined,
    getPixelFromCoordinate: ([x, y]: number[]) => [
      300 + (x - east) / resolution,
      200 - (y - north) / resolution,
    ],
    getCoordinateFromPixel: ([x, y]: number[]) => [
      east + (x - 300) * resolution,
      north - (y - 200) * resolution,
    ],
  };
  return measureView(map as unknown as OlMap, () => []);
}

const METRES = 20037508.342789244 / 180;

describe("places on a map that goes around the earth", () => {
  it("are those nearest to its middle", () => {
    const view = viewAround(180, METRES / 10);
    expect(view.project(place(179, 0))?.x).toBeCloseTo(290, 6);
    expect(view.project(place(-179, 0))?.x).toBeCloseTo(310, 6);
    // One that was turned on and on stands in another world.
    expect(viewAround(-541, METRES / 10).project(place(178, 0))?.x).toBeCloseTo(290, 6);
  });

  it("are those nearest to where a figure was before", () => {
    // Both worlds show: the second vertex stands beside the first, not across the map.
    const view = viewAround(0, METRES);
    const first = view.project(place(170, 0));
    expect(first?.x).toBeCloseTo(470, 6);
    expect(view.project(place(-175, 0), first)?.x).toBeCloseTo(485, 6);
    expect(view.project(place(-175, 0))?.x).toBeCloseTo(125, 6);
  });
});
