import { afterEach, describe, expect, it, vi } from "vitest";
import { saveFile } from "./save-file.js";

/** A place on disk that fails as browsers do, and says whether what was begun was given up. */
function failing(at: "createWritable" | "write" | "close", name: string) {
  const given = { up: false };
  const fail = (step: string) => async () => {
    if (step === at) throw new DOMException("said the browser", name);
  };
  const stream = {
    write: fail("write"),
    close: fail("close"),
    abort: async () => {
      given.up = true;
    },
  };
  const createWritable = async () => {
    await fail("createWritable")();
    return stream;
  };
  vi.stubGlobal("window", { showSaveFilePicker: async () => ({ createWritable }) });
  return given;
}

const write = () => saveFile("cut.las", (sink) => sink.write(Uint8Array.of(1)));

describe("saveFile", () => {
  afterEach(() => vi.unstubAllGlobals());

  it.each(["write", "close"] as const)("says that there is no room where %s finds none", async (step) => {
    const given = failing(step, "QuotaExceededError");
    await expect(write()).rejects.toMatchObject({
      ...{ code: "PAGE_STORAGE", file: "cut.las", fix: "Free space, or save on another disk" },
    });
    expect(given.up).toBe(step === "write");
  });

  it("says why the browser may not write", async () => {
    failing("createWritable", "NoModificationAllowedError");
    await expect(write()).rejects.toMatchObject({ code: "PAGE_SAVE", file: "cut.las" });
  });

  it("hands on what filling the file fails with, and gives the file up", async () => {
    const given = failing("close", "never");
    const fault = new Error("a damaged chunk");
    await expect(saveFile("cut.las", () => Promise.reject(fault))).rejects.toBe(fault);
    expect(given.up).toBe(true);
  });

  it("offers a name that file systems take", async () => {
    const showSaveFilePicker = vi.fn(() => Promise.reject(new DOMException("", "AbortError")));
    vi.stubGlobal("window", { showSaveFilePicker });
    await saveFile('a/b\\c:"<d>|?*\u202e.png', () => Promise.resolve());
    expect(showSaveFilePicker).toHaveBeenCalledWith({ suggestedName: "a_b_c___d_____u{202e}.png" });
  });

  it("is false where no place is chosen", async () => {
    const showSaveFilePicker = () => Promise.reject(new DOMException("", "AbortError"));
    vi.stubGlobal("window", { showSaveFilePicker });
    await expect(write()).resolves.toBe(false);
  });
});
