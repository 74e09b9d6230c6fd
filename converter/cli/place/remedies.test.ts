import { expect, it } from "vitest";
import { remedies } from "./remedies.js";

it("names each set of missing grids once, by its best operation, and how PROJ-data's are had", () => {
  const lacking = [
    { name: "one grid", accuracy: 1, grids: ["a.tif", "b.tif"] },
    { name: "the same, better", accuracy: 0.1, grids: ["b.tif", "a.tif"] },
    { name: "the same, of unknown worth", accuracy: null, grids: ["a.tif", "b.tif"] },
    { name: "of a publisher", accuracy: null, grids: ["height.gri"] },
  ];
  const got = (name: string) => ({
    name,
    get: `projsync --file ${name}`,
    url: `https://cdn.proj.org/${name}`,
  });
  expect(remedies({ lacking })).toEqual([
    { operation: "the same, better", accuracy: 0.1, grids: [got("b.tif"), got("a.tif")] },
    { operation: "of a publisher", accuracy: null, grids: [{ name: "height.gri" }] },
  ]);
  expect(remedies(undefined)).toEqual([]);
});

it("puts no name into a command that could be more than a name", () => {
  const lacking = [{ name: "odd", accuracy: 1, grids: ["a.tif; rm -r x", "../b.tif"] }];
  expect(remedies({ lacking })[0]?.grids).toEqual([{ name: "a.tif; rm -r x" }, { name: "../b.tif" }]);
});
