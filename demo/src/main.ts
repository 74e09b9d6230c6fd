import "cesium/Build/Cesium/Widgets/widgets.css";
import "./style.css";
import { CrsError } from "@groma/georef";
import type { PointCloud, PointCloudLayer, ServerWait, SharedView } from "@groma/layer/cesium";
import { PointNavigation } from "@groma/layer/navigation";
import { Cartesian3, type Viewer } from "cesium";
import { cloudAddress, type PageOptions, readPageOptions } from "./address.js";
import { i18n } from "./language/i18n.js";
import { Beside } from "./map/beside.js";
import { CloudSlot, type OpenOptions } from "./open.js";
import type { Groma } from "./page-global.js";
import { Chooser } from "./panel/chooser.js";
import { Classes } from "./panel/classes.js";
import { clipGroup } from "./panel/clip-fields.js";
import { Controls } from "./panel/controls.js";
import { Drawing } from "./panel/drawing.js";
import { byId } from "./panel/elements.js";
import { ExportPoints } from "./panel/export-points.js";
import { showFacts } from "./panel/facts.js";
import { connectFold, foldIfNarrow, freeArea } from "./panel/fold.js";
import { Heights } from "./panel/heights.js";
import { connectLanguage } from "./panel/language-choice.js";
import { Ledger } from "./panel/ledger.js";
import { Measuring } from "./panel/measuring.js";
import { Message } from "./panel/message.js";
import { Moving } from "./panel/moving.js";
import { PageError } from "./panel/page-error.js";
import { Picked } from "./panel/picked.js";
import { Progress } from "./panel/progress.js";
import { Share } from "./panel/share.js";
import { STYLE_GROUPS } from "./panel/style-fields.js";
import { VIEW_GROUPS } from "./panel/view-fields.js";
import { ProfilePanel } from "./profile/profile-panel.js";
import { type Flight, goToCloud, goToPlaces } from "./scene/camera.js";
import { ClipBox } from "./scene/clip-box.js";
import { Picking } from "./scene/picking.js";
import { addBaseMap, addTerrain, createViewer } from "./viewer.js";

const message = new Message();

/** What the cloud in the scene was opened from. */
interface Opened {
  readonly from: string | File;
  readonly name: string;
  readonly how: OpenOptions;
  /** Coordinate system that the reader gave, where it was used. */
  readonly crs: string | undefined;
}

