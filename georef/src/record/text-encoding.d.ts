/**
 * The Encoding Standard's classes, present in Node, workers and pages alike; the compiler knows them only through the
 * DOM library, which this package does without.
 */
declare class TextEncoder {
  encode(text: string): Uint8Array<ArrayBuffer>;
}

declare class TextDecoder {
  constructor(label?: "utf-8", options?: { fatal?: boolean; ignoreBOM?: boolean });
  decode(bytes: Uint8Array): string;
}
