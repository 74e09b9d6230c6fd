import "cesium/Build/Cesium/Widgets/widgets.css";
import "./style.css";
import "./map/map.css";
import "./panel/panel.css";
import "./panel/clouds.css";
import "./panel/fields.css";
import "./panel/measuring.css";
import "./profile/profile.css";
import { type PointCloud, SharedBudget } from "@groma/layer/cesium";
import { PointNavigation } from "@groma/layer/navigation";
import { Cartesian3, type Viewer } from "cesium";
import { cloudAddress, type PageOptions, readPageOptions } from "./address.js";
import { ChosenCloud } from "./chosen-cloud.js";
import { CloudOpener } from "./cloud-opener.js";
import { Clouds, type OpenCloud } from "./clouds/clouds.js";
import type { OpenOptions } from "./clouds/open-layer.js";
import { Beside } from "./map/beside.js";
import { addressed, nameIn, rememberClouds } from "./named-clouds.js";
import type { Groma } from "./page-global.js";
import { Chooser, crsRemedy } from "./panel/chooser.js";
import { Classes } from "./panel/classes.js";
import { clipGroup } from "./panel/clip-fields.js";
import { CloudList } from "./panel/cloud-list.js";
import { Controls } from "./panel/controls.js";
import { Drawing } from "./panel/drawing.js";
import { DrawingHint } from "./panel/drawing-hint.js";
import { byId } from "./panel/elements.js";
import { ExportPoints } from "./panel/export-points.js";
import { Failures, tellUncaught } from "./panel/failures.js";
import { connectFold, foldIfNarrow } from "./panel/fold.js";
import { Heights } from "./panel/heights.js";
import { connectLanguage } from "./panel/language-choice.js";
import { Ledger } from "./panel/ledger.js";
import { connectLook } from "./panel/look.js";
import { Measuring } from "./panel/measuring.js";
import { Message } from "./panel/message.js";
import { Moving } from "./panel/moving.js";
import { Picked } from "./panel/picked.js";
import { Progress } from "./panel/progress.js";
import { Share } from "./panel/share.js";
import { COLOUR_BY, STYLE_GROUPS } from "./panel/style-fields.js";
import { VIEW_GROUPS } from "./panel/view-fields.js";
import { ProfilePanel } from "./profile/profile-panel.js";
import type { Flight } from "./scene/camera.js";
import { ClipBox } from "./scene/clip-box.js";
import { drawChanges } from "./scene/on-demand.js";
import { Picking } from "./scene/picking.js";
import { steadyCamera } from "./scene/steady-camera.js";
import { Screenshot } from "./screenshot/screenshot.js";
import { Travel } from "./travel.js";
import { addBaseMap, addTerrain, createViewer, watchDrawing } from "./viewer.js";

const message = new Message();
tellUncaught(message);

