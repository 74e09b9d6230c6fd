/** Numbers that JSON has no word for. */
const INFINITY = "∞";

/** A value as text of letters, digits, - and _ alone (base64url, RFC 4648, of its JSON). Infinite numbers are kept. */
export function asText(value: unknown): string {
  const json = JSON.stringify(value, (_, one: unknown) => {
    if (one === Number.POSITIVE_INFINITY) return INFINITY;
    if (one === Number.NEGATIVE_INFINITY) return `-${INFINITY}`;
    // A word that looks like one of these gets one more.
    return typeof one === "string" && /^-?∞+$/.test(one) ? `${one}${INFINITY}` : one;
  });
  // A letter for each byte, as `btoa` wants it; all of a long text at once would be too many arguments.
  const letters = Array.from(new TextEncoder().encode(json), (byte) => String.fromCharCode(byte));
  return btoa(letters.join("")).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/** @throws where the text is none that {@link asText} wrote */
export function fromText(text: string): unknown {
  const bytes = Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (letter) =>
    letter.charCodeAt(0),
  );
  return JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(bytes), (_, one: unknown) => {
    if (one === INFINITY) return Number.POSITIVE_INFINITY;
    if (one === `-${INFINITY}`) return Number.NEGATIVE_INFINITY;
    return typeof one === "string" && /^-?∞+$/.test(one) ? one.slice(0, -1) : one;
  });
}
