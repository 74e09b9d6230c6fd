/**
 * Web Mercator (EPSG:3857) without ellipsoid and unit. It is no map projection of its ellipsoid but spherical
 * formulas on geodetic coordinates of WGS 84, and stands apart from the rest for that.
 */
export const WEB_MERCATOR = "+proj=merc +lat_ts=0 +lon_0=0 +k=1 +x_0=0 +y_0=0";
