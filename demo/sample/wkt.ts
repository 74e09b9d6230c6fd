const DEGREE = 'UNIT["degree",0.0174532925199433,AUTHORITY["EPSG","9122"]]';
const METRE = 'UNIT["metre",1,AUTHORITY["EPSG","9001"]]';

const DATUM = [
  'DATUM["CH1903+",SPHEROID["Bessel 1841",6377397.155,299.1528128,AUTHORITY["EPSG","7004"]]',
  'TOWGS84[674.374,15.056,405.346,0,0,0,0],AUTHORITY["EPSG","6150"]]',
].join(",");

const GEOGRAPHIC = [
  `GEOGCS["CH1903+",${DATUM}`,
  'PRIMEM["Greenwich",0,AUTHORITY["EPSG","8901"]]',
  `${DEGREE},AUTHORITY["EPSG","4150"]]`,
].join(",");

const PROJECTED = [
  `PROJCS["CH1903+ / LV95",${GEOGRAPHIC}`,
  'PROJECTION["Hotine_Oblique_Mercator_Azimuth_Center"]',
  'PARAMETER["latitude_of_center",46.9524055555556]',
  'PARAMETER["longitude_of_center",7.43958333333333]',
  'PARAMETER["azimuth",90]',
  'PARAMETER["rectified_grid_angle",90]',
  'PARAMETER["scale_factor",1]',
  'PARAMETER["false_easting",2600000]',
  'PARAMETER["false_northing",1200000]',
  METRE,
  'AXIS["Easting",EAST]',
  'AXIS["Northing",NORTH]',
  'AUTHORITY["EPSG","2056"]]',
].join(",");

const VERTICAL = [
  'VERT_CS["LN02 height",VERT_DATUM["Landesnivellement 1902",2005,AUTHORITY["EPSG","5127"]]',
  METRE,
  'AXIS["Gravity-related height",UP]',
  'AUTHORITY["EPSG","5728"]]',
].join(",");

/** WKT1 of EPSG:2056+5728, LV95 in plane and LN02 in height, as LAS 1.4 wants it in its OGC WKT record. */
export const LV95_LN02_WKT = `COMPD_CS["CH1903+ / LV95 + LN02 height",${PROJECTED},${VERTICAL}]`;
