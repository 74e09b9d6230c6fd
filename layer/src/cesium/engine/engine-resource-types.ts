/** Types of the GPU objects that `cesium-private.ts` takes from Cesium. */

/** `Renderer/Context`, as far as GPU objects need it. */
export interface ContextHandle {
  readonly _gl: WebGL2RenderingContext;
}

/** `Renderer/Buffer`. */
export interface Buffer {
  readonly sizeInBytes: number;
  /** Whether a vertex array destroys it with itself. */
  vertexArrayDestroyable: boolean;
  /** Writes numbers from a byte on. */
  copyFromArrayView(arrayView: ArrayBufferView, offsetInBytes: number): void;
  /** Copies the contents of a buffer that pixels were read into. */
  getBufferData(target: ArrayBufferView): void;
  destroy(): void;
}

/** Options of `Buffer.createVertexBuffer`. */
export interface BufferOptions {
  readonly context: ContextHandle;
  readonly sizeInBytes: number;
  readonly usage: number;
}

/** `Renderer/VertexArray`; destroys the buffers it was made of, where they allow it. */
export interface VertexArray {
  /** Called by a command once its program and uniforms are set, before it draws. */
  _bind(): void;
  /** Called after that. */
  _unBind(): void;
  destroy(): void;
}

/** One attribute of a {@link VertexArray}: of a buffer, or one value for all vertices. */
export type VertexAttribute =
  | {
      readonly index: number;
      readonly vertexBuffer: Buffer;
      readonly componentsPerAttribute: number;
      readonly componentDatatype: number;
      readonly normalize: boolean;
    }
  | { readonly index: number; readonly value: readonly number[] };

/** `Renderer/ShaderProgram`, counted by the context's shader cache. */
export interface ShaderProgram {
  /** Compiles and links the program where that was not done yet, and waits for it. */
  readonly numberOfVertexAttributes: number;
  destroy(): void;
}

/** Options of `ShaderProgram.fromCache`. */
export interface ShaderProgramOptions {
  readonly context: ContextHandle;
  readonly vertexShaderSource: ShaderSource;
  readonly fragmentShaderSource: ShaderSource;
  readonly attributeLocations: Readonly<Record<string, number>>;
}

/** `Renderer/ShaderSource`. */
export interface ShaderSource {
  readonly sources: readonly string[];
}

/** `Renderer/Sampler`. */
export interface Sampler {
  readonly minificationFilter: number;
}

/** `Renderer/Texture`. */
export interface Texture {
  readonly width: number;
  readonly height: number;
  readonly sizeInBytes: number;
  copyFrom(options: { readonly source: TextureSource }): void;
  destroy(): void;
}

/** Texels as they lie in memory, first row first. */
export interface TextureSource {
  readonly width: number;
  readonly height: number;
  readonly arrayBufferView: ArrayBufferView;
}

/** Options of `Renderer/Texture`. */
export interface TextureOptions {
  readonly context: ContextHandle;
  readonly width?: number;
  readonly height?: number;
  readonly source?: TextureSource;
  readonly pixelFormat: number;
  readonly pixelDatatype: number;
  readonly sampler: Sampler;
  readonly flipY?: boolean;
}

/** `Renderer/Framebuffer`. */
export interface Framebuffer {
  /** Bind it to be drawn into, and to be read from, whatever the context takes for bound. */
  bindDraw(): void;
  bindRead(): void;
  destroy(): void;
}

/** Options of `Renderer/Framebuffer`. */
export interface FramebufferOptions {
  readonly context: ContextHandle;
  readonly colorTextures: readonly Texture[];
  readonly depthTexture: Texture;
  readonly destroyAttachments: boolean;
}

/** `Renderer/Sync`: a fence in the GPU's queue. */
export interface Sync {
  /** `WebGLConstants.SIGNALED` once the GPU has passed it. */
  getStatus(): number;
  destroy(): void;
}
