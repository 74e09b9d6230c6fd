import type { Profile } from "@groma/layer/tools";
import { byId, optionElement } from "../panel/elements.js";
import { ExportJob } from "../panel/export-job.js";
import { type FileChoices, FORMATS, writeProfile } from "./profile-files.js";

/** What is exported: a profile as it is shown. */
export interface ExportedProfile
  extends Pick<FileChoices, "exaggeration" | "drawing" | "stations" | "ground"> {
  readonly profile: Profile;
  /** Of its line; undefined: it has none. */
  readonly name: string | undefined;
  /** Of its strip, metres: cross-sections are as thick. */
  readonly thickness: number;
}

/** Signs of a line's name that the names of its files bear: it may be a whole sentence. */
const NAME_LENGTH = 60;

/** Width of cross-sections, metres. */
const SECTION_WIDTH = 40;

/** The files of a profile: the choice of a format, and the button that has one written. */
export class ProfileExport {
  readonly #format = byId("profile-format", HTMLSelectElement);
  readonly #button = byId("profile-export", HTMLButtonElement);
  readonly #interval = byId("profile-interval", HTMLInputElement);
  readonly #job: ExportJob;
  readonly #shown: () => ExportedProfile | undefined;

  /**
   * @param status tells how far a file is
   * @param shown the profile that is there when one is asked for
   * @param failed hears why it could not be written
   */
  constructor(
    status: HTMLElement,
    shown: () => ExportedProfile | undefined,
    failed: (thrown: unknown) => void,
  ) {
    this.#shown = shown;
    this.#job = new ExportJob(this.#button, status, () => void this.#save(), failed);
    for (const [value, { label }] of FORMATS) this.#format.append(optionElement({ value, label }));
    const every = byId("profile-every", HTMLElement);
    this.#format.addEventListener("change", () => {
      every.hidden = this.#format.value !== "sections";
    });
  }

  /** Whether there is a profile. */
  set possible(possible: boolean) {
    this.#button.disabled = !possible;
  }

  /** Ends what is being written, of which nothing is left. */
  cancel(): void {
    this.#job.cancel();
  }

  async #save(): Promise<void> {
    const shown = this.#shown();
    const format = FORMATS.get(this.#format.value);
    if (!shown || !format) return;
    const { profile, name, thickness, ...choices } = shown;
    const stem = profile.origin.name.replace(/(\.copc)?\.laz$/i, "");
    const which = [...(name ?? "profile")].slice(0, NAME_LENGTH).join("");
    const sections = { interval: this.#interval.valueAsNumber || 10, width: SECTION_WIDTH, thickness };
    await this.#job.save(`${stem}-${which}.${format.ending}`, (sink, options) =>
      writeProfile(format, profile, sink, { ...options, ...choices, title: name ?? stem, sections }),
    );
  }
}
