import { StyleError } from "../errors/index.js";
import type { ClassTable, PointClass } from "./classes.js";
import type { StyledAttribute } from "./facts.js";
import { GRADIENTS } from "./gradients.js";
import { type ColourBy, EYE_DOME_LIGHTING, type PointCloudStyle } from "./style.js";

/** A style in parts: what is left out stays as it is. Single classes, and parts of them, may be given. */
export type StyleParts = Partial<Omit<PointCloudStyle, "classes">> & {
  readonly classes?: Readonly<Record<number, Partial<PointClass>>>;
};

/** Whose style it is. */
export interface StyledCloud {
  /** Attributes that the data set has; `color` stands for its own colours. */
  readonly attributes: readonly StyledAttribute[];
  /** Name of the file, for errors. */
  readonly file: string;
}

/**
 * A whole style of the parts given, the rest from `base`.
 * @throws StyleError STYLE_OPTION, STYLE_COLOR, STYLE_NO_RGB, STYLE_BLEND, STYLE_GRADIENT, STYLE_RANGE, STYLE_TONE,
 *   STYLE_CLASSES, STYLE_SIZE, STYLE_POINT_SIZE, STYLE_SHAPE, STYLE_QUALITY, STYLE_EYE_DOME, STYLE_OPACITY,
 *   STYLE_HIGHLIGHT, STYLE_DITHERING
 */
export function completeStyle(
  parts: StyleParts,
  base: PointCloudStyle,
  { attributes, file }: StyledCloud,
): PointCloudStyle {
  const fail = (code: string, cause: string, fix: string): never => {
    throw new StyleError({ code, file, cause, fix });
  };
  const check = (holds: boolean, code: string, cause: string, fix: string) => {
    if (!holds) fail(code, cause, fix);
  };
  const given = Object.fromEntries(
    Object.entries(parts).filter(
      ([name, value]) => value !== undefined || name === "range" || name === "blend",
    ),
  );
  for (const name of Object.keys(given)) {
    check(
      Object.hasOwn(base, name),
      "STYLE_OPTION",
      `a style has no "${name}"`,
      `Use some of ${Object.keys(base).join(", ")}`,
    );
  }
  const { classes, ...others } = given as StyleParts;
  const style: PointCloudStyle = {
    ...base,
    ...others,
    ...(classes && { classes: editClasses(base.classes, classes, fail) }),
  };
  checkColour(style.color, attributes, fail);
  if (style.blend) {
    checkColour(style.blend.color, attributes, fail);
    check(
      within(style.blend.share, 0, 1),
      "STYLE_BLEND",
      `${style.blend.share} is no share`,
      "Use a share from 0 to 1",
    );
  }
  checkGradient(style, fail);
  if (style.range) {
    const [least, greatest] = style.range;
    check(
      Number.isFinite(least) && Number.isFinite(greatest) && least < greatest,
      "STYLE_RANGE",
      `values cannot run from ${least} to ${greatest}`,
      "Give the least value first, then a greater one",
    );
  }
  check(
    within(style.gamma, 0.1, 10),
    "STYLE_TONE",
    `gamma cannot be ${style.gamma}`,
    "Use a number from 0.1 to 10",
  );
  for (const name of ["brightness", "contrast"] as const) {
    check(
      within(style[name], -1, 1),
      "STYLE_TONE",
      `${name} cannot be ${style[name]}`,
      "Use a number from -1 to 1",
    );
  }
  check(
    ["fixed", "attenuated", "adaptive"].includes(style.size),
    "STYLE_SIZE",
    `there is no size "${style.size}"`,
    "Use fixed, attenuated or adaptive",
  );
  check(
    within(style.pointSize, 1, 64),
    "STYLE_POINT_SIZE",
    `a point cannot be ${style.pointSize} pixels large`,
    "Use a size from 1 to 64",
  );
  check(
    within(style.spacingFactor, 0.1, 10),
    "STYLE_POINT_SIZE",
    `a point cannot be ${style.spacingFactor} spacings large`,
    "Use a factor from 0.1 to 10",
  );
  check(
    within(style.minimumSize, 0, 256) && within(style.maximumSize, Math.max(1, style.minimumSize), 256),
    "STYLE_POINT_SIZE",
    `sizes cannot run from ${style.minimumSize} to ${style.maximumSize} pixels`,
    "Use a minimumSize from 0 and a maximumSize that is at least as large, up to 256",
  );
  check(
    ["square", "disc", "paraboloid"].includes(style.shape),
    "STYLE_SHAPE",
    `there is no shape "${style.shape}"`,
    "Use square, disc or paraboloid",
  );
  check(
    onOff(style.highQuality),
    "STYLE_QUALITY",
    `highQuality cannot be ${String(style.highQuality)}`,
    "Use true, false or auto",
  );
  check(
    within(style.hardness, 0.5, 50),
    "STYLE_QUALITY",
    `hardness cannot be ${style.hardness}`,
    "Use a number from 0.5 to 50",
  );
  checkEyeDome(style.eyeDomeLighting, fail);
  const eyeDome = style.eyeDomeLighting;
  check(
    within(style.opacity, 0, 1),
    "STYLE_OPACITY",
    `opacity cannot be ${style.opacity}`,
    "Use a number from 0 to 1",
  );
  check(
    isColour(style.highlight?.color) && within(style.highlight.share, 0, 1),
    "STYLE_HIGHLIGHT",
    "highlight is not a colour and its share",
    "Give color as three numbers from 0 to 1, and a share from 0 to 1",
  );
  check(
    typeof style.dithering === "boolean",
    "STYLE_DITHERING",
    `dithering cannot be ${String(style.dithering)}`,
    "Use true or false",
  );
  return typeof eyeDome === "object"
    ? { ...style, eyeDomeLighting: { ...EYE_DOME_LIGHTING, ...eyeDome } }
    : style;
}

