// The import arrows of the house (docs/architecture.md): whatever is not drawn there is forbidden here.
const room = (path) => `^${path}(/|$)`;

/** A room of a package may import itself, the rooms named, and nothing else of the project. */
const onlyTo = (name, from, allowed) => ({
  name,
  severity: "error",
  from: { path: room(from) },
  // What npm puts into a package of its own is a library, not a room.
  to: {
    path: "^(georef|layer|converter|demo|tests)/(?!node_modules/)",
    pathNot: [from, ...allowed].map(room),
  },
});

/** A room of georef: what it stands on, of which each floor holds what the ones above may use. */
const georef = (name, allowed) =>
  onlyTo(
    `georef-${name}`,
    `georef/src/${name}`,
    allowed.map((other) => `georef/src/${other}`),
  );

/** A room of the command line, and the rooms of the library that every one of them may know. */
const command = (name, allowed) =>
  onlyTo(`cli-${name}`, `converter/cli/${name}`, [
    ...allowed.map((other) => `converter/cli/${other}`),
    ...["georef", "layer/(src|dist)"],
  ]);

const layer = (name, allowed) =>
  onlyTo(`layer-${name}`, `layer/src/${name}`, [...allowed.map((other) => `layer/src/${other}`), "georef"]);

/** What everybody may know of a source of points, whatever its format. */
const CONTRACT = "sources/contract";
/** What chooses the format. */
const OPEN_SOURCE = "sources/open-source\\.ts";

