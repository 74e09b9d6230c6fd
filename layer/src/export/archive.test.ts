import { makeZip } from "client-zip";
import { expect, it } from "vitest";
import { type ArchiveEntry, writeArchive } from "./archive.js";
import { MemorySink } from "./byte-sink.js";

const DATE = new Date(2026, 5, 7, 8, 9, 10);

async function archiveOf(entries: Iterable<ArchiveEntry>): Promise<Uint8Array> {
  const sink = new MemorySink();
  await writeArchive(entries, sink, DATE);
  return sink.bytes();
}

/** The same by another program. */
async function byReferee(entries: readonly ArchiveEntry[]): Promise<Uint8Array> {
  const files = entries.map(({ name, content }) => ({
    name,
    input: content as Uint8Array<ArrayBuffer> | string,
    lastModified: DATE,
  }));
  return new Uint8Array(await new Response(makeZip(files)).arrayBuffer());
}

const isSame = (a: Uint8Array, b: Uint8Array) => Buffer.compare(a, b) === 0;

it("is the archive that another program makes of the same files", async () => {
  const large = Uint8Array.from({ length: 3_000_001 }, (_, index) => (index * 37) & 255);
  const entries: ArchiveEntry[] = [
    { name: "section 1_0+005.000.las", content: large },
    { name: "größe.csv", content: "größer\r\n" },
    { name: "empty", content: new Uint8Array(0) },
    ...Array.from({ length: 20 }, (_, index) => ({ name: `small ${index}`, content: large.slice(0, index) })),
  ];
  expect(isSame(await archiveOf(entries), await byReferee(entries))).toBe(true);
});

it("gives the bytes of a file back before the next one is asked for", async () => {
  const block = new Uint8Array(4);
  function* entries() {
    for (const value of [1, 2, 3]) yield { name: `${value}`, content: block.fill(value) };
  }
  const apart = [1, 2, 3].map((value) => ({ name: `${value}`, content: new Uint8Array(4).fill(value) }));
  expect(isSame(await archiveOf(entries()), await byReferee(apart))).toBe(true);
});
