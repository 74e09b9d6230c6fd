import type { PointCloudLayer } from "@groma/layer/cesium";
import { i18n } from "../language/i18n.js";
import { optionElement, textElement } from "./elements.js";
import type { CheckField, ChoiceField, Field, FieldView, RangeField, SliderField } from "./field.js";

/** Called when the reader changes a field; the change is carried out by what is handed over. */
export type Apply = (change: (layer: PointCloudLayer) => void) => void;

/** The elements of a field. */
export function viewOf(field: Field, apply: Apply): FieldView {
  const view = viewOfKind(field, apply);
  return {
    element: view.element,
    show(layer) {
      const there = field.when?.(layer) ?? true;
      view.element.hidden = !there;
      if (there) view.show(layer);
    },
  };
}

function viewOfKind(field: Field, apply: Apply): FieldView {
  switch (field.kind) {
    case "slider":
      return slider(field, apply);
    case "choice":
      return choice(field, apply);
    case "check":
      return check(field, apply);
    case "range":
      return range(field, apply);
  }
}

function slider(field: SliderField, apply: Apply): FieldView {
  const { id, least, most, step, unit = "", logarithmic = false } = field;
  const input = inputElement("range", id);
  const place = logarithmic ? Math.log10 : (value: number) => value;
  // Of thousands and millions nobody needs more than two digits.
  const value = () =>
    logarithmic ? Number((10 ** input.valueAsNumber).toPrecision(2)) : input.valueAsNumber;
  input.min = String(place(least));
  input.max = String(place(most));
  input.step = String(step);
  const output = document.createElement("output");
  output.htmlFor.add(id);
  input.addEventListener("input", () => apply((layer) => field.write(layer, value())));
  const element = labelled(field.label, input, "slider");
  element.append(output);
  return {
    element,
    show(layer) {
      const now = field.read(layer);
      // What came from elsewhere may lie beyond the slider's end.
      if (place(now) > Number(input.max)) input.max = String(place(now));
      if (input !== document.activeElement || value() !== now) input.value = String(place(now));
      const words = now.toLocaleString(i18n.locale, { maximumFractionDigits: 2 });
      output.value = unit ? `${words} ${unit}` : words;
    },
  };
}

function choice(field: ChoiceField, apply: Apply): FieldView {
  const select = document.createElement("select");
  select.id = field.id;
  select.addEventListener("change", () => apply((layer) => field.write(layer, select.value)));
  return {
    element: labelled(field.label, select, "field"),
    show(layer) {
      const options = field.options(layer).map(optionElement);
      // Another cloud may have the same values under other names, such as those of its units.
      const same =
        options.length === select.options.length &&
        options.every((option, at) => option.isEqualNode(select.options[at] ?? null));
      if (!same) select.replaceChildren(...options);
      select.value = field.read(layer);
    },
  };
}

function check(field: CheckField, apply: Apply): FieldView {
  const input = inputElement("checkbox", field.id);
  input.addEventListener("change", () => apply((layer) => field.write(layer, input.checked)));
  const element = document.createElement("label");
  element.className = "check";
  element.append(input, textElement("span", field.label));
  return {
    element,
    show(layer) {
      input.checked = field.read(layer);
    },
  };
}

function range(field: RangeField, apply: Apply): FieldView {
  const least = inputElement("number", field.id);
  const most = inputElement("number", `${field.id}-most`);
  least.step = "any";
  most.step = "any";
  least.setAttribute("aria-label", i18n.t("{label}, from", { label: field.label }));
  most.setAttribute("aria-label", i18n.t("{label}, to", { label: field.label }));
  const read = (input: HTMLInputElement, whole: number | undefined) =>
    input.value === "" ? whole : input.valueAsNumber;
  const change = () =>
    apply((layer) => {
      const whole = field.whole(layer);
      if (least.value === "" && most.value === "") return field.write(layer, undefined);
      const [from, to] = [read(least, whole?.[0]), read(most, whole?.[1])];
      // Half a range, as while it is being typed, changes nothing yet.
      if (from !== undefined && to !== undefined && from < to) field.write(layer, [from, to]);
    });
  least.addEventListener("change", change);
  most.addEventListener("change", change);
  const element = document.createElement("div");
  element.className = "range";
  element.setAttribute("role", "group");
  element.setAttribute("aria-label", field.label);
  element.append(textElement("span", field.label), least, most);
  return {
    element,
    show(layer) {
      const [now, whole] = [field.read(layer), field.whole(layer)];
      for (const [index, input] of [least, most].entries()) {
        input.placeholder = whole ? shortly(whole[index]!) : "";
        if (input !== document.activeElement) input.value = now ? shortly(now[index]!) : "";
      }
    },
  };
}

/** A number with as many digits as fit into the panel. */
function shortly(value: number): string {
  return String(Number(value.toPrecision(9)));
}

function inputElement(type: string, id: string): HTMLInputElement {
  const input = document.createElement("input");
  input.type = type;
  input.id = id;
  return input;
}

function labelled(text: string, input: HTMLElement, className: string): HTMLElement {
  const label = document.createElement("label");
  label.className = className;
  label.append(textElement("span", text), input);
  return label;
}