/** The page once its globe stands. */
function start(viewer: Viewer): void {
  let options: PageOptions = { fly: true };
  let opened: Opened | undefined;
  const slot = new CloudSlot(viewer.scene.primitives);
  const measuring = new Measuring(
    viewer,
    () => slot.layer,
    ({ vertices }) => {
      goToPlaces(viewer, vertices, way("fly"));
      // A linked map comes along; moved for itself it would stop the globe's flight.
      if (!beside.linked) void beside.view?.then((view) => view.goTo(vertices));
    },
    (thrown) => message.show(thrown),
    (text) => cloudAddress(text, location.href),
  );
  const beside = new Beside(
    viewer,
    (thrown) => message.show(thrown),
    (view) => {
      measuring.tool.addView(view.measured);
      profile.addView(view.measured);
    },
  );
  const progress = new Progress(() => beside.statistics);
  const controls = new Controls((aspect) => {
    if (slot.layer) void goToCloud(viewer, slot.layer, { aspect, free: freeArea(), way: way("fly") });
  });
  const box = new ClipBox();
  const groups = [...STYLE_GROUPS, ...VIEW_GROUPS, clipGroup(box)];
  const drawing = new Drawing(groups, (thrown) => message.show(thrown));
  const classes = new Classes();
  const exporting = new ExportPoints((thrown) => message.show(thrown));
  const ledger = new Ledger(() => beside.ledger);
  const picked = new Picked();
  const profile = new ProfilePanel(viewer, () => slot.layer, {
    // One tool at a time has the clicks.
    begins: () => measuring.tool.cancel(),
    picked: (cloud, node, record) => {
      readHit(cloud, node, record).catch((thrown: unknown) => message.show(thrown));
    },
    pointed: (place) => void beside.view?.then((view) => view.mark(place)),
    failed: (thrown) => message.show(thrown),
  });
  ledger.further = () => profile.ledger;
  measuring.tool.onChange(() => {
    if (measuring.tool.drawing) profile.finish();
  });
  const navigation = new PointNavigation(viewer);
  new Moving(navigation, viewer.canvas, () => measuring.tool.drawing !== undefined || profile.drawing);
  const groma: Groma = { viewer, navigation, measure: measuring.tool, beside, profile, layer: undefined };
  window.groma = groma;
  const picking = new Picking(
    viewer,
    // A click that places a vertex shows no record.
    () => (measuring.tool.drawing || profile.drawing ? undefined : slot.layer),
    (hit) => {
      picked.show(hit);
      if (hit) box.moveTo(hit.position);
    },
    (thrown) => message.show(thrown),
  );
  byId("unpick", HTMLButtonElement).addEventListener("click", () => picking.clear());
  const share = new Share(viewer, {
    ...{ layer: () => slot.layer, box, picking, beside },
    hasAddress: () => typeof opened?.from === "string",
  });
  const heights = new Heights(reopen);
  const chooser = new Chooser({
    file: (file) => void choose(file, file.name),
    address: (text) => {
      try {
        const address = cloudAddress(text, location.href);
        void choose(address, address);
      } catch (thrown) {
        message.show(thrown);
      }
    },
  });
  connectFold();
  connectLanguage(() => opened?.from instanceof File || measuring.tool.measurements.length > 0);
  watchDrawing(viewer);
  addBaseMap(viewer).catch((thrown: unknown) => message.show(thrown));
  try {
    options = readPageOptions(location.href);
  } catch (thrown) {
    message.show(thrown);
    return;
  }
  if (!options.fly) navigation.flight = 0;
  if (options.terrain) {
    addTerrain(viewer, options.terrain).catch((thrown: unknown) => message.show(thrown));
  }
  if (options.shown) beside.show(options.shown, options.linked);
  openNamed();

  /** Shows the record of a point that a tool leads to, as if it had been clicked. */
  async function readHit(cloud: PointCloud, node: string, record: number): Promise<void> {
    const { layer } = slot;
    if (!layer) return;
    const found = await cloud.readPoint(node, { record });
    const [x, y, z] = cloud.place(...found.source);
    picking.show({ ...found, layer, cloud, position: new Cartesian3(x, y, z) });
  }

  /** Opens the cloud that the page's address names. */
  function openNamed(): void {
    const { cloud, color, crs, vertical, georef } = options;
    if (!cloud) return;
    chooser.fill(new URL(location.href).searchParams.get("cloud") ?? "");
    const style = { ...lasting().style, ...(color && { color }) };
    void bringBack(cloud, { ...lasting(), style, crs, vertical, transformation: georef });
  }

  /** Opens a cloud and shows it as the link to the page asks for. */
  async function bringBack(cloud: string, how: OpenOptions): Promise<void> {
    let view: SharedView | undefined;
    let failure: unknown;
    try {
      view = Share.wanted();
    } catch (thrown) {
      failure = thrown;
    }
    const layer = await open(cloud, cloud, how, view?.camera ? "stay" : undefined);
    if (!layer) return;
    try {
      if (view) await share.show(view);
    } catch (thrown) {
      failure = thrown;
    }
    chooser.fold();
    foldIfNarrow();
    drawing.refresh();
    classes.attach(layer);
    // What cannot be brought back is told; the cloud is there all the same.
    if (failure !== undefined) message.show(failure);
  }

  /** Opens the cloud that the reader chose. */
  async function choose(from: string | File, name: string): Promise<void> {
    const layer = await open(from, name, { ...lasting(), crsIfMissing: chooser.crs });
    if (layer && opened) rememberCloud(opened);
  }

  /** Opens the cloud that is there with another height reference, seen from where the camera stands. */
  async function reopen(vertical: string | undefined): Promise<boolean> {
    if (!opened || !slot.layer) return false;
    const { from, name, how, crs } = opened;
    const { style, filter, heightOffset, show } = slot.layer;
    const layer = await open(
      from,
      name,
      { ...how, style, filter, heightOffset, show, crs, vertical },
      "stay",
    );
    if (layer) rememberCloud(opened);
    return layer !== undefined;
  }

  /** What holds for every cloud that is opened, not only for the one in the page's address. */
  function lasting(): OpenOptions {
    const { budget, size } = options;
    return {
      clips: box.clips,
      ...(budget !== undefined && { pointBudget: budget }),
      // Closed surfaces where nothing else is asked for.
      style: size === undefined ? { size: "adaptive" } : { pointSize: size },
    };
  }

  function way(wanted: Flight["way"]): Flight["way"] {
    const still = !options.fly || beside.alone || matchMedia("(prefers-reduced-motion: reduce)").matches;
    return still ? "jump" : wanted;
  }

  /** @returns the layer, unless it cannot be opened, which is told, or another one was opened meanwhile */
  async function open(
    from: string | File,
    name: string,
    how: OpenOptions,
    wanted: Flight["way"] | "stay" = slot.layer ? "fly" : "descend",
  ): Promise<PointCloudLayer | undefined> {
    message.clear();
    progress.opening(name);
    try {
      const onWait = (wait: ServerWait | undefined) => progress.openingWaits(name, wait);
      const layer = await slot.open(from, how, onWait);
      if (layer) {
        const { crs, crsIfMissing, vertical } = how;
        // A system for clouds without one was taken where nothing else could have been given.
        const taken = vertical === undefined && layer.cloud.basis === "given" ? crsIfMissing : undefined;
        opened = { from, name, how, crs: crs ?? taken };
        await show(layer, opened, wanted);
      }
      return slot.layer === layer ? layer : undefined;
    } catch (thrown) {
      if (slot.layer) progress.follow(slot.layer);
      else progress.rest();
      const give = { label: i18n.t("Give it here"), run: () => chooser.askForCrs() };
      message.show(thrown, thrown instanceof CrsError ? give : undefined);
      return undefined;
    }
  }

  async function show(
    layer: PointCloudLayer,
    { how, crs }: Opened,
    wanted: Flight["way"] | "stay",
  ): Promise<void> {
    groma.layer = undefined;
    showFacts(layer, { given: crs !== undefined });
    heights.attach(layer.cloud, how.vertical);
    controls.attach(layer);
    box.attach(layer);
    drawing.attach(layer);
    classes.attach(layer);
    exporting.attach(layer);
    ledger.attach(layer);
    picking.clear();
    measuring.attach();
    beside.attach(layer);
    profile.open(layer);
    progress.follow(layer);
    tellFailures(layer);
    if (wanted !== "stay") {
      chooser.fold();
      foldIfNarrow();
      const aspect = beside.alone ? "above" : "oblique";
      await goToCloud(viewer, layer, { aspect, free: freeArea(), way: way(wanted) });
    }
    if (slot.layer === layer) groma.layer = layer;
  }
}

