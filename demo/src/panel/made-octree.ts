import type { Indexed } from "../indexing/index-file.js";
import { i18n } from "../language/i18n.js";
import { noteWords } from "../language/note-words.js";
import { textElement } from "./elements.js";
import { saveFile } from "./save-file.js";

/** Bytes that are written at once. */
const PIECE = 1 << 24;

/** Tells that a cloud was indexed in this page and what was found in it, and has the COPC file saved. */
export function madeOctree({ copc, warnings }: Indexed, failed: (thrown: unknown) => void): HTMLElement {
  const place = document.createElement("div");
  const save = textElement("button", i18n.t("Save as COPC…"));
  save.type = "button";
  save.addEventListener("click", () => {
    const name = `${copc.name.replace(/\.la[sz]$/i, "")}.copc.laz`;
    saveFile(name, async (sink) => {
      for (let at = 0; at < copc.size; at += PIECE)
        await sink.write(new Uint8Array(await copc.slice(at, at + PIECE).arrayBuffer()));
    }).catch(failed);
  });
  const found = warnings.map((warning) => {
    const { text, translated } = noteWords(warning);
    const note = textElement("small", text, "warning");
    if (!translated) note.lang = "en";
    return note;
  });
  place.append(textElement("small", i18n.t("Its octree was made in this page.")), ...found, save);
  return place;
}
