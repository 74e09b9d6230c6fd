/**
 * What places points by a projection of proj4js. Most data sets of Groma carry a transformation that needs none, so it is
 * loaded where one is met that does: by the worker as `node.projections.js`, which `scripts/copy-assets.mjs` makes of this file.
 */
export { truthOf, truthOnMap } from "@groma/georef";
