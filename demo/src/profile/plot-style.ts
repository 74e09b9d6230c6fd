import type { GradientStop, PointCloudLayer } from "@groma/layer/cesium";
import { OFFSET, type PlotDrawing } from "@groma/layer/plot";
import type { Viewer } from "cesium";
import { byId } from "../panel/elements.js";

/** Left of the line blue, right of it orange, grey on the line. */
const SIDES: readonly GradientStop[] = [
  { at: 0, color: [0.96, 0.55, 0.2] },
  { at: 0.5, color: [0.68, 0.74, 0.8] },
  { at: 1, color: [0.24, 0.55, 0.96] },
];

/** The one colour of a second cloud. */
const SECOND = [0.35, 0.82, 0.9] as const;

/** How the points of the plot are drawn: as on globe and map, or by their side of the line. */
export class PlotStyle {
  readonly #choice = byId("profile-colour", HTMLSelectElement);
  /** Has the plot take over what the layer looks like by now: to be called in each frame of a view that shows it. */
  readonly tell: () => void;
  /** What the sides were drawn with last. */
  #sides: { readonly style: PointCloudLayer["style"]; readonly drawn: PointCloudLayer["style"] } | undefined;

  /** @param layer of the page @param follow takes over what the layer looks like by now */
  constructor(
    viewer: Viewer,
    layer: () => PointCloudLayer | undefined,
    follow: (drawing: PlotDrawing) => void,
  ) {
    this.tell = () => {
      const shown = layer();
      if (shown) follow(this.of(shown));
    };
    this.#choice.addEventListener("change", this.tell);
    // A layer does not tell of its style; what it draws, it draws in frames.
    viewer.scene.postRender.addEventListener(this.tell);
  }

  /** How a layer's points are drawn. */
  of({ style, filter }: PointCloudLayer): PlotDrawing {
    if (this.#choice.value !== "offset") return { style, filter };
    if (this.#sides?.style !== style) {
      const drawn = { ...style, color: OFFSET, blend: undefined, gradient: SIDES, range: undefined };
      this.#sides = { style, drawn };
    }
    return { style: this.#sides.drawn, filter };
  }

  /** How those of a second cloud beside it are: in one colour, so that both are told apart. */
  ofSecond({ style }: PointCloudLayer): PlotDrawing {
    const gradient = [0, 1].map((at) => ({ at, color: SECOND }));
    return { style: { ...style, color: "elevation", blend: undefined, gradient, range: undefined } };
  }
}
