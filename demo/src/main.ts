import "cesium/Build/Cesium/Widgets/widgets.css";
import "./style.css";
import { CrsError } from "@groma/georef";
import { type PointCloud, type PointCloudLayer, SharedBudget, type SharedView } from "@groma/layer/cesium";
import { PointNavigation } from "@groma/layer/navigation";
import { Cartesian3, type Viewer } from "cesium";
import { cloudAddress, type NamedCloud, nameClouds, type PageOptions, readPageOptions } from "./address.js";
import { Clouds, type OpenCloud } from "./clouds/clouds.js";
import type { OpenOptions } from "./clouds/open-layer.js";
import { i18n } from "./language/i18n.js";
import { Beside } from "./map/beside.js";
import type { Groma } from "./page-global.js";
import { Chooser } from "./panel/chooser.js";
import { Classes } from "./panel/classes.js";
import { clipGroup } from "./panel/clip-fields.js";
import { CloudList } from "./panel/cloud-list.js";
import { Controls } from "./panel/controls.js";
import { Drawing } from "./panel/drawing.js";
import { byId } from "./panel/elements.js";
import { ExportPoints } from "./panel/export-points.js";
import { clearTitle, showFacts } from "./panel/facts.js";
import { tellFailures } from "./panel/failures.js";
import { connectFold, foldIfNarrow, freeArea } from "./panel/fold.js";
import { Heights } from "./panel/heights.js";
import { connectLanguage } from "./panel/language-choice.js";
import { Ledger } from "./panel/ledger.js";
import { connectLook } from "./panel/look.js";
import { madeOctree } from "./panel/made-octree.js";
import { Measuring } from "./panel/measuring.js";
import { Message, type ToldFault } from "./panel/message.js";
import { Moving } from "./panel/moving.js";
import { Picked } from "./panel/picked.js";
import { Progress } from "./panel/progress.js";
import { Share } from "./panel/share.js";
import { COLOUR_BY, STYLE_GROUPS } from "./panel/style-fields.js";
import { VIEW_GROUPS } from "./panel/view-fields.js";
import { ProfilePanel } from "./profile/profile-panel.js";
import { type Aspect, type Flight, goToCloud, goToPlaces, goToView } from "./scene/camera.js";
import { ClipBox } from "./scene/clip-box.js";
import { Picking } from "./scene/picking.js";
import { Screenshot } from "./screenshot/screenshot.js";
import { addBaseMap, addTerrain, createViewer, watchDrawing } from "./viewer.js";

const message = new Message();

