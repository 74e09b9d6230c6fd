import type { ByteSink, ExportOptions } from "@groma/layer/export";
import { i18n } from "../language/i18n.js";
import { setText } from "./elements.js";
import { saveFile } from "./save-file.js";

/** Where a file goes, and what its writer is to be told by. */
export type FillFile = (sink: ByteSink, options: ExportOptions) => Promise<unknown>;

/** The button that has files written: it says how far one is, and ends it when it is pressed again. */
export class ExportJob {
  readonly #button: HTMLButtonElement;
  readonly #status: HTMLElement;
  readonly #label: string;
  readonly #failed: (thrown: unknown) => void;
  #work: AbortController | undefined;

  /**
   * @param status tells how far it is
   * @param begin is called when a file is asked for
   */
  constructor(
    button: HTMLButtonElement,
    status: HTMLElement,
    begin: () => unknown,
    failed: (thrown: unknown) => void,
  ) {
    [this.#button, this.#status, this.#failed] = [button, status, failed];
    this.#label = button.textContent;
    button.addEventListener("click", () => (this.#work ? this.cancel() : begin()));
  }

  /** Ends what is being written, of which nothing is left. */
  cancel(): void {
    this.#work?.abort();
  }

  /** Has a file written where the reader chooses. */
  async save(name: string, fill: FillFile): Promise<void> {
    const work = new AbortController();
    const { signal } = work;
    this.#work = work;
    setText(this.#button, i18n.t("Cancel"));
    const onProgress = ({ read, total }: { read: number; total: number }) =>
      setText(
        this.#status,
        i18n.t("writing, {percent} %", { percent: total > 0 ? Math.floor((100 * read) / total) : 100 }),
      );
    try {
      const saved = await saveFile(name, (sink) => fill(sink, { signal, onProgress }));
      setText(this.#status, saved ? i18n.t("{name} is written.", { name }) : i18n.t("Nothing was written."));
    } catch (thrown) {
      setText(this.#status, i18n.t("Nothing was written."));
      if (!signal.aborted) this.#failed(thrown);
    } finally {
      this.#work = undefined;
      setText(this.#button, this.#label);
    }
  }
}