type Fail = (code: string, cause: string, fix: string) => never;

function checkColour(by: ColourBy, attributes: readonly StyledAttribute[], fail: Fail): void {
  if (by === "levelOfDetail") return;
  const names = attributes.map(({ name }) => name).filter((name) => name !== "color");
  const hasOwn = attributes.some(({ name }) => name === "color");
  if (by === "rgb") {
    if (!hasOwn) fail("STYLE_NO_RGB", "the scan has no colours of its own", `Use one of ${names.join(", ")}`);
  } else if (!names.includes(by)) {
    const known = [...(hasOwn ? ["rgb"] : []), ...names, "levelOfDetail"];
    fail("STYLE_COLOR", `there is no colouring by "${by}"`, `Use one of ${known.join(", ")}`);
  }
}

function checkGradient({ gradient }: PointCloudStyle, fail: Fail): void {
  if (gradient === "auto") return;
  if (typeof gradient === "string") {
    if (Object.hasOwn(GRADIENTS, gradient)) return;
    fail(
      "STYLE_GRADIENT",
      `there is no gradient "${gradient}"`,
      `Use auto, ${Object.keys(GRADIENTS).join(", ")} or stops`,
    );
  }
  const stops = Array.isArray(gradient) ? gradient : [];
  const rising = stops.every(
    ({ at }, index) => within(at, 0, 1) && (index === 0 || at >= stops[index - 1].at),
  );
  if (stops.length < 2 || !rising || !stops.every(({ color }) => isColour(color))) {
    fail(
      "STYLE_GRADIENT",
      "the stops given are no gradient",
      "Give two stops or more, { at, color }, with rising places from 0 to 1 and colours of three numbers from 0 to 1",
    );
  }
}

function checkEyeDome(eyeDome: PointCloudStyle["eyeDomeLighting"], fail: Fail): void {
  if (onOff(eyeDome)) return;
  const { strength, radius, neighbours } = { ...EYE_DOME_LIGHTING, ...(eyeDome as object) };
  if (
    typeof eyeDome === "object" &&
    within(strength, 0, 10) &&
    within(radius, 0.5, 20) &&
    (neighbours === 4 || neighbours === 8)
  )
    return;
  fail(
    "STYLE_EYE_DOME",
    "eyeDomeLighting is not what can be drawn",
    "Use true, false, auto or { strength: 0 to 10, radius: 0.5 to 20, neighbours: 4 or 8 }",
  );
}

function editClasses(
  base: ClassTable,
  edits: Readonly<Record<number, Partial<PointClass>>>,
  fail: Fail,
): ClassTable {
  const table: Record<number, PointClass> = { ...base };
  for (const [number, edit] of Object.entries(edits)) {
    const known = table[Number(number)];
    if (!known) fail("STYLE_CLASSES", `there is no class ${number}`, "Use numbers from 0 to 255");
    const edited = { ...known, ...edit };
    if (!isColour(edited.color) || typeof edited.show !== "boolean") {
      fail(
        "STYLE_CLASSES",
        `class ${number} has no colour that can be shown`,
        "Give color as three numbers from 0 to 1",
      );
    }
    table[Number(number)] = edited;
  }
  return table;
}

function onOff(value: unknown): boolean {
  return value === true || value === false || value === "auto";
}

function within(value: unknown, least: number, greatest: number): boolean {
  return typeof value === "number" && value >= least && value <= greatest;
}

function isColour(color: unknown): boolean {
  return Array.isArray(color) && color.length === 3 && color.every((part) => within(part, 0, 1));
}
