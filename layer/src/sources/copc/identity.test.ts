import { expect, it } from "vitest";
import { BlobSource } from "../bytes/blob-source.js";
import { CopcSource } from "./copc-source.js";
import { type TinyCopc, tinyCopc } from "./tiny-copc.fixture.js";

const identity = async (options: TinyCopc, name = "a.copc.laz") => {
  const file = new File([tinyCopc(options) as Uint8Array<ArrayBuffer>], name);
  return (await CopcSource.open(new BlobSource(file))).identity;
};

it("tells files apart by what their points are, not by what they are called or where the points stand", async () => {
  const own = await identity({});
  expect(own).toMatch(/^10-[0-9a-f]{8}$/);
  expect(await identity({}, "b.copc.laz")).toBe(own);
  expect(await identity({ wkt: "LOCAL_CS[]" })).toBe(own);
  const others = await Promise.all([
    identity({ scale: 0.001 }),
    identity({ bounds: [0, 0, 0, 100, 100, 99] }),
    // One of its nodes is packed into other bytes: the points are others.
    identity({ page: [[0, 0, 0, 0, 0, 99, 10]] }),
    identity({ points: 11, page: [[0, 0, 0, 0, 0, 100, 10]] }),
  ]);
  expect(new Set([own, ...others]).size).toBe(5);
});