/** The page once its globe stands. */
function start(viewer: Viewer): void {
  let options: PageOptions = { clouds: [], fly: true };
  /** The cloud that the panel was last told of. */
  let told: PointCloudLayer | undefined;
  // Bytes are shared by all clouds; each has points of its own, as the panel says.
  const budget = new SharedBudget({ points: Number.POSITIVE_INFINITY });
  const clouds = new Clouds(viewer.scene.primitives, () => follow());
  const list = new CloudList({
    choose: (cloud) => {
      clouds.choose(cloud);
      followProgress();
      groma.layer = clouds.layer;
      rememberClouds(clouds);
    },
    goTo: ({ layer }) => void goToCloud(viewer, layer, flight("oblique", way("fly"))),
    remove: (cloud) => {
      clouds.remove(cloud);
      followProgress();
      groma.layer = clouds.layer;
      rememberClouds(clouds);
    },
  });
  const measuring = new Measuring(
    viewer,
    () => [...new Set([...(clouds.layer ? [clouds.layer] : []), ...clouds.layers])],
    ({ vertices, note }) => {
      if (note?.camera) goToView(viewer, note.camera, way("fly"));
      else goToPlaces(viewer, vertices, way("fly"));
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
    if (clouds.layer) void goToCloud(viewer, clouds.layer, flight(aspect, way("fly")));
  });
  const box = new ClipBox();
  const groups = [...STYLE_GROUPS, ...VIEW_GROUPS, clipGroup(box)];
  const drawing = new Drawing(COLOUR_BY, groups, (thrown) => message.show(thrown));
  const classes = new Classes();
  const exporting = new ExportPoints((thrown) => message.show(thrown));
  const ledger = new Ledger(() => beside.ledger);
  const picked = new Picked();
  const profile = new ProfilePanel(viewer, () => clouds.layer, {
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
  const groma: Groma = {
    ...{ viewer, navigation, clouds, measure: measuring.tool, beside, profile, layer: undefined },
  };
  window.groma = groma;
  const picking = new Picking(
    viewer,
    // A click that places a vertex shows no record.
    () => (measuring.tool.drawing || profile.drawing ? [] : clouds.layers),
    (hit) => {
      picked.show(hit);
      if (hit) box.moveTo(hit.position);
    },
    (thrown) => message.show(thrown),
  );
  byId("unpick", HTMLButtonElement).addEventListener("click", () => picking.clear());
  const share = new Share(viewer, {
    ...{ layer: () => clouds.layer, box, picking, beside },
    addressed: () => addressed(clouds).map(({ layer }) => layer),
    writeTo: (page) => nameIn(page, clouds),
  });
  new Screenshot({ viewer, clouds, beside, tool: measuring.tool }, (thrown) => message.show(thrown));
  const heights = new Heights(reopen);
  const chooser = new Chooser({
    files: (files) => void chooseAll(files),
    address: (text) => {
      try {
        void chooseAll([cloudAddress(text, location.href)]);
      } catch (thrown) {
        message.show(thrown);
      }
    },
  });
  connectFold();
  connectLook();
  connectLanguage(
    () => clouds.all.some(({ from }) => from instanceof File) || measuring.tool.measurements.length > 0,
  );
  watchDrawing(viewer, (thrown) => message.show(thrown));
  addBaseMap(viewer).catch((thrown: unknown) => message.show(thrown));
  try {
    options = readPageOptions(location.href);
  } catch (thrown) {
    message.show(thrown);
    chooser.alone = true;
    return;
  }
  if (!options.fly) navigation.flight = 0;
  if (options.terrain) {
    addTerrain(viewer, options.terrain).catch((thrown: unknown) => message.show(thrown));
  }
  if (options.shown) beside.show(options.shown, options.linked);
  chooser.alone = options.clouds.length === 0;
  void openNamed(options.clouds);

  /** Shows the record of a point that a tool leads to, as if it had been clicked. */
  async function readHit(cloud: PointCloud, node: string, record: number): Promise<void> {
    const { layer } = clouds;
    if (!layer) return;
    const found = await cloud.readPoint(node, { record });
    const [x, y, z] = cloud.place(...found.source);
    picking.show({ ...found, layer, cloud, position: new Cartesian3(x, y, z) });
  }

  /** Opens the clouds that the page's address names; the view that it asks for is one of the first. */
  async function openNamed([first, ...others]: readonly NamedCloud[]): Promise<void> {
    if (!first) return;
    chooser.fill(new URL(location.href).searchParams.get("cloud") ?? "");
    const faults: ToldFault[] = [];
    const tell = (thrown: unknown) => {
      faults.push({ thrown });
      message.showAll(faults);
    };
    let view: SharedView | undefined;
    let unread: unknown;
    try {
      view = Share.wanted();
    } catch (thrown) {
      unread = thrown;
    }
    await bringBack(first, view, { faults, tell });
    // What cannot be brought back is told; the clouds are there all the same.
    if (unread !== undefined) tell(unread);
    for (const [at, cloud] of others.entries()) {
      const opened = await open(cloud.address, howNamed(cloud), "stay", faults);
      try {
        if (opened) Object.assign(opened.layer, view?.others?.[at]);
      } catch (thrown) {
        tell(thrown);
      }
    }
  }

  function howNamed({ crs, vertical, georef }: NamedCloud): OpenOptions {
    const { color } = options;
    const style = { ...lasting().style, ...(color && { color }) };
    return { ...lasting(), style, crs, vertical, transformation: georef };
  }

  /** Opens a cloud and shows it as the link to the page asks for. */
  async function bringBack(
    named: NamedCloud,
    view: SharedView | undefined,
    { faults, tell }: { readonly faults: ToldFault[]; readonly tell: (thrown: unknown) => void },
  ): Promise<void> {
    const opened = await open(named.address, howNamed(named), view?.camera ? "stay" : undefined, faults);
    if (!opened) return;
    try {
      if (view) await share.show(view);
    } catch (thrown) {
      tell(thrown);
    }
    chooser.fold();
    foldIfNarrow();
    drawing.refresh();
    classes.attach(opened.layer);
  }

  /** Opens what the reader chose, one after the other; the camera goes to the first. */
  async function chooseAll(chosen: readonly (string | File)[]): Promise<void> {
    message.clear();
    const faults: ToldFault[] = [];
    for (const [at, from] of chosen.entries()) {
      const how = { ...lasting(), crsIfMissing: chooser.crs };
      const opened = await open(from, how, at > 0 ? "stay" : undefined, faults);
      if (opened) rememberClouds(clouds);
    }
  }

  /** Opens the chosen cloud with another height reference, seen from where the camera stands. */
  async function reopen(vertical: string | undefined): Promise<boolean> {
    const { chosen } = clouds;
    if (!chosen) return false;
    message.clear();
    const { from, how, crs } = chosen;
    const { style, filter, heightOffset, show } = chosen.layer;
    const opened = await open(from, { ...how, style, filter, heightOffset, show, crs, vertical }, "stay");
    if (opened) rememberClouds(clouds);
    return opened !== undefined;
  }

  /** What holds for every cloud that is opened, not only for those in the page's address. */
  function lasting(): OpenOptions {
    const { budget: points = 1_000_000, size } = options;
    return {
      ...{ clips: box.clips, budget, pointBudget: points },
      // Closed surfaces where nothing else is asked for.
      style: size === undefined ? { size: "adaptive" } : { pointSize: size },
    };
  }

  function way(wanted: Flight["way"]): Flight["way"] {
    const still = !options.fly || beside.alone || matchMedia("(prefers-reduced-motion: reduce)").matches;
    return still ? "jump" : wanted;
  }

  function flight(aspect: Aspect, by: Flight["way"]): Flight {
    return { aspect, free: freeArea(), way: by };
  }

  /**
   * Opens a cloud beside the others.
   * @param wanted how the camera goes there; "stay": it does not, nor is the cloud chosen where another one is
   * @param faults of clouds that were opened with it, which are told with its own
   * @returns undefined where it cannot be opened, which is told, or was given up
   */
  async function open(
    from: string | File,
    how: OpenOptions,
    wanted: Flight["way"] | "stay" = clouds.layer ? "fly" : "descend",
    faults: ToldFault[] = [],
  ): Promise<OpenCloud | undefined> {
    const name = typeof from === "string" ? from : from.name;
    progress.opening(name);
    try {
      const opened = await clouds.open(from, how, {
        waits: (wait) => progress.openingWaits(name, wait),
        indexing: (done) => progress.indexing(name, done),
      });
      if (opened) {
        tellFailures(opened.layer, message);
        if (wanted !== "stay") await goTo(opened, wanted);
      }
      return opened;
    } catch (thrown) {
      const give = { label: i18n.t("Give it here"), run: () => chooser.askForCrs() };
      faults.push({ thrown, action: thrown instanceof CrsError ? give : undefined });
      message.showAll(faults);
      return undefined;
    } finally {
      followProgress();
      groma.layer = clouds.layer;
    }
  }

  /** Chooses a cloud and takes the camera there. */
  async function goTo(cloud: OpenCloud, by: Flight["way"]): Promise<void> {
    clouds.choose(cloud);
    followProgress();
    chooser.fold();
    foldIfNarrow();
    await goToCloud(viewer, cloud.layer, flight(beside.alone ? "above" : "oblique", way(by)));
  }

  function followProgress(): void {
    const { layer } = clouds;
    if (layer) progress.follow(layer);
    else progress.rest();
  }

  /** Has the page speak of the chosen cloud. */
  function follow(): void {
    list.show(clouds);
    const { chosen } = clouds;
    chooser.alone = clouds.all.length + clouds.openings.length === 0;
    // What another cloud brings is told when it is there.
    if (chosen?.layer !== told) {
      told = chosen?.layer;
      groma.layer = undefined;
      picking.clear();
      if (chosen) attach(chosen);
      else leave();
    }
    measuring.attach();
    beside.attach(clouds.layers, told);
    profile.comparison.offer(clouds.layers.filter((layer) => layer !== told).map(({ cloud }) => cloud));
  }

  function attach({ layer, how, crs, indexed }: OpenCloud): void {
    document.body.classList.add("has-cloud");
    const octree = indexed && madeOctree(indexed, (thrown) => message.show(thrown));
    showFacts(layer, { given: crs !== undefined, octree });
    heights.attach(layer.cloud, how.vertical);
    controls.attach(layer);
    box.attach(layer);
    drawing.attach(layer);
    classes.attach(layer);
    exporting.attach(layer);
    ledger.attach(layer);
    profile.open(layer);
  }

  /** No cloud is there any more. */
  function leave(): void {
    document.body.classList.remove("has-cloud");
    clearTitle();
    profile.leave();
    progress.rest();
  }
}

/** Keeps the page's address in step with what it shows, so that it can be reloaded and passed on: the chosen cloud first. */
function rememberClouds(clouds: Clouds): void {
  const page = new URL(location.href);
  nameIn(page, clouds);
  // A link to a view is one of the cloud that it was made for.
  page.hash = "";
  history.replaceState(null, "", page);
}

/** The clouds that an address can name, which a file of the reader's disk has none of: the chosen one first. */
function addressed({ all, chosen }: Clouds): (OpenCloud & { readonly from: string })[] {
  const order = [...(chosen ? [chosen] : []), ...all.filter((one) => one !== chosen)];
  return order.flatMap((cloud) => (typeof cloud.from === "string" ? [{ ...cloud, from: cloud.from }] : []));
}

function nameIn(page: URL, clouds: Clouds): void {
  const named = addressed(clouds).map(({ from, crs, how: { vertical, transformation } }): NamedCloud => {
    const georef = typeof transformation === "string" ? transformation : undefined;
    return { address: from, crs, vertical, georef };
  });
  nameClouds(page, named);
}

try {
  start(createViewer(byId("globe", HTMLDivElement)));
} catch (thrown) {
  for (const id of ["body", "fold"]) byId(id, HTMLElement).hidden = true;
  message.show(thrown);
}
