import type { CameraView, Measurement, MeasureTool, Note } from "@groma/layer/tools";
import { i18n } from "../language/i18n.js";
import { byId, setText, textElement } from "./elements.js";
import { unfold } from "./fold.js";
import { iconButton } from "./icons.js";

interface Entry {
  readonly element: HTMLLIElement;
  readonly show: HTMLButtonElement;
  readonly edit: HTMLButtonElement;
  readonly text: HTMLParagraphElement;
  readonly form: HTMLFormElement;
  readonly title: HTMLInputElement;
  readonly note: HTMLTextAreaElement;
}

/** What is said at places: titles on globe and map, texts in the panel. Both are plain text. */
export class AnnotationList {
  readonly #tool: MeasureTool;
  readonly #fly: (annotation: Measurement) => void;
  readonly #camera: () => CameraView;
  readonly #place = byId("annotations", HTMLDetailsElement);
  readonly #list = byId("annotation-list", HTMLOListElement);
  readonly #add = byId("annotate", HTMLButtonElement);
  readonly #entries = new Map<string, Entry>();
  /** The one whose fields are shown. */
  #edited: string | undefined;

  /**
   * @param fly takes the views to an annotation
   * @param camera where the globe's camera stands
   */
  constructor(tool: MeasureTool, fly: (annotation: Measurement) => void, camera: () => CameraView) {
    [this.#tool, this.#fly, this.#camera] = [tool, fly, camera];
    this.#add.addEventListener("click", () => void this.#write());
  }

  /** Shows what the tool has. Entries of what stays are kept, and with them the reader's focus. */
  show(): void {
    const { measurements, edited, drawing } = this.#tool;
    this.#add.setAttribute("aria-pressed", String(drawing === "annotation"));
    const notes = measurements.filter(({ kind }) => kind === "annotation");
    const ids = new Set(notes.map(({ id }) => id));
    for (const id of this.#entries.keys()) if (!ids.has(id)) this.#entries.delete(id);
    const wanted = notes.map((one) => {
      const entry = this.#entries.get(one.id) ?? this.#entry(one.id);
      this.#entries.set(one.id, entry);
      this.#fill(entry, one, one.id === edited?.id);
      return entry.element;
    });
    const same =
      wanted.length === this.#list.children.length &&
      wanted.every((one, i) => one === this.#list.children[i]);
    if (!same) this.#list.replaceChildren(...wanted);
    this.#open(notes.some(({ id }) => id === edited?.id) ? edited?.id : undefined);
  }

  /** One that was begun to be changed, in the list or by its label, has the keyboard. */
  #open(id: string | undefined): void {
    if (id === this.#edited) return;
    this.#edited = id;
    const entry = id === undefined ? undefined : this.#entries.get(id);
    if (!entry) return;
    unfold(this.#place);
    entry.title.focus();
    entry.title.select();
  }

  /** Has the reader choose a place, and then write. */
  async #write(): Promise<void> {
    if (this.#tool.drawing === "annotation") return this.#tool.cancel();
    const made = await this.#tool.draw("annotation");
    if (!made) return;
    this.#tool.change(made.id, { note: { text: "", camera: this.#camera() } });
    this.#tool.edit(made.id);
  }

  #entry(id: string): Entry {
    const element = document.createElement("li");
    const head = document.createElement("div");
    head.className = "row";
    const show = textElement("button", "", "name");
    const edit = textElement("button", "");
    for (const button of [show, edit]) button.type = "button";
    const remove = iconButton("remove", i18n.t("Delete"));
    head.append(show, edit, remove);
    const text = document.createElement("p");
    text.className = "note";
    const form = document.createElement("form");
    const title = document.createElement("input");
    title.type = "text";
    const note = document.createElement("textarea");
    note.rows = 3;
    note.maxLength = 20_000;
    form.append(field(i18n.t("Title"), title), field(i18n.t("Text"), note));
    element.append(head, text, form);
    const doing = (work: (one: Measurement) => void) => () => {
      const one = this.#tool.measurements.find((each) => each.id === id);
      if (one) work(one);
    };
    show.addEventListener("click", doing(this.#fly));
    edit.addEventListener("click", () => this.#tool.edit(this.#tool.edited?.id === id ? undefined : id));
    remove.addEventListener("click", () => {
      this.#tool.remove(id);
      this.#add.focus();
    });
    const keep = doing((one) => {
      const said: Note = { ...one.note, text: note.value };
      this.#tool.change(id, { name: title.value.trim() || one.name, note: said });
    });
    form.addEventListener("change", keep);
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      keep();
      this.#tool.edit(undefined);
      edit.focus();
    });
    return { element, show, edit, text, form, title, note };
  }

  #fill(entry: Entry, { name, note }: Measurement, edited: boolean): void {
    setText(entry.show, name);
    setText(entry.edit, edited ? i18n.t("Done") : i18n.t("Edit"));
    entry.edit.setAttribute(
      "aria-label",
      edited ? i18n.t("Done with {name}", { name }) : i18n.t("Edit {name}", { name }),
    );
    const remove = entry.element.querySelector(".icon-button");
    for (const attribute of ["title", "aria-label"]) {
      remove?.setAttribute(attribute, i18n.t("Delete {name}", { name }));
    }
    entry.text.replaceChildren(...(note?.text ?? "").split("\n").map((line) => textElement("span", line)));
    entry.text.hidden = edited || !note?.text;
    entry.form.hidden = !edited;
    // What is being typed is the reader's.
    if (entry.title !== document.activeElement) entry.title.value = name;
    if (entry.note !== document.activeElement) entry.note.value = note?.text ?? "";
  }
}

function field(label: string, input: HTMLElement): HTMLLabelElement {
  const element = document.createElement("label");
  element.className = "stacked";
  element.append(textElement("span", label), input);
  return element;
}
