import type { PointCloudLayer, PointFilter, ReturnKind } from "@groma/layer/cesium";
import { i18n } from "../language/i18n.js";
import type { FieldGroup } from "./drawing.js";
import type { RangeField } from "./field.js";

type Layer = PointCloudLayer;

const RETURNS: readonly { readonly value: ReturnKind | ""; readonly label: string }[] = [
  { value: "", label: i18n.t("all") },
  { value: "first", label: i18n.t("first") },
  { value: "last", label: i18n.t("last") },
  { value: "intermediate", label: i18n.t("in between") },
  { value: "single", label: i18n.t("the only one") },
];

/** The switches for how much is drawn, and which points. */
export const VIEW_GROUPS: readonly FieldGroup[] = [
  {
    title: i18n.t("Detail"),
    fields: [
      {
        kind: "slider",
        id: "budget",
        label: i18n.t("Points"),
        least: 10_000,
        most: 10_000_000,
        step: 0.05,
        logarithmic: true,
        read: ({ pointBudget }) => pointBudget,
        write: (layer, value) => {
          layer.pointBudget = value;
        },
      },
      {
        kind: "slider",
        id: "error",
        label: i18n.t("Spacing"),
        least: 0.5,
        most: 16,
        step: 0.5,
        unit: "px",
        read: ({ maximumScreenSpaceError }) => maximumScreenSpaceError,
        write: (layer, value) => {
          layer.maximumScreenSpaceError = value;
        },
      },
    ],
  },
  {
    title: i18n.t("Filter"),
    fields: [
      {
        kind: "choice",
        id: "returns",
        label: i18n.t("Returns"),
        options: () => RETURNS,
        read: ({ filter }) => filter?.returns?.[0] ?? "",
        write: (layer, value) => {
          const kind = RETURNS.find((each) => each.value === value)?.value;
          refilter(layer, { returns: kind ? [kind] : undefined });
        },
      },
      range("elevation", i18n.t("Elevation")),
      range("intensity", i18n.t("Intensity")),
      range("gpsTime", i18n.t("GPS time")),
    ],
  },
];

function range(name: "elevation" | "intensity" | "gpsTime", label: string): RangeField {
  const attribute = ({ cloud }: Layer) => cloud.attributes.find((each) => each.name === name);
  return {
    kind: "range",
    id: `filter-${name}`,
    label,
    when: (layer) => {
      const { range: [least, most] = [] } = attribute(layer) ?? {};
      const limited = layer.filter?.ranges?.[name] !== undefined;
      // What all points have alike tells none of them apart.
      return attribute(layer) !== undefined && (limited || least === undefined || least !== most);
    },
    whole: (layer) => attribute(layer)?.range,
    read: ({ filter }) => filter?.ranges?.[name],
    write(layer, value) {
      const { [name]: _, ...others } = layer.filter?.ranges ?? {};
      refilter(layer, { ranges: value ? { ...others, [name]: value } : others });
    },
  };
}

/** Changes parts of a layer's filter; a filter that lets all pass is none. */
function refilter(layer: Layer, parts: PointFilter): void {
  const filter = { ...layer.filter, ...parts };
  const open = !filter.classes && !filter.returns && Object.keys(filter.ranges ?? {}).length === 0;
  layer.filter = open ? undefined : filter;
}
