import type { ByteSource, ReadOptions } from "../bytes/byte-source.js";
import { KnownParts } from "../bytes/known-parts.js";
import type { EncodedChunk, HierarchyEntry, LasEnvelope, PointSource } from "../contract/point-source.js";
import { readEnvelope } from "../las/envelope.js";
import { BASE_RECORD_LENGTH, readText } from "../las/las-header.js";
import { type LazEncoding, recordFields } from "../las/record-fields.js";
import { Checksums } from "./checksums.js";
import { type CopcFile, openCopc } from "./copc-file.js";
import type { ByteRange } from "./copc-info.js";
import type { FirstPage } from "./first-page.js";
import { type ChunkRange, checkPageAddress, entriesOfPage, type HierarchyLimits } from "./hierarchy.js";
import { identityOf } from "./identity.js";
import { trustedBox } from "./trusted-box.js";

/** A COPC file as a source of points. */
export class CopcSource implements PointSource<ChunkRange, LazEncoding> {
  readonly name: string;
  readonly pointCount: number;
  readonly identity: string;
  readonly boundingBox: PointSource["boundingBox"];
  readonly warnings: PointSource["warnings"];
  readonly cube: PointSource["cube"];
  readonly spacing: number;
  readonly scale: PointSource["scale"];
  readonly offset: PointSource["offset"];
  readonly crs: PointSource["crs"];
  readonly attributes: PointSource["attributes"];
  readonly statistics: PointSource["statistics"];
  readonly bytesPerPoint: number;
  readonly encoding: LazEncoding;
  readonly rootPage: ByteRange;
  readonly #bytes: ByteSource;
  readonly #file: CopcFile;
  #checksums: Promise<Checksums | undefined> | undefined;
  readonly #limits: HierarchyLimits;
  /** The root page until it is asked for. */
  #first: FirstPage | undefined;

  /** @param first the root page */
  constructor(file: CopcFile, first: FirstPage) {
    const { source, header, info } = file;
    const { pointFormat, recordLength } = header;
    const [x, y, z] = info.center.map((middle) => middle - info.halfSize);
    const edge = 2 * info.halfSize;
    this.#bytes = source;
    this.#file = file;
    this.#limits = file.limits;
    this.name = source.name;
    this.pointCount = header.pointCount;
    this.identity = identityOf(header, first.bytes);
    this.cube = [x, y, z, edge];
    const { boundingBox, warnings } = trustedBox(header, this.cube, entriesOfPage(first.bytes, file.limits));
    this.boundingBox = boundingBox;
    this.warnings = warnings;
    this.#first = first;
    this.spacing = info.spacing || edge / CELLS_PER_EDGE;
    this.scale = header.scale;
    this.offset = header.offset;
    this.crs = file.crs;
    const fields = recordFields(pointFormat, file.extraBytes);
    const extraLength = recordLength - BASE_RECORD_LENGTH[pointFormat];
    this.attributes = fields;
    this.statistics = file.statistics;
    this.bytesPerPoint = recordLength;
    this.encoding = { kind: "laz", pointFormat, recordLength, extraLength, fields };
    this.rootPage = info.rootPage;
  }

  /** @throws SourceError, FormatError */
  static async open(bytes: ByteSource, options: ReadOptions = {}): Promise<CopcSource> {
    const parts = new KnownParts(bytes);
    const file = await openCopc(parts, options);
    const { rootPage } = file.info;
    const first = file.firstPage ?? (await readFirstPage(parts, rootPage, options));
    const source = new CopcSource(file, first);
    // The checksums of the first page may be among what was read ahead.
    if (!first.checksums) await source.#openChecksums();
    parts.forget();
    return source;
  }

  /** Whether a file that begins with these bytes is of the family of LAS, which COPC belongs to. */
  static recognises(opening: Uint8Array): boolean {
    return readText(opening, 0, 4) === "LASF";
  }

  get wait(): PointSource["wait"] {
    return this.#bytes.wait;
  }

  async page(address: ByteRange, options: ReadOptions = {}): Promise<Iterable<HierarchyEntry<ChunkRange>>> {
    checkPageAddress(address, this.#limits);
    const { offset, length } = address;
    const first = address === this.rootPage ? this.#first : undefined;
    if (first) this.#first = undefined;
    const [bytes, checksums] = await Promise.all([
      first?.bytes ?? this.#bytes.read(offset, offset + length, options),
      first?.checksums ?? this.#openChecksums().then((all) => all?.ofPage(address, options)),
    ]);
    return entriesOfPage(bytes, this.#limits, checksums);
  }

  async chunk({ offset, length, checksum }: ChunkRange, options: ReadOptions = {}): Promise<EncodedChunk> {
    const bytes = await this.#bytes.read(offset, offset + length, options);
    const whole = bytes.byteLength === bytes.buffer.byteLength;
    return { bytes: (whole ? bytes.buffer : bytes.slice().buffer) as ArrayBuffer, checksum };
  }

  lasEnvelope(options: ReadOptions = {}): Promise<LasEnvelope> {
    return readEnvelope(this.#bytes, this.#file.header, options);
  }

  /** The file's checksums, looked for with its first page. */
  #openChecksums(): Promise<Checksums | undefined> {
    this.#checksums ??= Checksums.open(this.#file).catch((error: unknown) => {
      this.#checksums = undefined;
      throw error;
    });
    return this.#checksums;
  }
}

async function readFirstPage(
  bytes: ByteSource,
  { offset, length }: ByteRange,
  options: ReadOptions,
): Promise<FirstPage> {
  return { bytes: await bytes.read(offset, offset + length, options), checksums: undefined };
}

/** COPC writers give spacing as an edge's 128th or so; taken where the file leaves it at 0. */
const CELLS_PER_EDGE = 128;
