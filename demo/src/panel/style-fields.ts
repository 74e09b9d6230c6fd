import type { PointCloudLayer, PointCloudStyle, StyleParts } from "@groma/layer/cesium";
import { eyeDomeOf, GRADIENTS } from "@groma/layer/cesium";
import { i18n } from "../language/i18n.js";
import { attributeLabel } from "./attribute-words.js";
import type { FieldGroup } from "./drawing.js";
import type { CheckField, ChoiceField, RangeField, SliderField } from "./field.js";

type Layer = PointCloudLayer;
/** Parts of the style that are numbers, words, or on and off. */
type KeyOf<Kind> = {
  [Key in keyof PointCloudStyle]-?: PointCloudStyle[Key] extends Kind ? Key : never;
}[keyof PointCloudStyle];

const scalar = ({ style, cloud }: Layer) =>
  cloud.attributes.some(({ name, kind }) => name === style.color && (kind === "scalar" || kind === "flags"));
const spaced = ({ style }: Layer) => style.size !== "fixed";
const lit = ({ style }: Layer) => style.eyeDomeLighting !== false;

/** What the values of a style are called; viridis, cividis and turbo are names, the same in every language. */
const STYLE_WORDS: ReadonlyMap<string, string> = new Map([
  ["auto", i18n.t("auto")],
  ["fixed", i18n.t("fixed")],
  ["attenuated", i18n.t("attenuated")],
  ["adaptive", i18n.t("adaptive")],
  ["square", i18n.t("square")],
  ["disc", i18n.t("disc")],
  ["paraboloid", i18n.t("paraboloid")],
  ["spectral", i18n.t("spectral")],
  ["greyscale", i18n.t("greyscale")],
  ["terrain", i18n.t("terrain")],
]);

/** What the points show by their colour. */
export const COLOUR_BY: ChoiceField = {
  kind: "choice",
  id: "color",
  label: i18n.t("Colour by"),
  options: colourings,
  read: ({ style }) => style.color,
  // A range given for one attribute says nothing of another.
  write: (layer, color) => style(layer, { color, range: undefined }),
};

/** The switches for everything else in a style. */
export const STYLE_GROUPS: readonly FieldGroup[] = [
  {
    title: i18n.t("Colour"),
    fields: [
      {
        ...words("gradient", "gradient", i18n.t("Gradient"), ["auto", ...Object.keys(GRADIENTS)]),
        when: scalar,
        read: ({ style: { gradient } }) => (typeof gradient === "string" ? gradient : "auto"),
      },
      range(),
      number("gamma", i18n.t("Gamma"), [0.2, 5], 0.05),
      number("brightness", i18n.t("Brightness"), [-1, 1], 0.05),
      number("contrast", i18n.t("Contrast"), [-1, 1], 0.05),
      blendWith(),
      blendShare(),
      number("opacity", i18n.t("Opacity"), [0.05, 1], 0.05),
      onOff("dithering", i18n.t("Dithering")),
    ],
  },
  {
    title: i18n.t("Points"),
    fields: [
      words("size", "mode", i18n.t("Size"), ["fixed", "attenuated", "adaptive"]),
      { ...number("pointSize", i18n.t("Width"), [1, 10], 0.5, "px"), when: (layer) => !spaced(layer) },
      { ...number("spacingFactor", i18n.t("Width"), [0.5, 4], 0.1, i18n.t("spacings")), when: spaced },
      { ...number("minimumSize", i18n.t("At least"), [1, 10], 0.5, "px"), when: spaced },
      { ...number("maximumSize", i18n.t("At most"), [2, 64], 1, "px"), when: spaced },
      words("shape", "shape", i18n.t("Shape"), ["square", "disc", "paraboloid"]),
      { ...automatic("splats", i18n.t("Blended splats")) },
      {
        ...number("hardness", i18n.t("Hardness"), [0.5, 10], 0.5),
        when: ({ style }) => style.splats !== false,
      },
    ],
  },
  {
    title: i18n.t("Light"),
    fields: [
      {
        ...automatic("eyeDomeLighting", i18n.t("Eye-Dome Lighting")),
        read: ({ style: { eyeDomeLighting: now } }) => (typeof now === "object" ? "true" : String(now)),
      },
      { ...light("strength", i18n.t("Strength"), [0.1, 3], 0.1), when: lit },
      { ...light("radius", i18n.t("Radius"), [0.5, 5], 0.1, "px"), when: lit },
      {
        kind: "choice",
        id: "neighbours",
        label: i18n.t("Neighbours"),
        when: lit,
        options: () => ["4", "8"].map((value) => ({ value, label: value })),
        read: ({ style }) => String(eyeDomeOf(style).neighbours),
        write: (layer, value) => style(layer, { eyeDomeLighting: { neighbours: value === "8" ? 8 : 4 } }),
      },
    ],
  },
];

