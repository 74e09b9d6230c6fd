import { GromaError } from "@groma/georef";
import { SourceError } from "../errors/index.js";

/** One load for all who ask; after a failure the next one tries again. */
export function once<T>(load: () => Promise<T>): () => Promise<T> {
  let loading: Promise<T> | undefined;
  return () => {
    loading ??= load().catch((thrown: unknown) => {
      loading = undefined;
      throw thrown;
    });
    return loading;
  };
}

/**
 * Reads a file that lies beside this library.
 *
 * @param what it holds, for the error
 * @throws SourceError with the given code where it cannot be had or read
 */
export async function packagedFile<T>(
  address: URL,
  { code, what }: { readonly code: string; readonly what: string },
  read: (response: Response) => Promise<T>,
): Promise<T> {
  let cause: string;
  try {
    const response = await fetch(address);
    if (response.ok) return await read(response);
    cause = `the server answered ${response.status}`;
  } catch (thrown) {
    cause = thrown instanceof GromaError ? thrown.cause : String(thrown);
  }
  throw new SourceError({
    code,
    file: address.href,
    cause: `${what} cannot be loaded: ${cause}`,
    fix: "put the files of @groma/layer/dist/cloud beside the code, as bundlers do that follow new URL(…, import.meta.url)",
  });
}

/**
 * Fetches code of this library that most pages do not need.
 *
 * @param load the `import()` of it, which bundlers follow
 * @throws SourceError SOURCE_MODULE where it cannot be had
 */
export async function packagedModule<T>(load: () => Promise<T>): Promise<T> {
  try {
    return await load();
  } catch (thrown) {
    throw new SourceError({
      code: "SOURCE_MODULE",
      file: "@groma/layer",
      cause: `a part of this library cannot be loaded: ${thrown instanceof Error ? thrown.message : thrown}`,
      fix: "serve all files that the bundler has made, and reload the page where they are newer than it is",
    });
  }
}
