import { spawn } from "node:child_process";
import { createReadStream, existsSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { basename, dirname, join } from "node:path";
import { projectRoot } from "../project.js";

/** A registry of npm on this machine. */
export interface Registry {
  readonly address: string;
  /** Names that were asked for and are not there. */
  readonly missing: Set<string>;
  close(): void;
}

interface Version {
  readonly description: { readonly name: string; readonly version: string };
  /** A tarball, or the folder that the package is installed in. */
  readonly path: string;
}

/** Packages that are installed in the project, by the lockfile: a name may stand in several versions. */
function installed(): Map<string, Map<string, Version>> {
  const { packages } = JSON.parse(readFileSync(join(projectRoot, "package-lock.json"), "utf8")) as {
    packages: Record<string, { link?: boolean }>;
  };
  const found = new Map<string, Map<string, Version>>();
  for (const [place, { link }] of Object.entries(packages)) {
    const path = join(projectRoot, place);
    if (link || !place.includes("node_modules/") || !existsSync(join(path, "package.json"))) continue;
    const description = JSON.parse(
      readFileSync(join(path, "package.json"), "utf8"),
    ) as Version["description"];
    const { name, version } = description;
    if (!found.has(name)) found.set(name, new Map());
    found.get(name)!.set(version, { description, path });
  }
  return found;
}

/**
 * Serves packed packages, and beside them what the lockfile has and is installed here: whatever else is asked for is not
 * there, as without a network.
 *
 * @param packed name of a package to its tarball and its description
 */
export async function openRegistry(packed: ReadonlyMap<string, Version>): Promise<Registry> {
  const known = installed();
  for (const [name, one] of packed) known.set(name, new Map([[one.description.version, one]]));
  const missing = new Set<string>();
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url ?? "/", "http://localhost");
    const file = /^\/-\/(.+)\/([^/]+)\.tgz$/.exec(decodeURIComponent(pathname));
    const name = file ? file[1]! : decodeURIComponent(pathname.slice(1));
    const versions = known.get(name);
    if (!versions) {
      missing.add(name);
      response.writeHead(404, { "content-type": "application/json" }).end("{}");
    } else if (file) {
      const { path } = versions.get(file[2]!)!;
      response.writeHead(200, { "content-type": "application/octet-stream" });
      if (path.endsWith(".tgz")) return void createReadStream(path).pipe(response);
      // Its own node_modules are packages of their own.
      const args = ["-c", "--exclude=node_modules", "-C", dirname(path), basename(path)];
      spawn("tar", args, { stdio: ["ignore", "pipe", "inherit"] }).stdout.pipe(response);
    } else {
      const { port } = server.address() as AddressInfo;
      const described = [...versions.values()].map(({ description }) => {
        const tarball = `http://127.0.0.1:${port}/-/${encodeURIComponent(name)}/${description.version}.tgz`;
        return [description.version, { ...description, dist: { tarball } }] as const;
      });
      const latest = described.at(-1)![0];
      const answer = { name, "dist-tags": { latest }, versions: Object.fromEntries(described) };
      response.writeHead(200, { "content-type": "application/json" }).end(JSON.stringify(answer));
    }
  });
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
  const address = `http://127.0.0.1:${(server.address() as AddressInfo).port}/`;
  return { address, missing, close: () => void server.close() };
}
