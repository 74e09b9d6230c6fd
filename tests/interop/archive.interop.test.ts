import { execFileSync } from "node:child_process";
import { ftruncateSync, mkdtempSync, openSync, rmSync, writeSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { crc32 } from "node:zlib";
import { expect, it } from "vitest";
import { type ZipFile, zipDescriptor, zipDirectory, zipHeader } from "../../layer/src/export/zip.js";

const DATE = new Date(2026, 5, 7, 8, 9, 10);
const GIGABYTES = 5_000_000_000;
/** One more than 16 bits count. */
const MANY = 65_536;

const LIST = `
import json, sys, zipfile
archive = zipfile.ZipFile(sys.argv[1])
files = archive.infolist()
print(json.dumps([[one.filename, one.file_size, one.header_offset] for one in files[:3]]))
print(json.dumps([archive.read(name).decode() for name in ("before", "behind")]))
print(len(files), files[-1].filename)
`;

it("archives beyond 4 GB and 65,535 files are read by Python", () => {
  const folder = mkdtempSync(join(tmpdir(), "groma-archive-"));
  try {
    const path = join(folder, "large.zip");
    const file = openSync(path, "w");
    const files: ZipFile[] = [];
    let end = 0;
    const write = (bytes: Uint8Array) => {
      writeSync(file, bytes, 0, bytes.length, end);
      end += bytes.length;
    };
    const add = (name: string, content: Uint8Array, size = content.length) => {
      const known = { name, at: end, size, checksum: crc32(content) };
      write(zipHeader(name, DATE));
      write(content);
      // What is larger than its content is a hole in the file.
      end += size - content.length;
      ftruncateSync(file, end);
      write(zipDescriptor(known));
      files.push(known);
    };
    add("before", Buffer.from("first"));
    add("large", new Uint8Array(0), GIGABYTES);
    add("behind", Buffer.from("last"));
    while (files.length < MANY) files.push({ ...files[2]!, name: `behind ${files.length}` });
    write(Buffer.concat([...zipDirectory(files, end, DATE)]));
    const [list, texts, count] = execFileSync("python3", ["-c", LIST, path], { encoding: "utf8" }).split(
      "\n",
    );
    expect(JSON.parse(list!)).toEqual(files.slice(0, 3).map(({ name, size, at }) => [name, size, at]));
    expect(files[2]!.at).toBeGreaterThan(GIGABYTES);
    expect(JSON.parse(texts!)).toEqual(["first", "last"]);
    expect(count).toBe(`${MANY} behind ${MANY - 1}`);
  } finally {
    rmSync(folder, { recursive: true });
  }
});
