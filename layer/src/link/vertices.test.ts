import LineString from "ol/geom/LineString.js";
import MultiPolygon from "ol/geom/MultiPolygon.js";
import Point from "ol/geom/Point.js";
import Polygon from "ol/geom/Polygon.js";
import { expect, it } from "vitest";
import { insertVertex, moveVertex, removeVertex, rowsOf } from "./vertices.js";

const SQUARE = [
  [0, 0],
  [4, 0],
  [4, 4],
  [0, 4],
  [0, 0],
];

it("puts a vertex into a side, and gives it as it is then", () => {
  const line = new LineString([
    [0, 0, 1],
    [4, 0, 1],
  ]);
  const vertex = insertVertex({ row: rowsOf(line)[0]!, index: 0 }, [2, 1, 5]);
  expect(vertex.index).toBe(1);
  moveVertex(vertex, [3, 1, 6]);
  expect(line.getCoordinates()).toEqual([
    [0, 0, 1],
    [3, 1, 6],
    [4, 0, 1],
  ]);
  // The last side of a ring is closed as before, whatever heights its vertices cannot hold.
  const areas = new MultiPolygon([[SQUARE], [SQUARE]]);
  insertVertex({ row: rowsOf(areas)[1]!, index: 3 }, [-1, 2, 9]);
  expect(areas.getCoordinates()).toEqual([[SQUARE], [[...SQUARE.slice(0, 4), [-1, 2], [0, 0]]]]);
});

it("takes a vertex out as long as a line or an area is left, and closes the ring again", () => {
  for (const index of [0, 4]) {
    const area = new Polygon([SQUARE]);
    expect(removeVertex({ row: rowsOf(area)[0]!, index })).toBe(true);
    const left = [...SQUARE.slice(1, 4), [4, 0]];
    expect(area.getCoordinates()).toEqual([left]);
    expect(removeVertex({ row: rowsOf(area)[0]!, index: 1 })).toBe(false);
    expect(area.getCoordinates()).toEqual([left]);
  }
  const line = new LineString(SQUARE.slice(0, 3));
  expect(removeVertex({ row: rowsOf(line)[0]!, index: 1 })).toBe(true);
  expect(line.getCoordinates()).toEqual([SQUARE[0], SQUARE[2]]);
  expect(removeVertex({ row: rowsOf(line)[0]!, index: 1 })).toBe(false);
  expect(removeVertex({ row: rowsOf(new Point([0, 0]))[0]!, index: 0 })).toBe(false);
});

it("moves the vertex that closes a ring with the one that begins it", () => {
  const area = new Polygon([SQUARE]);
  moveVertex({ row: rowsOf(area)[0]!, index: 4 }, [-1, -1, 3]);
  expect(area.getCoordinates()).toEqual([[[-1, -1], ...SQUARE.slice(1, 4), [-1, -1]]]);
});
