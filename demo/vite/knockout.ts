import type { Plugin } from "vite";

const GLOBAL = /\(0,\s*eval\)\(["']this["']\)/g;

/** Knockout, which Cesium's viewer brings along, asks text as code for the global object: a strict page must not. */
export function knockoutWithoutEval(): Plugin {
  return {
    name: "groma-knockout-without-eval",
    transform(code, id) {
      if (!/\/knockout[^/]*\.js$/.test(id)) return null;
      return { code: code.replaceAll(GLOBAL, "globalThis"), map: null };
    },
  };
}
