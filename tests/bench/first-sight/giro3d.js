import CoordinateSystem from "@giro3d/giro3d/core/geographic/CoordinateSystem.js";
import Instance from "@giro3d/giro3d/core/Instance.js";
import PointCloud from "@giro3d/giro3d/entities/PointCloud.js";
import COPCSource from "@giro3d/giro3d/sources/COPCSource.js";
import { setLazPerfPath } from "@giro3d/giro3d/sources/las/config.js";
import { Vector3 } from "three";

setLazPerfPath("/laz-perf");
const plane = CoordinateSystem.register(
  "EPSG:2994",
  "+proj=lcc +lat_0=41.75 +lon_0=-120.5 +lat_1=43 +lat_2=45.5 +x_0=400000 +y_0=0 +ellps=GRS80 +units=ft +no_defs",
);
const instance = new Instance({ target: "view", crs: plane, backgroundColor: "black" });

window.look = async (address) => {
  const began = performance.now();
  const entity = new PointCloud({ source: new COPCSource({ url: address }) });
  entity.pointSize = 2;
  await instance.add(entity);
  entity.setActiveAttribute("Color");
  const box = entity.getBoundingBox();
  const [middle, size] = [box.getCenter(new Vector3()), box.getSize(new Vector3())];
  const { camera } = instance.view;
  camera.fov = (360 / Math.PI) * Math.atan(Math.tan(Math.PI / 6) * (innerHeight / innerWidth));
  const range = size.length() / 2 / Math.sin((camera.fov * Math.PI) / 360);
  camera.position.set(middle.x, middle.y - range * Math.SQRT1_2, middle.z + range * Math.SQRT1_2);
  camera.lookAt(middle);
  instance.notifyChange(camera);
  let first = 0;
  let complete = 0;
  // Between two answers it may have nothing to load for a moment.
  for (let still = 0; still < 30; ) {
    await new Promise(requestAnimationFrame);
    if (first === 0 && entity.displayedPointCount > 0) first = performance.now() - began;
    if (first === 0 || entity.loading) still = 0;
    else if (still++ === 0) complete = performance.now() - began;
  }
  return { first, complete, points: entity.displayedPointCount };
};

document.body.dataset.ready = "";
