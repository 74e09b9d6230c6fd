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
