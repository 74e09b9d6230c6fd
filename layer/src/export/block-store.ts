/** Keeps blocks of bytes until they are asked for: on disk, or wherever there is room. */
export interface BlockStore {
  /** Takes a block, whose bytes are the caller's again once the promise is fulfilled. @returns what `get` takes */
  put(bytes: Uint8Array): Promise<unknown>;
  get(block: unknown): Promise<Uint8Array>;
}

/** Keeps blocks as `Blob`s, which browsers move to disk when they are many. */
export class BlobStore implements BlockStore {
  async put(bytes: Uint8Array): Promise<Blob> {
    return new Blob([bytes as Uint8Array<ArrayBuffer>]);
  }

  async get(block: unknown): Promise<Uint8Array> {
    return new Uint8Array(await (block as Blob).arrayBuffer());
  }
}
