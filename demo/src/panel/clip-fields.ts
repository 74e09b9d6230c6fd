import { i18n } from "../language/i18n.js";
import { CLIP_EDGES, type ClipBox, type ClipWish } from "../scene/clip-box.js";
import type { FieldGroup } from "./drawing.js";

const WISHES: readonly { readonly value: ClipWish; readonly label: string }[] = [
  { value: "off", label: i18n.t("everything") },
  { value: "inside", label: i18n.t("only what is inside") },
  { value: "outside", label: i18n.t("only what is outside") },
  { value: "highlight", label: i18n.t("everything, inside stands out") },
];

/** The switches of the box that cuts the cloud. */
export function clipGroup(box: ClipBox): FieldGroup {
  return {
    title: i18n.t("Clip box"),
    fields: [
      {
        kind: "choice",
        id: "clip",
        label: i18n.t("Show"),
        options: () => WISHES,
        read: () => box.wish,
        write: (_layer, value) => {
          box.wish = WISHES.find((wish) => wish.value === value)?.value ?? "off";
        },
      },
      {
        kind: "slider",
        id: "clip-edge",
        label: i18n.t("Edge"),
        least: CLIP_EDGES[0],
        most: CLIP_EDGES[1],
        step: 0.02,
        unit: "m",
        logarithmic: true,
        when: () => box.wish !== "off",
        read: () => box.edge,
        write: (_layer, value) => {
          box.edge = value;
        },
      },
    ],
  };
}
