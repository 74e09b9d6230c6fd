import { ecefToGeodetic } from "@groma/georef";
import { i18n } from "../language/i18n.js";
import { fixed, several } from "../language/numbers.js";
import type { Hit } from "../scene/picking.js";
import { attributeLabel } from "./attribute-words.js";
import { byId, textElement } from "./elements.js";
import { coordinateWords, degreeWords, valueWords } from "./record-words.js";

/** The record of the point that was clicked. */
export class Picked {
  readonly #place = byId("picked", HTMLElement);
  readonly #facts = byId("picked-facts", HTMLDListElement);

  show(hit: Hit | undefined): void {
    this.#place.hidden = hit === undefined;
    if (!hit) return;
    const { cloud, source, attributes, node, index, position } = hit;
    const info = new Map(cloud.attributes.map((attribute) => [attribute.name, attribute]));
    const geodetic = new Float64Array(3);
    ecefToGeodetic(position.x, position.y, position.z, geodetic);
    this.#facts.replaceChildren(
      ...row("x, y, z", coordinateWords(source, cloud.scale)),
      ...row(i18n.t("longitude, latitude"), several([degreeWords(geodetic[0]!), degreeWords(geodetic[1]!)])),
      ...row(i18n.t("above the ellipsoid"), `${fixed(geodetic[2]!, 3)} m`),
      ...Object.entries(attributes).flatMap(([name, value]) =>
        row(attributeLabel(info.get(name) ?? { name }), valueWords(value)),
      ),
      ...row(i18n.t("node, record"), `${node}, ${index}`),
    );
  }
}

function row(term: string, text: string): HTMLElement[] {
  return [textElement("dt", term), textElement("dd", text)];
}
