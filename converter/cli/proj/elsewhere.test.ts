import type { AreaOfUse } from "@groma/georef";
import { expect, it } from "vitest";
import { ranked } from "./elsewhere.js";
import type { Operation } from "./operation.js";

const EUROPE: AreaOfUse = [-10, 35, 30, 70];
const FRANCE: AreaOfUse = [-5, 42, 8, 51];

function order(...list: readonly (readonly [number | null, AreaOfUse | undefined, string?])[]): number[] {
  const operations = list.map(([accuracy, , area = "somewhere"]): Operation => {
    return { name: "of one name", accuracy, area, ballpark: false, missingGrids: [] };
  });
  const areas = new Map(operations.map((operation, i) => [operation, list[i]![1]]));
  return ranked(operations, areas).map(({ operation }) => operations.indexOf(operation));
}

it("operations go in PROJ's order: the more accurate first, of equals that for the smaller area", () => {
  expect(order([1, FRANCE], [0.5, EUROPE])).toEqual([1, 0]);
  expect(order([1, EUROPE], [1, FRANCE])).toEqual([1, 0]);
  expect(order([1, FRANCE], [1, EUROPE])).toEqual([0, 1]);
});

it("unknown accuracies are equal to each other, and are taken before or after known ones as they are listed", () => {
  expect(order([null, EUROPE], [null, FRANCE])).toEqual([1, 0]);
  expect(order([null, EUROPE], [1, FRANCE])).toEqual([0, 1]);
  expect(order([1, EUROPE], [null, FRANCE])).toEqual([0, 1]);
});

it("those for the sea, without a named area, or without any, give way", () => {
  expect(order([1, EUROPE], [0.5, FRANCE, "France - offshore"])).toEqual([0, 1]);
  expect(order([1, EUROPE], [1, FRANCE, "unknown domain of validity"])).toEqual([0, 1]);
  expect(order([1, EUROPE], [0.5, undefined])).toEqual([0]);
});