function style(layer: Layer, parts: StyleParts): void {
  layer.style = parts;
}

/** What a cloud can be coloured by. */
function colourings({ cloud }: Layer): { value: string; label: string }[] {
  const own = cloud.hasColour ? [{ value: "rgb", label: i18n.t("the scan's colours") }] : [];
  const columns = cloud.attributes
    .filter(({ kind, components }) => kind !== "color" && components === 1)
    .map((attribute) => ({ value: attribute.name, label: attributeLabel(attribute) }));
  return [...own, ...columns, { value: "levelOfDetail", label: i18n.t("level of detail") }];
}

function number(
  key: KeyOf<number>,
  label: string,
  [least, most]: readonly [number, number],
  step: number,
  unit?: string,
): SliderField {
  return {
    kind: "slider",
    id: key,
    label,
    least,
    most,
    step,
    ...(unit && { unit }),
    read: (layer) => layer.style[key],
    write: (layer, value) => style(layer, { [key]: value }),
  };
}

function words(
  key: "gradient" | "size" | "shape",
  id: string,
  label: string,
  values: readonly string[],
): ChoiceField {
  return {
    kind: "choice",
    id,
    label,
    options: () => values.map((value) => ({ value, label: STYLE_WORDS.get(value) ?? value })),
    read: (layer) => String(layer.style[key]),
    write: (layer, value) => style(layer, { [key]: value }),
  };
}

function onOff(key: "dithering", label: string): CheckField {
  return {
    kind: "check",
    id: key,
    label,
    read: (layer) => layer.style[key],
    write: (layer, value) => style(layer, { [key]: value }),
  };
}

/** On, off, or where the scene calls for it. */
function automatic(key: "splats" | "eyeDomeLighting", label: string): ChoiceField {
  return {
    kind: "choice",
    id: key,
    label,
    options: () => [
      { value: "false", label: i18n.t("off") },
      { value: "auto", label: i18n.t("where it shows") },
      { value: "true", label: i18n.t("on") },
    ],
    read: (layer) => String(layer.style[key]),
    write: (layer, value) => style(layer, { [key]: value === "auto" ? value : value === "true" }),
  };
}

function light(
  key: "strength" | "radius",
  label: string,
  [least, most]: readonly [number, number],
  step: number,
  unit?: string,
): SliderField {
  return {
    kind: "slider",
    id: key,
    label,
    least,
    most,
    step,
    ...(unit && { unit }),
    read: (layer) => eyeDomeOf(layer.style)[key],
    write: (layer, value) => style(layer, { eyeDomeLighting: { [key]: value } }),
  };
}

function range(): RangeField {
  return {
    kind: "range",
    id: "range",
    label: i18n.t("Values"),
    when: scalar,
    whole: ({ cloud, style: { color } }) => cloud.attributes.find(({ name }) => name === color)?.range,
    read: (layer) => layer.style.range,
    write: (layer, value) => style(layer, { range: value }),
  };
}

function blendWith(): ChoiceField {
  return {
    kind: "choice",
    id: "blend",
    label: i18n.t("Blended with"),
    options: (layer) => [{ value: "", label: i18n.t("nothing") }, ...colourings(layer)],
    read: (layer) => layer.style.blend?.color ?? "",
    write: (layer, color) => style(layer, { blend: color === "" ? undefined : { color } }),
  };
}

function blendShare(): SliderField {
  return {
    kind: "slider",
    id: "blend-share",
    label: i18n.t("Share blended in"),
    least: 0,
    most: 1,
    step: 0.05,
    when: (layer) => layer.style.blend !== undefined,
    read: (layer) => layer.style.blend?.share ?? 0.5,
    write(layer, share) {
      if (layer.style.blend) style(layer, { blend: { share } });
    },
  };
}
