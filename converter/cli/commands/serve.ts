import { statSync } from "node:fs";
import { resolve } from "node:path";
import { ServerError, type ServingOptions, serve } from "../server/server.js";
import { print } from "../terminal/output.js";

/**
 * The `serve` command: the files of a folder with Range, until the process is stopped.
 *
 * @throws ServerError SERVER_FOLDER, SERVER_PORT
 */
export async function runServe(folder: string, options: ServingOptions): Promise<void> {
  const root = resolve(folder);
  if (!statSync(root, { throwIfNoEntry: false })?.isDirectory()) {
    throw new ServerError({
      ...{ code: "SERVER_FOLDER", file: folder, cause: "this is not a folder" },
      fix: "Give the folder whose files are to be served",
    });
  }
  const { address } = await serve([{ path: "/", folder: root }], options);
  print([`serve    ${root} at ${address}`]);
}
