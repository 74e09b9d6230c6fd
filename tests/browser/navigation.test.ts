import { afterAll, afterEach, beforeAll, beforeEach, describe, expect } from "vitest";
import { data } from "../project.js";
import { pythonMissing } from "../python.js";
import { testsByKeyboard } from "./navigation/by-keyboard.js";
import { testsByMouse } from "./navigation/by-mouse.js";
import { testsByTouch } from "./navigation/by-touch.js";
import { testsOfLeaving } from "./navigation/leaving.js";
import { type NavigationStage, openNavigation } from "./navigation/stage.js";

const scan = data("autzen.laz");
const missing = scan.missing ?? pythonMissing;

describe.skipIf(missing)(`navigation${missing ? ` (skipped: ${missing})` : ""}`, () => {
  let stage: NavigationStage | undefined;
  beforeAll(async () => {
    stage = await openNavigation(scan.path);
  }, 240_000);
  afterAll(() => stage?.close());

  beforeEach(() => stage!.look(), 60_000);
  afterEach(() => expect(stage!.watch.errors).toEqual([]));

  const opened = () => stage!;
  testsByMouse(opened);
  testsByKeyboard(opened);
  testsByTouch(opened);
  // At last, the navigation is destroyed.
  testsOfLeaving(opened);
});
