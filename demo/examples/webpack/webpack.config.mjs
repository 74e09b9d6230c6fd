export default {
  mode: "production",
  context: import.meta.dirname,
  entry: "./main.js",
  output: { path: `${import.meta.dirname}/dist`, publicPath: "auto" },
  // Cesium is most of the script; the tables of EPSG and EGM96 are fetched where they are needed.
  performance: { hints: false },
};
