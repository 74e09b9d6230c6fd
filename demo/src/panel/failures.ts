import type { PointCloudLayer } from "@groma/layer/cesium";
import { i18n } from "../language/i18n.js";
import type { Message } from "./message.js";

/** Tells the first of the nodes that fail; how many did is told with the progress. */
export function tellFailures(layer: PointCloudLayer, message: Message): void {
  let told = false;
  layer.nodeFailed.addEventListener((_node, thrown) => {
    if (told) return;
    told = true;
    const again = () => {
      told = false;
      layer.retryFailed();
    };
    message.show(thrown, { label: i18n.t("Try again"), run: again });
  });
}

/** Tells what nobody caught: it is the page's fault, and the reader should not have to look into the console for it. */
export function tellUncaught(message: Message): void {
  // Without an error it is a remark of the browser's, on observers of sizes say.
  addEventListener("error", ({ error }) => error && message.show(error));
  addEventListener("unhandledrejection", ({ reason }) => message.show(reason));
}