/** Tells the first of the nodes that fail; how many did is told with the progress. */
function tellFailures(layer: PointCloudLayer): void {
  let told = false;
  layer.nodeFailed.addEventListener((_node, thrown) => {
    if (told) return;
    told = true;
    const again = () => {
      told = false;
      layer.retryFailed();
    };
    message.show(thrown, { label: i18n.t("Try again"), run: again });
  });
}

/** Keeps the page's address in step with what it shows, so that it can be reloaded and passed on. */
function rememberCloud({ from, how: { vertical, transformation }, crs }: Opened): void {
  const page = new URL(location.href);
  if (transformation === undefined) page.searchParams.delete("georef");
  for (const name of ["cloud", "crs", "vertical"]) page.searchParams.delete(name);
  // A link to a view is one of the cloud that it was made for.
  page.hash = "";
  if (typeof from === "string") {
    const { origin, pathname, search } = new URL(from);
    page.searchParams.set("cloud", origin === location.origin ? pathname + search : from);
    if (crs) page.searchParams.set("crs", crs);
    if (vertical) page.searchParams.set("vertical", vertical);
  }
  history.replaceState(null, "", page);
}

/** Tells when the globe can no longer be drawn. */
function watchDrawing({ scene, canvas }: Viewer): void {
  const stopped = (cause: string) =>
    message.show(
      new PageError({
        code: "PAGE_DRAWING",
        file: i18n.t("the globe"),
        cause: i18n.t("drawing stopped: {cause}", { cause }),
        fix: i18n.t("Reload the page; if it happens again, draw fewer points with ?budget=300000"),
      }),
    );
  scene.renderError.addEventListener((_scene: unknown, thrown: unknown) =>
    stopped(thrown instanceof Error ? thrown.message : String(thrown)),
  );
  canvas.addEventListener("webglcontextlost", () => stopped(i18n.t("the browser lost the graphics context")));
}

try {
  start(createViewer(byId("globe", HTMLDivElement)));
} catch (thrown) {
  for (const id of ["body", "fold"]) byId(id, HTMLElement).hidden = true;
  message.show(thrown);
}
