import type { ShaderTarget, UniformDeclaration } from "./shader-target.js";

/**
 * What shaders say as `$word` and each target has under another name. The values are expressions; those of plain
 * WebGL 2 that are uniforms are declared where they are used.
 */
const WORDS: Readonly<Record<ShaderTarget, Readonly<Record<string, string>>>> = {
  cesium: {
    modelView: "czm_modelView",
    projection: "czm_projection",
    viewport: "czm_viewport",
    pixelRatio: "czm_pixelRatio",
  },
  webgl2: {
    modelView: "u_modelView",
    projection: "u_projection",
    viewport: "u_viewport",
    pixelRatio: "u_pixelRatio",
  },
};

const TYPES = { modelView: "mat4", projection: "mat4", viewport: "vec4", pixelRatio: "float" } as const;

/** Replaces the words, and says which uniforms the text needs for them. */
export function translateWords(
  text: string,
  target: ShaderTarget,
): { readonly text: string; readonly uniforms: readonly UniformDeclaration[] } {
  const used = new Set<keyof typeof TYPES>();
  const translated = text.replace(/\$([A-Za-z]+)/g, (_, word: string) => {
    const name = WORDS[target][word];
    if (name === undefined) throw new Error(`shaders know no word $${word}`);
    used.add(word as keyof typeof TYPES);
    return name;
  });
  const uniforms =
    target === "cesium"
      ? []
      : [...used].map((word) => ({ name: WORDS.webgl2[word], type: TYPES[word], scope: "view" as const }));
  return { text: translated, uniforms };
}
