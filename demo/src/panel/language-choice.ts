import { keepLanguage } from "../language/choice.js";
import { i18n } from "../language/i18n.js";
import { LANGUAGES } from "../language/languages.js";
import { byId, optionElement, setText, textElement } from "./elements.js";

/**
 * Lets the reader choose the page's language: it is kept, and the page comes anew with what its address names.
 * @param losing whether there is something that would not come again; the reader is asked first then
 */
export function connectLanguage(losing: () => boolean): void {
  const select = byId("language", HTMLSelectElement);
  const note = byId("language-note", HTMLParagraphElement);
  for (const { code, name } of LANGUAGES) {
    const option = optionElement({ value: code, label: name });
    option.lang = code;
    select.append(option);
  }
  select.value = i18n.locale;
  const change = () => {
    if (keepLanguage(select.value)) return location.reload();
    select.value = i18n.locale;
    setText(
      note,
      i18n.t(
        "The browser keeps nothing for this page, its language neither: allow this site to store data or free some.",
      ),
    );
  };
  select.addEventListener("change", () => {
    setText(note, "");
    if (select.value === i18n.locale) return;
    if (!losing()) return change();
    setText(
      note,
      i18n.t(
        "The page will load anew: files have to be chosen again, and measurements that are not saved are lost.",
      ),
    );
    const load = textElement("button", i18n.t("Load anew"));
    load.type = "button";
    load.addEventListener("click", change);
    note.append(" ", load);
  });
}
