import { Directory, Fd, File, Inode, wasi } from "@bjorn3/browser_wasi_shim";

/** What a file consists of, wherever it lies. Positions are bytes from its start. */
export interface Bytes {
  readonly size: number;
  /** Those from `begin` up to `end`, as far as they are there. */
  read(begin: number, end: number): Uint8Array;
  /** Missing where they cannot be changed. */
  write?(at: number, data: Uint8Array): void;
}

/** Bytes of a block. */
const BLOCK = 1 << 22;

/** Bytes in memory that grow without being copied. */
export class GrowingBytes implements Bytes {
  readonly #blocks: Uint8Array<ArrayBuffer>[] = [];
  #size = 0;

  get size(): number {
    return this.#size;
  }

  read(begin: number, end: number): Uint8Array {
    const out = new Uint8Array(Math.max(0, Math.min(end, this.#size) - begin));
    this.#eachBlock(begin, out.length, (block, done) => out.set(block, done));
    return out;
  }

  write(at: number, data: Uint8Array): void {
    const end = at + data.length;
    while (this.#blocks.length * BLOCK < end) this.#blocks.push(new Uint8Array(BLOCK));
    this.#eachBlock(at, data.length, (block, done) => block.set(data.subarray(done, done + block.length)));
    this.#size = Math.max(this.#size, end);
  }

  toBlob(): Blob {
    const parts: Uint8Array<ArrayBuffer>[] = [];
    this.#eachBlock(0, this.#size, (block) => parts.push(block));
    return new Blob(parts);
  }

  /** Calls with each block's part of a range, and with how many bytes came before it. */
  #eachBlock(at: number, length: number, use: (part: Uint8Array<ArrayBuffer>, done: number) => void): void {
    for (let done = 0; done < length; ) {
      const begin = (at + done) % BLOCK;
      const block = this.#blocks[Math.floor((at + done) / BLOCK)]!;
      const part = block.subarray(begin, Math.min(BLOCK, begin + length - done));
      use(part, done);
      done += part.length;
    }
  }
}

/** A file of a program of WASI. */
export class BytesFile extends Inode {
  readonly bytes: Bytes;

  constructor(bytes: Bytes) {
    super();
    this.bytes = bytes;
  }

  override path_open(oflags: number, rights: bigint, flags: number) {
    const changes = (rights & BigInt(wasi.RIGHTS_FD_WRITE)) !== 0n || (oflags & wasi.OFLAGS_TRUNC) !== 0;
    if (changes && !this.bytes.write) return { ret: wasi.ERRNO_PERM, fd_obj: null };
    const at = (flags & wasi.FDFLAGS_APPEND) === 0 ? 0 : this.bytes.size;
    return { ret: wasi.ERRNO_SUCCESS, fd_obj: new OpenBytes(this, at) };
  }

  override stat(): wasi.Filestat {
    return new wasi.Filestat(this.ino, wasi.FILETYPE_REGULAR_FILE, BigInt(this.bytes.size));
  }
}

/** A file that is open, and how far it is read or written. */
class OpenBytes extends Fd {
  readonly #file: BytesFile;
  #at: number;

  constructor(file: BytesFile, at: number) {
    super();
    this.#file = file;
    this.#at = at;
  }

  override fd_fdstat_get() {
    return { ret: wasi.ERRNO_SUCCESS, fdstat: new wasi.Fdstat(wasi.FILETYPE_REGULAR_FILE, 0) };
  }

  override fd_filestat_get() {
    return { ret: wasi.ERRNO_SUCCESS, filestat: this.#file.stat() };
  }

  override fd_read(size: number) {
    const data = this.#file.bytes.read(this.#at, this.#at + size);
    this.#at += data.length;
    return { ret: wasi.ERRNO_SUCCESS, data };
  }

  override fd_write(data: Uint8Array) {
    this.#file.bytes.write?.(this.#at, data);
    this.#at += data.length;
    return { ret: wasi.ERRNO_SUCCESS, nwritten: data.length };
  }

  override fd_seek(offset: bigint, whence: number) {
    const ends = { [wasi.WHENCE_CUR]: this.#at, [wasi.WHENCE_END]: this.#file.bytes.size };
    const at = (whence in ends ? ends[whence as keyof typeof ends] : 0) + Number(offset);
    if (at < 0) return { ret: wasi.ERRNO_INVAL, offset: 0n };
    this.#at = at;
    return { ret: wasi.ERRNO_SUCCESS, offset: BigInt(at) };
  }

  override fd_tell() {
    return { ret: wasi.ERRNO_SUCCESS, offset: BigInt(this.#at) };
  }
}

/** A folder whose new files grow without being copied. */
export class GrowingFolder extends Directory {
  override create_entry_for_path(path: string, isFolder: boolean) {
    const made = super.create_entry_for_path(path, isFolder);
    if (!(made.entry instanceof File)) return made;
    const names = path.split("/").filter((name) => name !== "" && name !== ".");
    const name = names.pop()!;
    const entry = new BytesFile(new GrowingBytes());
    const parent = names.reduce<Inode>((folder, step) => (folder as Directory).contents.get(step)!, this);
    (parent as Directory).contents.set(name, entry);
    return { ...made, entry };
  }
}