/** The page once its globe stands. */
function start(viewer: Viewer): void {
  let options: PageOptions = { clouds: [], fly: true };
  const tell = (thrown: unknown) => message.show(thrown, crsRemedy(thrown));
  // Bytes are shared by all clouds; each has points of its own, as the panel says.
  const budget = new SharedBudget({ points: Number.POSITIVE_INFINITY });
  const clouds = new Clouds(viewer.scene.primitives, () => follow());
  const travel = new Travel(viewer, () => beside);
  const list = new CloudList({
    choose: (cloud) => {
      clouds.choose(cloud);
      followLayer();
      rememberClouds(clouds);
    },
    goTo: ({ layer }) => void travel.toCloud(layer, "oblique"),
    remove: (cloud) => {
      clouds.remove(cloud);
      followLayer();
      rememberClouds(clouds);
    },
  });
  const measuring = new Measuring(
    viewer,
    () => [...new Set([...(clouds.layer ? [clouds.layer] : []), ...clouds.layers])],
    (measurement) => travel.toMeasurement(measurement),
    tell,
    (text) => cloudAddress(text, location.href),
  );
  const failures = new Failures(message, () => {
    for (const layer of clouds.layers) layer.retryFailed();
    beside.retryFailed();
  });
  const ofMap = (thrown: unknown) => failures.ofMap(thrown);
  const beside = new Beside(viewer, ofMap, (view) => {
    measuring.tool.addView(view.measured);
    profile.addView(view.measured);
  });
  const progress = new Progress(() => beside.statistics);
  const controls = new Controls((aspect) => {
    if (clouds.layer) void travel.toCloud(clouds.layer, aspect);
  });
  const box = new ClipBox();
  const groups = [...STYLE_GROUPS, ...VIEW_GROUPS, clipGroup(box)];
  const drawing = new Drawing(COLOUR_BY, groups, tell);
  const classes = new Classes();
  const exporting = new ExportPoints(tell);
  const ledger = new Ledger(() => beside.ledger);
  const picked = new Picked();
  const profile = new ProfilePanel(viewer, () => clouds.layer, {
    // One tool at a time has the clicks.
    begins: () => measuring.tool.cancel(),
    picked: (cloud, node, record) => {
      readHit(cloud, node, record).catch(tell);
    },
    pointed: (place) => void beside.view?.then((view) => view.mark(place)),
    failed: tell,
  });
  ledger.further = () => profile.ledger;
  measuring.tool.onChange(() => {
    if (measuring.tool.drawing) profile.finish();
  });
  const tools = [measuring.tool, profile.lines.tool];
  const drawingHint = new DrawingHint(() => {
    // What has too few vertices is given up.
    for (const tool of tools) if (!tool.finish()) tool.cancel();
  });
  for (const tool of tools) tool.onChange(() => drawingHint.show(measuring.hint || profile.hint));
  steadyCamera(viewer.scene);
  drawChanges(
    viewer.scene,
    () => clouds.layers,
    () => ledger.frames,
  );
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
    tell,
  );
  byId("unpick", HTMLButtonElement).addEventListener("click", () => picking.clear());
  const share = new Share(viewer, {
    ...{ layer: () => clouds.layer, box, picking, beside, profiles: profile.lines },
    addressed: () => addressed(clouds).map(({ layer }) => layer),
    writeTo: (page) => nameIn(page, clouds),
  });
  new Screenshot({ viewer, clouds, beside, tool: measuring.tool }, tell);
  const heights = new Heights((vertical) => opener.reopen(vertical));
  const chosen = new ChosenCloud({
    ...{ heights, profile, progress, failed: tell },
    others: [controls, box, drawing, classes, exporting, ledger],
  });
  const chooser = new Chooser({
    files: (files, folders) => void opener.openChosen(files, folders),
    address: (text) => {
      try {
        void opener.openChosen([cloudAddress(text, location.href)]);
      } catch (thrown) {
        tell(thrown);
      }
    },
  });
  const opener = new CloudOpener({
    ...{ clouds, chooser, message, failures, progress, share, how, goTo },
    ended: () => {
      followLayer();
      list.show(clouds);
    },
    broughtBack: ({ layer }) => {
      controls.attach(layer);
      chooser.fold();
      foldIfNarrow();
      drawing.refresh();
      classes.attach(layer);
    },
  });
  connectFold();
  connectLook();
  connectLanguage(
    () => clouds.all.some(({ from }) => from instanceof File) || measuring.tool.measurements.length > 0,
  );
  watchDrawing(viewer, tell);
  addBaseMap(viewer).catch(tell);
  try {
    options = readPageOptions(location.href);
  } catch (thrown) {
    tell(thrown);
    chooser.alone = true;
    return;
  }
  travel.flies = options.fly;
  if (!options.fly) navigation.flight = 0;
  if (options.terrain) addTerrain(viewer, options.terrain).catch(tell);
  if (options.shown) beside.show(options.shown, options.linked);
  chooser.alone = options.clouds.length === 0;
  void opener.openNamed(options.clouds, options.color);

  /** Shows the record of a point that a tool leads to, as if it had been clicked. */
  async function readHit(cloud: PointCloud, node: string, record: number): Promise<void> {
    const { layer } = clouds;
    if (!layer) return;
    const found = await cloud.readPoint(node, { record });
    const [x, y, z] = cloud.place(...found.source);
    picking.show({ ...found, layer, cloud, position: new Cartesian3(x, y, z) });
  }

  /** How every cloud is opened, whether the page's address names it or the reader chooses it. */
  function how(): OpenOptions {
    const { budget: points = 1_000_000, size } = options;
    return {
      ...{ clips: box.clips, budget, pointBudget: points },
      // Closed surfaces where nothing else is asked for.
      style: size === undefined ? { size: "adaptive" } : { pointSize: size },
    };
  }

  /** Chooses a cloud and takes the camera there. */
  async function goTo(cloud: OpenCloud, by: Flight["way"]): Promise<void> {
    clouds.choose(cloud);
    followProgress();
    chooser.fold();
    foldIfNarrow();
    await travel.toCloud(cloud.layer, beside.alone ? "above" : "oblique", by);
  }

  function followProgress(): void {
    const { layer } = clouds;
    if (layer) progress.follow(layer);
    else progress.rest();
  }

  /** Has progress, and who drives the page from outside, follow the chosen cloud's layer. */
  function followLayer(): void {
    followProgress();
    groma.layer = clouds.layer;
  }

  /** Has the page speak of the chosen cloud. */
  function follow(): void {
    list.show(clouds);
    chooser.alone = clouds.all.length + clouds.openings.length === 0;
    // What another cloud brings is told when it is there.
    if (clouds.layer !== chosen.layer) {
      groma.layer = undefined;
      picking.clear();
      chosen.show(clouds.chosen);
    }
    measuring.attach();
    beside.attach(clouds.layers, chosen.layer);
    const others = clouds.layers.filter((layer) => layer !== chosen.layer);
    profile.comparison.offer(others.map(({ cloud }) => cloud));
  }
}

try {
  start(createViewer(byId("globe", HTMLDivElement)));
} catch (thrown) {
  for (const id of ["body", "fold"]) byId(id, HTMLElement).hidden = true;
  message.show(thrown);
}
