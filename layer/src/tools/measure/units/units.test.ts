import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { MeasureUnits, type Quantity, type SiUnit } from "../index.js";
import { dms } from "./dms.js";
import { decimalsOf, numberText } from "./numbers.js";

function known<Unit extends SiUnit>(
  value: number,
  unit: Unit,
  uncertainty: number | null,
  atLeast = uncertainty ?? 0,
) {
  return { value, unit, uncertainty, atLeast, coverage: 0.95, parts: [] } satisfies Quantity<Unit>;
}

const DEGREE = Math.PI / 180;
const english = (options: ConstructorParameters<typeof MeasureUnits>[0] = {}) =>
  new MeasureUnits({ locale: "en-GB", ...options });
/** Hard spaces as spaces. */
const plain = (text: string) => text.replaceAll("\u00a0", " ");

describe("values in words", () => {
  it.each<[string, ConstructorParameters<typeof MeasureUnits>[0], Quantity, string]>([
    ["metres", {}, known(1523.8472, "m", 0.0321), "1,523.847 m ± 0.032 m"],
    ["a part unknown", {}, known(1523.8472, "m", null, 0.0321), "1,523.847 m at least ± 0.032 m"],
    ["nothing known", {}, known(1523.8472, "m", null, 0), "1,523.847 m ± unknown"],
    ["kilometres", { length: "kilometres" }, known(1523.8472, "m", 0.0321), "1.523847 km ± 0.000032 km"],
    ["a wide band", {}, known(1523.8, "m", 120), "1,520 m ± 120 m"],
    ["inches", { length: "inches" }, known(0.0254, "m", 0.0001), "1.0000 in ± 0.0039 in"],
    ["hectares", { area: "hectares" }, known(12345, "m²", 12), "1.2345 ha ± 0.0012 ha"],
    ["acres", { area: "acres" }, known(4046.8564224, "m²", null, 0), "1.000000 ac ± unknown"],
    ["cubic yards", { volume: "cubicYards" }, known(0.764554857984, "m³", 0.01), "1.000 yd³ ± 0.013 yd³"],
    ["degrees", {}, known(Math.PI / 6, "rad", 1e-4), "30.0000° ± 0.0057°"],
    ["gon", { angle: "gon" }, known(Math.PI / 2, "rad", 1e-4), "100.0000 gon ± 0.0064 gon"],
    ["DMS", { angle: "dms" }, known(46.952405555 * DEGREE, "rad", 1e-6), "46°57′08.66″ ± 0.21″"],
    ["a ratio", {}, known(0.99962, "1", null, 0), "0.999620 ± unknown"],
    ["German", { locale: "de-DE" }, known(-1523.8472, "m", 0.0321), "−1.523,847 m ± 0,032 m"],
    [
      "German words",
      {
        ...{ locale: "de-DE" },
        words: { unknown: "± unbekannt", atLeast: (worth) => `mindestens ${worth}` },
      },
      known(1.5, "m", null, 0.1),
      "1,50 m mindestens ± 0,10 m",
    ],
    ["Hindi digits", { locale: "hi-IN-u-nu-deva" }, known(-1.5, "m", 0.1), "−१.५० m ± ०.१० m"],
  ])("%s", (_, options, quantity, text) => {
    expect(plain(english(options).words(quantity).text)).toBe(text);
  });

  it.each<[ConstructorParameters<typeof MeasureUnits>[0], number, string]>([
    [{ slope: "degrees" }, Math.PI / 4, "45.000°"],
    [{ slope: "percent" }, Math.PI / 4, "100.0 %"],
    [{ slope: "grade" }, Math.atan(0.05), "0.0500"],
    [{ slope: "ratio" }, Math.atan(0.05), "1 : 20.00"],
    [{ slope: "ratio" }, -Math.atan(0.05), "−1 : 20.00"],
    [{ slope: "ratio" }, 0, "1 : ∞"],
    [{ slope: "gon" }, Math.PI / 4, "50.000 gon"],
  ])("slopes in %o", (options, slope, text) => {
    const { value, unit } = english(options).slopeWords(known(slope, "rad", 1e-5 / 2 ** 0.5));
    expect(plain(value + (unit && (unit === "°" ? unit : ` ${unit}`)))).toMatch(
      new RegExp(`^${text.replace(/(\d)( ?[%°]?| gon)$/, "$1\\d*$2")}$`),
    );
  });

  it.each<[ConstructorParameters<typeof MeasureUnits>[0], number, number, string]>([
    [{ slope: "percent" }, Math.PI / 2, 1e-3, "90.000° ± 0.057°"],
    [{ slope: "grade" }, -Math.PI / 2, 1e-3, "−90.000° ± 0.057°"],
    [{ slope: "percent" }, 1.57, 2e-3, "89.95° ± 0.11°"],
    [{ slope: "ratio" }, 1e-5, 3e-3, "0.00° ± 0.17°"],
    [{ slope: "percent" }, 1.5, 1e-3, "1,410 % ± 20 %"],
    [{ slope: "ratio" }, 0.01, 1e-3, "1 : 100 ± 10"],
  ])(
    "slopes that may be vertical, or level, as angles where a ratio tells nothing: %o, %d ± %d",
    (options, slope, band, text) => {
      expect(plain(english(options).slopeWords(known(slope, "rad", band)).text)).toBe(text);
    },
  );

  it.each<[ConstructorParameters<typeof MeasureUnits>[0], number, number, string]>([
    [{}, -1e-9, 1e-4, "0.0000° ± 0.0057°"],
    [{ angle: "gon" }, -1e-9, 1e-4, "0.0000 gon ± 0.0064 gon"],
    [{ angle: "dms" }, -1e-9, 1e-6, "0°00′00.00″ ± 0.21″"],
    [{}, -0.05, 3, "0° ± 170°"],
    [{}, -0.05, 1e-4, "357.1352° ± 0.0057°"],
    [{}, 0.05 - 2 * Math.PI, 1e-4, "2.8648° ± 0.0057°"],
  ])("azimuths of %o that round to a full turn as 0: %d from it ± %d", (options, before, band, text) => {
    const azimuth = known(2 * Math.PI + before, "rad", band);
    expect(plain(english(options).azimuthWords(azimuth).text)).toBe(text);
  });

  it("coordinates with their hemispheres", () => {
    const latitude = known(-46.5 * DEGREE, "rad", 1e-9);
    expect(plain(english().coordinateWords(latitude, "NS").text)).toBe("46.500000000° S ± 0.000000057°");
    expect(plain(english({ coordinates: "dms" }).coordinateWords(latitude, "NS").text)).toBe(
      "46°30′00.00000″S ± 0.00021″",
    );
  });

  it("refuse units and languages that there are not", () => {
    expect(() => new MeasureUnits({ length: "feets" as never })).toThrow(
      /MEASURE_OPTION: .*[dD]id you mean "feet"/,
    );
    expect(() => new MeasureUnits({ locale: "x" })).toThrow("MEASURE_OPTION");
    expect(() => new MeasureUnits({ lenght: "feet" } as never)).toThrow(/[dD]id you mean "length"/);
  });
});

