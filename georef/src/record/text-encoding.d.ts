/**
 * The Encoding Standard's classes and base64 of HTML, present in Node, workers and pages alike; the compiler knows them only through the
 * DOM library, which this package does without.
 */
declare class TextEncoder {
  encode(text: string): Uint8Array<ArrayBuffer>;
}

declare class TextDecoder {
  constructor(label?: "utf-8", options?: { fatal?: boolean; ignoreBOM?: boolean });
  decode(bytes: Uint8Array): string;
}

/** Of characters up to U+00FF. */
declare function btoa(text: string): string;

/** @throws DOMException where the text is no base64 */
declare function atob(base64: string): string;
