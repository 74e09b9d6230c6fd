import { expect, it } from "vitest";
import { crc32, crc32c } from "./checksum.js";

it("is the checksum of RFC 3720, appendix B.4", () => {
  expect(crc32c(new Uint8Array(32))).toBe(0x8a9136aa);
  expect(crc32c(new Uint8Array(32).fill(0xff))).toBe(0x62a8ab43);
  expect(crc32c(Uint8Array.from({ length: 32 }, (_, index) => index))).toBe(0x46dd794e);
  expect(crc32c(Uint8Array.from({ length: 32 }, (_, index) => 31 - index))).toBe(0x113fdb5c);
  expect(crc32c(new TextEncoder().encode("123456789"))).toBe(0xe3069283);
  expect(crc32c(new Uint8Array(0))).toBe(0);
});

it("sees every bit of every byte, whatever their number and where they lie", () => {
  const whole = Uint8Array.from({ length: 40 }, (_, index) => (index * 37) & 255);
  for (let length = 1; length <= 33; length++) {
    const bytes = whole.subarray(3, 3 + length).slice();
    const expected = crc32c(bytes);
    expect(crc32c(whole.subarray(3, 3 + length))).toBe(expected);
    for (let bit = 0; bit < 8 * length; bit++) {
      bytes[bit >> 3]! ^= 1 << (bit & 7);
      expect(crc32c(bytes)).not.toBe(expected);
      bytes[bit >> 3]! ^= 1 << (bit & 7);
    }
  }
});

it("goes on from the checksum of what came before; that of ZIP is the one of its specification", () => {
  const text = new TextEncoder().encode("123456789");
  // The check value of CRC-32/ISO-HDLC.
  expect(crc32(text)).toBe(0xcbf43926);
  for (let cut = 0; cut <= text.length; cut++)
    expect(crc32(text.subarray(cut), crc32(text.subarray(0, cut)))).toBe(0xcbf43926);
});
