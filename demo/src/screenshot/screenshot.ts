import type { MeasureTool } from "@groma/layer/tools";
import type { Viewer } from "cesium";
import type { Clouds } from "../clouds/clouds.js";
import { i18n } from "../language/i18n.js";
import { byId, setText } from "../panel/elements.js";
import { ExportJob } from "../panel/export-job.js";
import { shootGlobe } from "./globe-shot.js";
import { scaleBar } from "./scale-bar.js";
import { drawSheet, type SheetView } from "./sheet.js";
import { sourceWords } from "./source-words.js";
import type { ViewShot } from "./view-shot.js";

/** CSS pixels that a scale bar takes at most. */
const LONGEST = 200;

/** The map beside or in place of the globe. */
interface PicturedMap {
  /** Whether it is in place of the globe. */
  readonly alone: boolean;
  /** Its picture, and what it says of its sources; undefined where it is not shown. */
  shoot(
    signal: AbortSignal,
  ): Promise<{ readonly shot: ViewShot; readonly credits: readonly string[] } | undefined>;
}

/** What of the page a picture is made of. */
export interface Pictured {
  readonly viewer: Viewer;
  readonly clouds: Clouds;
  readonly beside: PicturedMap;
  readonly tool: MeasureTool;
}

/** The button that saves what globe and map show as a PNG, with scale, north and sources. */
export class Screenshot {
  readonly #page: Pictured;
  readonly #job: ExportJob;
  readonly #status = byId("screenshot-status", HTMLElement);

  constructor(page: Pictured, failed: (thrown: unknown) => void) {
    this.#page = page;
    const button = byId("screenshot", HTMLButtonElement);
    this.#job = new ExportJob(button, this.#status, () => void this.#save(), failed);
  }

  async #save(): Promise<void> {
    const { chosen } = this.#page.clouds;
    if (!chosen) return;
    const day = new Date();
    const name = `${chosen.layer.cloud.name.replace(/(\.copc)?\.laz$/i, "")}-${isoDay(day)}.png`;
    await this.#job.save(name, async (sink, { signal }) => {
      setText(this.#status, i18n.t("waiting until this view is complete"));
      const picture = await this.#draw(day, signal);
      await sink.write(new Uint8Array(await (await pngOf(picture)).arrayBuffer()));
    });
  }

  async #draw(day: Date, signal: AbortSignal | undefined): Promise<HTMLCanvasElement> {
    const { viewer, clouds, beside } = this.#page;
    const stop = signal ?? new AbortController().signal;
    const layers = () => clouds.layers.filter(({ show }) => show);
    const complete = () => clouds.openings.length === 0;
    const globe = beside.alone ? undefined : await shootGlobe(viewer, layers, complete, stop);
    const map = await beside.shoot(stop);
    const shots = [globe, map?.shot].filter((shot) => shot !== undefined);
    const credits = [...(globe ? globeCredits(viewer) : []), ...(map?.credits ?? [])];
    const shown = clouds.all.filter(({ layer }) => layer.show);
    const size = { width: innerWidth, height: innerHeight };
    const words = sourceWords(shown, credits, day);
    return drawSheet(
      shots.map((shot) => this.#besides(shot)),
      size,
      devicePixelRatio,
      words,
    );
  }

  #besides(shot: ViewShot): SheetView {
    const { ground, perspective } = shot;
    if (!ground) return { shot, bar: undefined, remark: i18n.t("no ground in the middle of the view") };
    const { length } = this.#page.tool.units;
    const bar = scaleBar(ground.metresPerPixel, LONGEST, { length, locale: i18n.locale });
    return {
      shot,
      bar,
      remark: perspective ? i18n.t("across, in the middle of the view") : i18n.t("in the middle of the map"),
    };
  }
}

/** What the globe says of its sources, as text. */
function globeCredits({ imageryLayers, terrainProvider }: Viewer): string[] {
  const shown = Array.from({ length: imageryLayers.length }, (_, at) => imageryLayers.get(at));
  const credits = [
    ...shown.map(({ show, imageryProvider }) => (show ? imageryProvider?.credit : undefined)),
    terrainProvider.credit,
  ];
  return credits.flatMap((credit) => credit?.element.textContent?.trim() || []);
}

function isoDay(day: Date): string {
  return [day.getFullYear(), day.getMonth() + 1, day.getDate()]
    .map((part) => String(part).padStart(2, "0"))
    .join("-");
}

function pngOf(canvas: HTMLCanvasElement): Promise<Blob> {
  return new Promise((resolve, reject) => {
    canvas.toBlob((blob) => {
      if (blob) resolve(blob);
      else reject(new Error(i18n.t("the browser cannot make a picture of this size")));
    }, "image/png");
  });
}
