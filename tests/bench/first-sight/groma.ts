import { PointCloudLayer } from "@groma/layer/cesium";
import { CesiumWidget, HeadingPitchRange, type SkyBox } from "cesium";

const { scene, camera } = new CesiumWidget("view", {
  baseLayer: false,
  skyBox: false as unknown as SkyBox,
  skyAtmosphere: false,
  msaaSamples: 1,
});

window.look = async (address) => {
  const began = performance.now();
  const layer = await PointCloudLayer.fromUrl(address, { style: { pointSize: 2 } });
  scene.primitives.add(layer);
  const { radius } = layer.boundingSphere;
  camera.viewBoundingSphere(
    layer.boundingSphere,
    new HeadingPitchRange(0, -Math.PI / 4, radius / Math.sin(0.5 * verticalAngle())),
  );
  let first = 0;
  await new Promise<void>((done) => {
    const stop = scene.postRender.addEventListener(() => {
      if (first === 0 && layer.statistics.pointsDrawn > 0) first = performance.now() - began;
      if (!layer.settled) return;
      stop();
      done();
    });
  });
  return { first, complete: performance.now() - began, points: layer.statistics.pointsDrawn };
};

/** Of Cesium's 60° across. */
function verticalAngle(): number {
  return 2 * Math.atan(Math.tan(Math.PI / 6) * (window.innerHeight / window.innerWidth));
}

// Cesium is there once it has drawn.
const stop = scene.postRender.addEventListener(() => {
  stop();
  document.body.dataset.ready = "";
});
