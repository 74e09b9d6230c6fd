import { byId } from "./elements.js";

/** Of the page's storage. */
const KEY = "groma-look";

/** Lets the reader choose between light and dark; the system's choice is the default. It is kept where the browser keeps anything. */
export function connectLook(): void {
  const select = byId("look", HTMLSelectElement);
  const apply = () => {
    document.documentElement.dataset.look = select.value;
  };
  select.value = stored();
  // What is stored may be of another version.
  if (select.selectedIndex < 0) select.value = "system";
  apply();
  select.addEventListener("change", () => {
    apply();
    try {
      localStorage.setItem(KEY, select.value);
    } catch {
      // It holds for this visit.
    }
  });
}

function stored(): string {
  try {
    return localStorage.getItem(KEY) ?? "system";
  } catch {
    return "system";
  }
}
