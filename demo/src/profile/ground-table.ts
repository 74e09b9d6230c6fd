import { gradesOf, type TerrainStation } from "@groma/layer/tools";
import { i18n } from "../language/i18n.js";
import { fixed } from "../language/numbers.js";
import { textElement } from "../panel/elements.js";

const COLUMNS = [
  i18n.t("chainage"),
  i18n.t("height"),
  i18n.t("least"),
  i18n.t("greatest"),
  i18n.t("mean"),
  i18n.t("deviation"),
  i18n.t("points"),
  i18n.t("grade to the next"),
];

/** The ground as a table: what there is to read where the picture cannot be seen. */
export function groundTable(stations: readonly TerrainStation[], caption: string): HTMLTableElement {
  const table = document.createElement("table");
  table.append(textElement("caption", caption));
  const head = table.createTHead().insertRow();
  for (const column of COLUMNS) {
    const cell = textElement("th", column);
    cell.scope = "col";
    head.append(cell);
  }
  const body = table.createTBody();
  const grades = gradesOf(stations);
  for (const [index, station] of stations.entries()) {
    const { chainage, height, least, greatest, mean, deviation, count } = station;
    const row = body.insertRow();
    const first = textElement("th", fixed(chainage, 2));
    first.scope = "row";
    row.append(first);
    const numbers = [height, least, greatest, mean, deviation].map((value) => metres(value));
    const grade = grades[index];
    const percent = grade === undefined || Number.isNaN(grade) ? "–" : `${fixed(100 * grade, 2)} %`;
    for (const text of [...numbers, count.toLocaleString(i18n.locale), percent])
      row.append(textElement("td", text));
  }
  return table;
}

/** A gap is told as one. */
function metres(value: number): string {
  return Number.isNaN(value) ? "–" : fixed(value, 3);
}