/** @type {import("dependency-cruiser").IConfiguration} */
module.exports = {
  forbidden: [
    { name: "no-circle", severity: "error", from: {}, to: { circular: true } },
    onlyTo("georef-stands-alone", "georef", []),
    georef("errors", []),
    georef("cartesian", ["errors"]),
    georef("approximation", []),
    georef("ellipsoid", []),
    georef("geodesic", ["ellipsoid", "errors"]),
    georef("crs", ["errors"]),
    georef("grid", ["errors"]),
    georef("transformation", ["grid", "approximation", "ellipsoid", "errors"]),
    georef("vertical", ["transformation", "grid", "crs", "errors"]),
    georef("engines", ["transformation", "crs", "ellipsoid", "errors"]),
    georef("similarity", ["engines", "crs", "ellipsoid", "cartesian", "errors"]),
    georef("georeference", [
      ...["engines", "vertical", "transformation", "grid", "approximation"],
      ...["crs", "ellipsoid", "cartesian", "errors"],
    ]),
    georef("record", ["engines", "vertical", "crs", "ellipsoid", "errors"]),
    onlyTo("layer-knows-georef-only", "layer", ["georef"]),
    onlyTo("demo-knows-libraries", "demo", ["layer", "georef"]),
    onlyTo("demo-language", "demo/src/language", []),
    onlyTo("demo-scene", "demo/src/scene", ["demo/src/language", "layer", "georef"]),
    onlyTo("demo-profile", "demo/src/profile", ["demo/src/language", "demo/src/panel", "layer", "georef"]),
    onlyTo("demo-indexing", "demo/src/indexing", ["georef"]),
    onlyTo("demo-clouds", "demo/src/clouds", ["demo/src/indexing", "layer", "georef"]),
    onlyTo("demo-panel", "demo/src/panel", [
      ...["demo/src/language", "demo/src/clouds", "demo/src/indexing", "demo/src/scene"],
      ...["layer", "georef"],
    ]),
    onlyTo("cli-knows-view-independent-rooms", "converter/cli", [
      "georef",
      "layer/(src|dist)/sources",
      "layer/(src|dist)/query",
      "layer/(src|dist)/tools",
      "layer/(src|dist)/export",
      "layer/(src|dist)/errors",
    ]),
    command("given", []),
    command("installed", []),
    command("core", ["installed"]),
    command("files", []),
    command("server", []),
    command("terminal", ["core", "given"]),
    command("proj/program", ["installed"]),
    command("proj/grids", ["proj/program"]),
    command("proj", ["installed"]),
    command("place", ["proj", "core", "given", "terminal"]),
    command("pdal", ["core", "terminal"]),
    command("inspect", ["files", "place", "core", "terminal"]),
    command("cut", ["files", "place", "core", "given", "terminal"]),
    command("conversion", ["pdal", "place", "core", "given", "terminal"]),
    command("commands", [
      ...[
        "conversion",
        "cut",
        "files",
        "inspect",
        "server",
        "place",
        "core",
        "given",
        "terminal",
        "installed",
      ],
    ]),
    layer("errors", []),
    layer("sources", ["errors"]),
    layer("sources/bytes", ["errors"]),
    layer("sources/las", [CONTRACT, "sources/bytes", "errors"]),
    layer("sources/copc", [CONTRACT, "sources/las", "sources/bytes", "errors"]),
    onlyTo("sources-contract-knows-no-format", `layer/src/${CONTRACT}`, [
      "layer/src/sources/bytes",
      "layer/src/errors",
      "georef",
    ]),
    layer("octree", [CONTRACT, "options", "errors"]),
    layer("laz", []),
    layer("workers", ["laz", CONTRACT, OPEN_SOURCE, "errors"]),
    layer("query", ["octree", "workers", "laz", CONTRACT, OPEN_SOURCE, "options", "errors"]),
    layer("cloud", ["query", "octree", "workers", CONTRACT, OPEN_SOURCE, "options", "errors"]),
    layer("options", ["errors"]),
    layer("clips", ["octree", "options", "errors"]),
    layer("effects", ["clips", "octree", "options", "errors"]),
    layer("effects/declaration", ["clips", "octree", "options", "errors"]),
    layer("effects/catalogue", ["effects/declaration", "clips", "octree", "options", "errors"]),
    layer("permalink", ["camera", "effects", "clips", "errors"]),
    layer("drawing", ["effects", "clips", "cloud", "octree", "workers", "options", "errors"]),
    layer("tools/measure", ["camera", "query", "options", "errors"]),
    layer("tools/draw", ["tools/measure", "options", "errors"]),
    layer("tools/profile", ["tools/exact", "query", "clips", "options", "errors"]),
    layer("tools/cut", ["tools/profile", "tools/sections", "tools/ellipsoid", "query", "clips"]),
    layer("tools/terrain", []),
    layer("tools/alignment", ["errors"]),
    layer("tools/ellipsoid", ["tools/profile", "tools/sections", "query"]),
    layer("tools/plot", ["tools/cut", "tools/terrain"]),
    layer("export", [
      "laz",
      "tools/area",
      "tools/sections",
      "tools/terrain",
      "clips",
      "effects",
      "query",
      "octree",
      "workers",
      CONTRACT,
      "options",
      "errors",
    ]),
    layer("export/compressor", ["laz", "errors"]),
    layer("tools/exact", []),
    layer("tools/sections", ["tools/profile", "query"]),
    layer("tools/area", ["tools/exact", "clips", "query"]),
    layer("camera", []),
    // A view hands out all that every application needs, beside its own.
    layer("cesium", [
      "camera",
      "tools",
      "drawing",
      "permalink",
      "effects",
      "clips",
      "cloud",
      "octree",
      "workers",
      "sources",
      "options",
      "errors",
      "every-view.ts",
    ]),
    layer("webgl2", ["drawing", "effects", "workers", "errors"]),
    layer("plot", [
      ...["tools", "webgl2", "drawing", "effects", "cloud", "query", "octree", "workers", "every-view.ts"],
    ]),
    layer("openlayers", [
      "webgl2",
      "tools",
      "drawing",
      "permalink",
      "effects",
      "clips",
      "cloud",
      "octree",
      "workers",
      "sources",
      "options",
      "errors",
      "every-view.ts",
    ]),
    layer("link", ["cesium", "openlayers", "camera", "tools", "options", "errors"]),
    layer("link/geometry", ["camera"]),
    layer("navigation", ["cesium", "camera", "options", "errors"]),
    layer("navigation/motions", ["camera"]),
    {
      name: "only-openlayers-rooms-know-openlayers",
      severity: "error",
      from: { path: "^(georef|layer|converter)/(src|cli)/", pathNot: room("layer/src/(openlayers|link)") },
      to: { path: "(^|node_modules/)ol/" },
    },
    {
      name: "only-cesium-rooms-know-cesium",
      severity: "error",
      from: {
        path: "^(georef|layer|converter)/(src|cli)/",
        pathNot: room("layer/src/(cesium|link|navigation)"),
      },
      to: { path: "(^|node_modules/)(@cesium|cesium)/" },
    },
    {
      name: "georef-has-no-io",
      severity: "error",
      from: { path: room("georef/src") },
      to: { dependencyTypes: ["core"] },
    },
  ],
  options: {
    doNotFollow: { path: "node_modules" },
    exclude: {
      path: [
        "^demo/dist/",
        "^layer/dist/standalone/",
        "/dist/.*\\.map$",
        "\\.(test|fixture)\\.ts$",
        "/target/",
      ],
    },
    tsPreCompilationDeps: true,
    tsConfig: { fileName: "tsconfig.base.json" },
    enhancedResolveOptions: { exportsFields: ["exports"], conditionNames: ["types", "import", "default"] },
  },
};
