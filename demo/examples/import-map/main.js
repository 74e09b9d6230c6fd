import { PointCloudLayer, PointCloudSource } from "@groma/layer/openlayers";
import OlMap from "ol/Map.js";
import View from "ol/View.js";

const url = new URLSearchParams(location.search).get("cloud");
const source = new PointCloudSource({ url });
const layer = new PointCloudLayer({ source, style: { color: "elevation" } });
const map = new OlMap({ target: "map", layers: [layer], view: new View({ center: [0, 0], zoom: 1 }) });
await source.opened();
map.getView().fit(source.getExtent(map.getView().getProjection()));
map.once("rendercomplete", () => {
  document.querySelector("output").textContent = `${layer.statistics.pointsDrawn} points`;
});
