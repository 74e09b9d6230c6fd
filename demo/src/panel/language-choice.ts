import { keepLanguage } from "../language/choice.js";
import { i18n } from "../language/i18n.js";
import { LANGUAGES } from "../language/languages.js";
import { byId, optionElement } from "./elements.js";

/** Lets the reader choose the page's language: it is kept, and the page comes anew with what its address names. */
export function connectLanguage(): void {
  const select = byId("language", HTMLSelectElement);
  for (const { code, name } of LANGUAGES) {
    const option = optionElement({ value: code, label: name });
    option.lang = code;
    select.append(option);
  }
  select.value = i18n.locale;
  select.addEventListener("change", () => {
    if (keepLanguage(select.value)) location.reload();
    else select.value = i18n.locale;
  });
}
