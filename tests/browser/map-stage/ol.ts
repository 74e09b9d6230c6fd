/** The parts of OpenLayers that tests use. */
export { default as Feature } from "ol/Feature.js";
export { default as LineString } from "ol/geom/LineString.js";
export { fromExtent } from "ol/geom/Polygon.js";
export { default as Draw } from "ol/interaction/Draw.js";
export { default as Modify } from "ol/interaction/Modify.js";
export { default as TileLayer } from "ol/layer/Tile.js";
export { default as VectorLayer } from "ol/layer/Vector.js";
export { default as OlMap } from "ol/Map.js";
export { default as Projection } from "ol/proj/Projection.js";
export { register } from "ol/proj/proj4.js";
export { fromLonLat, get as getProjection } from "ol/proj.js";
export { default as VectorSource } from "ol/source/Vector.js";
export { default as XYZ } from "ol/source/XYZ.js";
export { default as Fill } from "ol/style/Fill.js";
export { default as Style } from "ol/style/Style.js";
export { default as View } from "ol/View.js";
export { default as proj4 } from "proj4";
