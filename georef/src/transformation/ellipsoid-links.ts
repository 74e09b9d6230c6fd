import { ecefToGeodetic } from "../ellipsoid/ecef-to-geodetic.js";
import { type Ellipsoid, ellipsoid } from "../ellipsoid/ellipsoid.js";
import { geodeticToEcef } from "../ellipsoid/geodetic-to-ecef.js";
import { type Link, premultiply } from "./link.js";
import type { DatumShiftStep, GeocentricStep, HeightStep } from "./step.js";

/** Source units of z to metres. */
export function heightLink({ metresPerUnit }: HeightStep): Link {
  return {
    apply(state) {
      state[2] *= metresPerUnit;
    },
    differentiate(state, jacobian) {
      state[2] *= metresPerUnit;
      for (let column = 6; column < 9; column++) jacobian[column] *= metresPerUnit;
    },
  };
}

/** Geodetic to ECEF. */
export function geocentricLink(step: GeocentricStep): Link {
  const shape = ellipsoid(step.ellipsoid.a, step.ellipsoid.f);
  const own = new Float64Array(9);
  return {
    apply(state) {
      geodeticToEcef(state[0], state[1], state[2], state, 0, shape);
    },
    differentiate(state, jacobian) {
      geodeticJacobian(state, shape, own);
      premultiply(own, jacobian);
      geodeticToEcef(state[0], state[1], state[2], state, 0, shape);
    },
  };
}

/** Helmert shift from the geodetic coordinates of one ellipsoid to those of another. */
export function datumShiftLink({ from, to, translation, matrix, keepHeight }: DatumShiftStep): Link {
  const source = ellipsoid(from.a, from.f);
  const target = ellipsoid(to.a, to.f);
  const own = new Float64Array(9);
  const heightRow = new Float64Array(3);

  const shift = (state: Float64Array) => {
    geodeticToEcef(state[0], state[1], state[2], state, 0, source);
    const x = state[0];
    const y = state[1];
    const z = state[2];
    ecefToGeodetic(
      translation[0] + matrix[0] * x + matrix[1] * y + matrix[2] * z,
      translation[1] + matrix[3] * x + matrix[4] * y + matrix[5] * z,
      translation[2] + matrix[6] * x + matrix[7] * y + matrix[8] * z,
      state,
      0,
      target,
    );
  };
  return {
    apply(state) {
      const height = state[2];
      shift(state);
      if (keepHeight) state[2] = height;
    },
    differentiate(state, jacobian) {
      const height = state[2];
      heightRow.set(jacobian.subarray(6));
      geodeticJacobian(state, source, own);
      premultiply(own, jacobian);
      premultiply(matrix, jacobian);
      shift(state);
      inverseGeodeticJacobian(state, target, own);
      premultiply(own, jacobian);
      if (!keepHeight) return;
      state[2] = height;
      jacobian.set(heightRow, 6);
    },
  };
}

/** d ECEF / d (longitude, latitude, height), row-major; columns (ν + h) cos φ · east, (ρ + h) · north, up. */
function geodeticJacobian(state: Float64Array, shape: Ellipsoid, out: Float64Array): void {
  const [longitude, latitude] = state;
  const sinLon = Math.sin(longitude);
  const cosLon = Math.cos(longitude);
  const sinLat = Math.sin(latitude);
  const cosLat = Math.cos(latitude);
  const toAxis = (primeVertical(shape, sinLat) + state[2]) * cosLat;
  const toCentre = meridional(shape, sinLat) + state[2];
  out[0] = -toAxis * sinLon;
  out[3] = toAxis * cosLon;
  out[6] = 0;
  out[1] = -toCentre * sinLat * cosLon;
  out[4] = -toCentre * sinLat * sinLon;
  out[7] = toCentre * cosLat;
  out[2] = cosLat * cosLon;
  out[5] = cosLat * sinLon;
  out[8] = sinLat;
}

/** d (longitude, latitude, height) / d ECEF, row-major; rows east / ((ν + h) cos φ), north / (ρ + h), up. */
function inverseGeodeticJacobian(state: Float64Array, shape: Ellipsoid, out: Float64Array): void {
  const [longitude, latitude] = state;
  const sinLon = Math.sin(longitude);
  const cosLon = Math.cos(longitude);
  const sinLat = Math.sin(latitude);
  const cosLat = Math.cos(latitude);
  const toAxis = (primeVertical(shape, sinLat) + state[2]) * cosLat;
  const toCentre = meridional(shape, sinLat) + state[2];
  out[0] = -sinLon / toAxis;
  out[1] = cosLon / toAxis;
  out[2] = 0;
  out[3] = (-sinLat * cosLon) / toCentre;
  out[4] = (-sinLat * sinLon) / toCentre;
  out[5] = cosLat / toCentre;
  out[6] = cosLat * cosLon;
  out[7] = cosLat * sinLon;
  out[8] = sinLat;
}

/** Radius of curvature ν in the prime vertical, metres. */
function primeVertical({ a, e2 }: Ellipsoid, sinLatitude: number): number {
  return a / Math.sqrt(1 - e2 * sinLatitude * sinLatitude);
}

/** Radius of curvature ρ in the meridian, metres. */
function meridional({ a, e2 }: Ellipsoid, sinLatitude: number): number {
  return (a * (1 - e2)) / (1 - e2 * sinLatitude * sinLatitude) ** 1.5;
}
