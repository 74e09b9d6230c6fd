import type { PointCloudLayer } from "@groma/layer/cesium";
import { byId, textElement } from "./elements.js";
import type { Field, FieldView } from "./field.js";
import { viewOf } from "./field-views.js";

/** Fields that belong together, under a heading that folds them. */
export interface FieldGroup {
  readonly title: string;
  readonly fields: readonly Field[];
}

/** Every way to draw a cloud, live: what is shown by colour first, the rest folded. */
export class Drawing {
  readonly #place = byId("drawing", HTMLFormElement);
  readonly #views: readonly FieldView[];
  #layer: PointCloudLayer | undefined;

  /**
   * @param lead stands before the groups
   * @param told hears of what a field could not be set to
   */
  constructor(lead: Field, groups: readonly FieldGroup[], told: (thrown: unknown) => void) {
    const apply = (change: (layer: PointCloudLayer) => void) => {
      const layer = this.#layer;
      if (!layer || layer.isDestroyed()) return;
      try {
        change(layer);
      } catch (thrown) {
        told(thrown);
      }
      this.refresh();
    };
    const first = viewOf(lead, apply);
    const views: FieldView[] = [first];
    this.#place.append(first.element);
    for (const { title, fields } of groups) {
      const details = document.createElement("details");
      details.className = "group";
      details.append(textElement("summary", title));
      for (const field of fields) {
        const view = viewOf(field, apply);
        views.push(view);
        details.append(view.element);
      }
      this.#place.append(details);
    }
    this.#views = views;
    this.#place.addEventListener("submit", (event) => event.preventDefault());
  }

  /** Shows how a layer is drawn, and changes that from now on. */
  attach(layer: PointCloudLayer): void {
    this.#layer = layer;
    this.refresh();
  }

  /** Shows anew how the layer is drawn. */
  refresh(): void {
    const layer = this.#layer;
    if (layer) for (const view of this.#views) view.show(layer);
  }
}
