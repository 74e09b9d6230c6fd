import { statSync } from "node:fs";
import { resolve } from "node:path";
import { ServerError, serve } from "../server.js";

export interface ServeOptions {
  readonly host?: string;
  readonly port?: number;
}

/**
 * The `serve` command: the files of a folder with Range and CORS, until the process is stopped.
 *
 * @throws ServerError SERVER_FOLDER, SERVER_PORT
 */
export async function runServe(folder: string, options: ServeOptions): Promise<void> {
  const root = resolve(folder);
  if (!statSync(root, { throwIfNoEntry: false })?.isDirectory()) {
    throw new ServerError({
      ...{ code: "SERVER_FOLDER", file: folder, cause: "it is not a folder" },
      fix: "give the folder whose files are to be served",
    });
  }
  const { address } = await serve([{ path: "/", folder: root }], options);
  process.stdout.write(`serve    ${root} at ${address}\n`);
}
