import { describe, expect, it } from "vitest";
import { choose } from "./candidate.js";
import type { Operation } from "./operation.js";
import { findProj } from "./program/find.js";

const proj = await findProj();
const absent = proj ? "" : " (skipped: PROJ is not installed)";

const DOMAIN = { minX: 500_000, minY: 5_500_000, minZ: 0, maxX: 501_000, maxY: 5_501_000, maxZ: 10 };
const UTM = "+proj=pipeline +step +inv +proj=utm +zone=33 +ellps=WGS84";
const CART = "+step +proj=cart +ellps=WGS84";

function operation(name: string, pipeline: string, more: Partial<Operation> = {}): Operation {
  return { name, accuracy: 1, area: "World", ballpark: false, missingGrids: [], pipeline, ...more };
}

const good = operation("good", `${UTM} ${CART}`);
const unsupported = operation("unsupported", `${UTM} +step +proj=defmodel +model=x.json ${CART}`, {
  accuracy: 0.01,
});
const lacking = operation("lacking", `${UTM} +step +proj=hgridshift +grids=x.tif ${CART}`, {
  missingGrids: ["x.tif"],
});
const unreadable = operation("broken", `${UTM} +step +proj=vgridshift +grids=not-there.gtx ${CART}`);
const ballpark = operation("ballpark", `${UTM} ${CART}`, { ballpark: true, accuracy: null });

describe.skipIf(!proj)(`of the operations that PROJ proposes${absent}`, () => {
  const chosen = (...operations: Operation[]) => choose(proj!, operations, DOMAIN, 1);

  it("the first is taken that can be followed, and the others are named", async () => {
    const { choice, passedOver } = await chosen(ballpark, lacking, unsupported, unreadable, good);
    expect(choice?.candidate.operation.name).toBe("good");
    expect(passedOver.map(({ operation: name, accuracy }) => [name, accuracy])).toEqual([
      ["unsupported", 0.01],
      ["broken", 1],
    ]);
    expect(passedOver[0].why).toContain("defmodel");
  });

  it("a ballpark is taken only when nothing better is known", async () => {
    expect((await chosen(ballpark, lacking)).choice?.candidate.operation.name).toBe("ballpark");
    const blocked = await chosen(ballpark, unsupported);
    expect(blocked.choice).toBeUndefined();
    expect(blocked.blocked).toMatchObject({ code: "CRS_OPERATION_UNSUPPORTED" });
    expect((await chosen(unreadable, ballpark)).blocked).toMatchObject({ code: "PROJ_FAILED" });
  });

  it("one whose optional grids are not there shifts nothing: PROJ's null grid says so, any other is a ballpark", async () => {
    const shifted = (grids: string, kind = "hgridshift") =>
      operation(grids, `${UTM} +step +proj=${kind} +grids=${grids} ${CART}`);
    const meant = await chosen(ballpark, shifted("@not-there.gsb,null"));
    expect(meant.choice).toMatchObject({
      candidate: { operation: { name: "@not-there.gsb,null" } },
      leftOut: [],
    });
    expect([...meant.choice!.windows[0].values]).toEqual([0, 0, 0, 0, 0, 0, 0, 0]);
    const without = shifted("@not-there.gtx", "vgridshift");
    expect((await chosen(without, good)).choice?.candidate.operation.name).toBe("good");
    const { choice, passedOver } = await chosen(without, unreadable);
    expect(choice).toBeUndefined();
    expect(passedOver).toHaveLength(1);
    expect((await chosen(without, ballpark)).choice?.leftOut).toEqual([
      { kind: "vertical", grids: ["not-there.gtx"] },
    ]);
  });

  it("none is taken from nothing, or from one that PROJ cannot write down", async () => {
    expect((await chosen()).choice).toBeUndefined();
    const { pipeline: _, ...silent } = good;
    const { choice, passedOver, blocked: why } = await chosen(silent);
    expect([choice, why, passedOver.length]).toEqual([undefined, undefined, 1]);
    expect((await chosen(silent, ballpark)).choice?.candidate.operation.name).toBe("ballpark");
  });
});
