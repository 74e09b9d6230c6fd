import { printable } from "@groma/georef/printable";
import type { PointCloudLayer } from "@groma/layer/cesium";
import { i18n } from "../language/i18n.js";
import { crsWords, heightWords, liftWords } from "../panel/words.js";

/** Clouds that are named one by one. */
const MOST = 4;

/** What of a cloud a picture tells. */
export interface ShownCloud {
  readonly layer: Pick<PointCloudLayer, "cloud" | "heightOffset" | "statistics">;
  /** Coordinate system that the reader gave. */
  readonly crs: string | undefined;
}

/**
 * What a picture shows and where that comes from, a line each: the clouds with coordinate system and height reference,
 * then credits and date. Texts from files are made safe to show.
 */
export function sourceWords(clouds: readonly ShownCloud[], credits: readonly string[], date: Date): string[] {
  const named = clouds.slice(0, MOST).map(({ layer: { cloud, heightOffset }, crs: given }) => {
    const { name, crs, geoids, accuracy } = cloud;
    const system = crsWords(crs, { given: given !== undefined });
    const remark = accuracy.parts.find((part) => part.name === "height")?.note;
    const height = `${i18n.t("Height")}: ${heightWords(crs, { geoids, remark }).text}`;
    const said = [name, `${system.text} (${system.note})`, height, liftWords(heightOffset)];
    return said.filter(Boolean).map(isolated).join(" · ");
  });
  const further = clouds.length - named.length;
  const failed = clouds.reduce((sum, { layer }) => sum + layer.statistics.nodesFailed, 0);
  const day = date.toLocaleDateString(i18n.locale, { dateStyle: "long" });
  return [
    ...named,
    ...(further > 0
      ? [i18n.t("and {count, plural, one {# further cloud} other {# further clouds}}", { count: further })]
      : []),
    ...(failed > 0
      ? [
          i18n.t("This view is drawn without {count, plural, one {# node} other {# nodes}} that failed.", {
            count: failed,
          }),
        ]
      : []),
    [...new Set(credits), day, "Groma"].map(isolated).join(" · "),
  ];
}

/** A text whose direction of writing cannot change that of what stands around it. */
function isolated(text: string): string {
  return `\u2068${printable(text)}\u2069`;
}
