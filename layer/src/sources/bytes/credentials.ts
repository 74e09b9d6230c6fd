import { GromaError } from "@groma/georef";
import { SourceError } from "../../errors/index.js";
import { type Expiring, Renewable, type RenewalContext } from "./renewable.js";

/** An address, with the time until which it may be asked where it has one: a `Date`, or milliseconds since 1970. */
export type Address =
  | string
  | URL
  | { readonly url: string | URL; readonly expires?: Date | number | undefined };

/** Gives the address of a file; called again once it has expired or the server refuses it (401, 403). */
export type AddressFunction = (context: RenewalContext) => Address | Promise<Address>;

/** Request headers by name. */
export type HeaderValues = Readonly<Record<string, string>>;

/** Headers, with the time until which they hold where they have one. */
export type ExpiringHeaders = {
  readonly headers: HeaderValues;
  readonly expires?: Date | number | undefined;
};

/** Gives the headers of requests; called again once they have expired or the server refuses them (401, 403). */
export type HeadersFunction = (
  context: RenewalContext,
) => HeaderValues | ExpiringHeaders | Promise<HeaderValues | ExpiringHeaders>;

/** What requests are made with: one address and one set of headers at a time. */
export class Credentials {
  readonly #address: Renewable<string>;
  readonly #headers: Renewable<HeaderValues>;

  /** @param name what errors call the file */
  constructor(
    address: string | AddressFunction,
    headers: HeaderValues | HeadersFunction | undefined,
    name: string,
  ) {
    const told = <T>(what: string, ask: (context: RenewalContext) => Promise<T>) => {
      return (context: RenewalContext) =>
        ask(context).catch((thrown) => Promise.reject(failed(what, thrown, name)));
    };
    this.#address = new Renewable(
      typeof address === "string"
        ? { value: address }
        : { renew: told("address", async (context) => addressOf(await address(context))) },
    );
    this.#headers = new Renewable(
      typeof headers === "function"
        ? { renew: told("headers", async (context) => headersOf(await headers(context))) }
        : { value: headers ?? {} },
    );
  }

  /** @throws SourceError SOURCE_RENEWAL where a function of the application's fails */
  async get(): Promise<{ readonly address: string; readonly headers: HeaderValues }> {
    // In this order: where one function serves both, as with Cesium's Resource, headers follow the address.
    const address = await this.#address.get();
    return { address, headers: await this.#headers.get() };
  }

  /**
   * Has address and headers renewed that a server refused.
   * @returns whether there is something else to try
   */
  async replace(
    refused: { readonly address: string; readonly headers: HeaderValues },
    status: number,
  ): Promise<boolean> {
    const address = await this.#address.replace(refused.address, status);
    const headers = await this.#headers.replace(refused.headers, status);
    return address || headers;
  }
}

function addressOf(given: Address): Expiring<string> {
  const parts = typeof given === "string" || given instanceof URL ? { url: given } : given;
  const value = String(parts.url);
  return { value, expires: timeOf(parts.expires) ?? expiryOf(value) };
}

function headersOf(given: HeaderValues | ExpiringHeaders): Expiring<HeaderValues> {
  return isExpiring(given) ? { value: given.headers, expires: timeOf(given.expires) } : { value: given };
}

function isExpiring(given: HeaderValues | ExpiringHeaders): given is ExpiringHeaders {
  return typeof given.headers === "object";
}

function timeOf(expires: Date | number | undefined): number | undefined {
  return expires === undefined ? undefined : Number(expires);
}

/**
 * When a signed address ends, as its query says: Amazon S3 and Google Cloud Storage (version 4: `X-Amz-Date`,
 * `X-Amz-Expires` and alike), CloudFront and version 2 of both (`Expires`), Azure Storage (`se`).
 * @returns milliseconds since 1970; undefined where it does not say
 */
export function expiryOf(address: string): number | undefined {
  const query = new URLSearchParams(/\?([^#]*)/.exec(address)?.[1]);
  for (const vendor of ["Amz", "Goog"]) {
    const date = /^(\d{4})(\d\d)(\d\d)T(\d\d)(\d\d)(\d\d)Z$/.exec(query.get(`X-${vendor}-Date`) ?? "");
    if (!date) continue;
    const [year, month, ...others] = date.slice(1).map(Number);
    return finite(
      Date.UTC(year, month - 1, ...others) + 1000 * Number(query.get(`X-${vendor}-Expires`) ?? Number.NaN),
    );
  }
  if (query.has("Expires")) return finite(1000 * Number(query.get("Expires")));
  return query.has("sig") ? finite(Date.parse(query.get("se") ?? "")) : undefined;
}

function finite(time: number): number | undefined {
  return Number.isFinite(time) && time > 0 ? time : undefined;
}

function failed(what: string, thrown: unknown, file: string): Error {
  if (thrown instanceof GromaError) return thrown;
  return new SourceError({
    ...{ code: "SOURCE_RENEWAL", file },
    cause: `the function that gives the ${what} failed: ${thrown instanceof Error ? thrown.message : String(thrown)}`,
    fix: "Look into the function that the application passes",
    outage: "failing",
  });
}