describe("the US survey foot", () => {
  it("is not the foot: a million of them are 60 cm longer", () => {
    const metres = known(1e6 * 0.3048, "m", 0.001);
    expect(plain(english({ length: "feet" }).words(metres).text)).toBe("1,000,000.0000 ft ± 0.0033 ft");
    expect(plain(english({ length: "usSurveyFeet" }).words(metres).text)).toBe(
      "999,998.0000 ftUS ± 0.0033 ftUS",
    );
    const survey = known((1e6 * 1200) / 3937, "m", 0.001);
    expect(plain(english({ length: "usSurveyFeet" }).words(survey).text)).toBe(
      "1,000,000.0000 ftUS ± 0.0033 ftUS",
    );
    expect(
      plain(english({ area: "usSurveyAcres" }).words(known(43_560 * (1200 / 3937) ** 2, "m²", null, 0)).text),
    ).toBe("1.000000 acUS ± unknown");
  });
});

describe("degrees, minutes, seconds", () => {
  it("carry what rounds to sixty", () => {
    expect(dms((10 - 1e-9) * DEGREE, 2, "en")).toBe("10°00′00.00″");
    expect(dms((10 - 1e-7) * DEGREE, 4, "en")).toBe("9°59′59.9996″");
    expect(dms(-1e-12, 2, "en")).toBe("0°00′00.00″");
    expect(dms(-1e-12, 2, "en", "EW")).toBe("0°00′00.00″E");
  });

  it("lead back to the angle, and never have sixty of anything", () => {
    fc.assert(
      fc.property(
        fc.double({ min: -10, max: 10, noNaN: true }),
        fc.integer({ min: 0, max: 8 }),
        (angle, digits) => {
          const text = dms(angle, digits, "en");
          const [, sign, degrees, minutes, seconds] = /^(−?)(\d+)°(\d\d)′(\d\d(?:\.\d+)?)″$/.exec(text)!;
          expect(Number(minutes)).toBeLessThan(60);
          expect(Number(seconds)).toBeLessThan(60);
          const back = Number(degrees) + Number(minutes) / 60 + Number(seconds) / 3600;
          const seen = (sign === "" ? back : -back) * DEGREE;
          expect(Math.abs(seen - angle)).toBeLessThanOrEqual((0.51 * 10 ** -digits * DEGREE) / 3600 + 1e-14);
        },
      ),
    );
  });
});

describe("digits", () => {
  it("are as many as the uncertainty has two of", () => {
    expect([0.0321, 0.0996, 1, 9.96, 99.6, 120, 0, Number.NaN].map(decimalsOf)).toEqual([
      ...[3, 2, 1, 0, -1, -1],
      ...[undefined, undefined],
    ]);
  });

  it("have no minus before a zero", () => {
    expect(numberText(-0.0004, 3, "en")).toBe("0.000");
    expect(numberText(-0.0006, 3, "en")).toBe("−0.001");
    expect(numberText(-1234567, -2, "en")).toBe("−1,234,600");
  });
});
