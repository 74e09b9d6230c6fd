import { afterAll, beforeAll, describe } from "vitest";
import { data } from "../project.js";
import { testsByKeyboard } from "./measuring/by-keyboard.js";
import { testsByMouse } from "./measuring/by-mouse.js";
import { testsByTouch } from "./measuring/by-touch.js";
import { testsOfSaving } from "./measuring/saving.js";
import { testsOfSnapping } from "./measuring/snapping.js";
import { type MeasuringStage, openMeasuring } from "./measuring/stage.js";

const scan = data("vol_total.laz");

// One page for all: loading it and drawing the globe take most of the time.
describe.skipIf(scan.missing)(`measuring on globe and map${scan.missing ? ` (${scan.missing})` : ""}`, () => {
  let stage: MeasuringStage | undefined;
  beforeAll(async () => {
    stage = await openMeasuring(scan.path);
  }, 400_000);
  afterAll(() => stage?.close());

  const opened = () => stage!;
  testsByMouse(opened);
  testsOfSnapping(opened);
  testsByKeyboard(opened);
  testsByTouch(opened);
  // What the one before has drawn is saved.
  testsOfSaving(opened);
});
