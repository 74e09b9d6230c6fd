import * as georef from "@groma/georef";
import * as layer from "@groma/layer";
import * as sources from "@groma/layer/sources";
import { expect, it } from "vitest";
import * as georefSource from "../../georef/src/index.js";
import * as layerSource from "../../layer/src/index.js";
import * as sourcesSource from "../../layer/src/sources/index.js";

it("tests run the sources of the libraries, not what was built of them", () => {
  expect(georef.GromaError).toBe(georefSource.GromaError);
  expect(layer.PointCloud).toBe(layerSource.PointCloud);
  expect(sources).toBe(sourcesSource);
});
