/** A shader chunk of three.js: GLSL as text. Three publishes no types for single chunks. */
declare module "three/src/renderers/shaders/ShaderChunk/*.glsl.js" {
  const glsl: string;
  export default glsl;
}
