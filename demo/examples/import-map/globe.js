import { PointCloudLayer } from "@groma/layer/cesium";
import { buildModuleUrl, CesiumWidget } from "cesium";

buildModuleUrl.setBaseUrl("/cesium/");
const widget = new CesiumWidget("globe", { baseLayer: false });
const url = new URLSearchParams(location.search).get("cloud");
const layer = await PointCloudLayer.fromUrl(url);
widget.scene.primitives.add(layer);
widget.camera.viewBoundingSphere(layer.boundingSphere);
layer.allNodesLoaded.addEventListener(() => {
  document.querySelector("output").textContent = `${layer.statistics.pointsDrawn} points`;
});
