import type { Vector } from "@groma/georef";
import {
  type Camera,
  Cartesian3,
  Matrix4,
  OrthographicFrustum,
  type PerspectiveFrustum,
  type PrimitiveCollection,
  type Scene,
} from "cesium";
import type { CameraPose, Lens, PictureHalves } from "../camera/index.js";
import { PointCloudLayer } from "./point-cloud-layer.js";

/** Where a camera of Cesium stands and how it is turned. */
export function poseOf({ positionWC, directionWC, upWC }: Camera): CameraPose {
  return { position: vectorOf(positionWC), direction: vectorOf(directionWC), up: vectorOf(upWC) };
}

/** Puts a camera somewhere at once; by its axes, since angles lose the roll of one that looks down. */
export function standCamera(camera: Camera, { position, direction, up }: CameraPose): void {
  camera.lookAtTransform(Matrix4.IDENTITY);
  Cartesian3.fromElements(...position, camera.position);
  Cartesian3.fromElements(...direction, camera.direction);
  Cartesian3.fromElements(...up, camera.up);
  Cartesian3.cross(camera.direction, camera.up, camera.right);
}

/** What the camera of a scene makes its picture with. */
export function lensOf({ camera, canvas }: Scene): Lens {
  return { width: canvas.clientWidth, height: canvas.clientHeight, halves: halvesOf(camera.frustum) };
}

/** The edges of the picture that a frustum makes; of one that is off its axis, as if it were not. */
function halvesOf(frustum: Camera["frustum"]): PictureHalves {
  if (frustum instanceof OrthographicFrustum) {
    const right = (frustum.width ?? 1) / 2;
    return { right, up: right / (frustum.aspectRatio ?? 1), parallel: true };
  }
  const { fovy = Math.PI / 3, aspectRatio = 1 } = frustum as PerspectiveFrustum;
  const up = Math.tan(fovy / 2);
  return { right: up * aspectRatio, up };
}

/** Layers of points among the primitives of a scene, at any depth of collections, that are shown. */
export function layersIn(collection: PrimitiveCollection): PointCloudLayer[] {
  const found: PointCloudLayer[] = [];
  for (let at = 0; at < collection.length; at++) {
    const primitive: unknown = collection.get(at);
    if (primitive instanceof PointCloudLayer) {
      if (primitive.show) found.push(primitive);
    } else if (isCollection(primitive)) found.push(...layersIn(primitive));
  }
  return found;
}

function isCollection(primitive: unknown): primitive is PrimitiveCollection {
  const { get, length } = primitive as Partial<PrimitiveCollection>;
  return typeof get === "function" && typeof length === "number";
}

/** A place or direction of Cesium's, same axes and units. */
export function vectorOf({ x, y, z }: Cartesian3): Vector {
  return [x, y, z];
}
