import { expect, it } from "vitest";
import { HeldKeys, type KeyDeed } from "./keys.js";

/** A canvas in a page, as far as keys know them. */
function page() {
  const document = new EventTarget();
  const canvas = Object.assign(new EventTarget(), {
    ownerDocument: document,
  }) as unknown as HTMLCanvasElement;
  const send = (type: "keydown" | "keyup", code: string, more: object = {}) => {
    const event = Object.assign(new Event(type, { cancelable: true }), { code, key: code, ...more });
    Object.defineProperty(event, "target", { value: canvas });
    document.dispatchEvent(event);
    return event.defaultPrevented;
  };
  const deeds: KeyDeed[] = [];
  const keys = new HeldKeys(canvas, () => "orbit", { began: () => {}, deed: (deed) => deeds.push(deed) });
  return { canvas, keys, deeds, send };
}

it("moves for as long as a key is held, and a tenth of a second at least", () => {
  const { keys, send } = page();
  expect(send("keydown", "KeyW")).toBe(true);
  expect(keys.take(0.25).ahead).toBe(0.25);
  send("keydown", "KeyW", { repeat: true });
  expect(keys.take(1).ahead).toBe(1);
  send("keyup", "KeyW");
  // Nothing is owed any more, and nothing is taken back.
  expect(keys.take(0.25).ahead).toBe(0);
  expect(keys.any).toBe(false);
  send("keydown", "KeyA");
  send("keyup", "KeyA");
  expect(keys.take(0.04).aside).toBe(-0.04);
  expect(keys.take(1).aside).toBeCloseTo(-0.06, 9);
  expect(keys.any).toBe(false);
});

it("turns with Shift, does what letters say once, and leaves chords and other keys alone", () => {
  const { keys, send, deeds } = page();
  send("keydown", "ArrowLeft", { shiftKey: true });
  expect(keys.take(1)).toMatchObject({ turn: 1, aside: 0, fast: true });
  keys.release();
  expect(send("keydown", "KeyN")).toBe(true);
  send("keydown", "KeyN", { repeat: true });
  expect(deeds).toEqual(["north"]);
  expect(send("keydown", "KeyS", { ctrlKey: true })).toBe(false);
  expect(send("keydown", "KeyZ")).toBe(false);
  expect(keys.any).toBe(false);
});

it("lets go of all keys when the canvas loses the keyboard", () => {
  const { canvas, keys, send } = page();
  send("keydown", "KeyW");
  canvas.dispatchEvent(new Event("blur"));
  expect(keys.any).toBe(false);
});
