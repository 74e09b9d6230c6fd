import { inflateSync } from "node:zlib";
import { decode } from "fast-png";
import { describe, expect, it } from "vitest";
import { Dots } from "./dots.js";
import { fittingScale, roundStep } from "./layout.js";
import { pdfOf } from "./pdf.js";
import { ProfilePicture } from "./profile-picture.js";
import { svgOf } from "./svg.js";

const WORDS = {
  title: "axis <1>",
  facts: ["scan, 3 points"],
  unit: "m",
  along: "chainage (m)",
  up: "height (m, NAP)",
};

/** A line of 100 m with points at its ends and in the middle, 1 : 500, heights doubled. */
function sheet() {
  const picture = new ProfilePicture({
    ...{ from: 1000, to: 1100, unit: 1, heightUnit: 1, file: "scan" },
    ...{ scale: 500, exaggeration: 2 },
  });
  picture.add(1000, 12, 0, 65535, 0, 0);
  picture.add(1050, 20, 0.5, 0, 65535, 0);
  picture.add(1099.99, 37, 0, 0, 0, 65535);
  return picture.sheet(WORDS, [
    [
      [1000, 12],
      [1050, 20],
    ],
  ]);
}

/** Length of the frame's lower and left side and place of the ground, by the operators of a PDF's page, millimetres. */
function measuredPdf(bytes: Uint8Array) {
  const text = Buffer.from(bytes).toString("latin1");
  const contents = [...text.matchAll(/stream\r?\n/g)].flatMap(({ index, 0: mark }) => {
    try {
      return [inflateSync(Buffer.from(bytes.subarray(index + mark.length))).toString("latin1")];
    } catch {
      return [];
    }
  });
  const page = contents.find((content) => / l\n|\nl\n| l /.test(content) && content.includes(" m\n"))!;
  const paths = page
    .split("S\n")
    .map((path) =>
      [...path.matchAll(/(-?[\d.]+) (-?[\d.]+) [ml]\b/g)].map(([, x, y]) => [
        (Number(x) * 25.4) / 72,
        (Number(y) * 25.4) / 72,
      ]),
    );
  const frame = paths.find((path) => path.length === 5)!;
  const ground = paths[paths.indexOf(frame) + 1];
  return { frame, ground };
}

describe("a picture to scale", () => {
  it("prints true as PDF: 100 m are 200 mm at 1:500, and heights twice that", async () => {
    const bytes = await pdfOf([sheet()], "axis");
    const { frame, ground } = measuredPdf(bytes);
    expect(frame[1][0] - frame[0][0]).toBeCloseTo(200, 6);
    expect(ground[1][0] - ground[0][0]).toBeCloseTo(100, 6);
    expect(ground[1][1] - ground[0][1]).toBeCloseTo(8 * 4, 6);
    expect(ground[0][0]).toBeCloseTo(frame[0][0], 6);
    expect(Buffer.from(bytes).equals(Buffer.from(await pdfOf([sheet()], "axis")))).toBe(true);
  });

  it("prints true as SVG, in millimetres, with the dots where the line is", () => {
    const { height, images } = sheet();
    const svg = svgOf(sheet());
    expect(svg).toContain(`width="297mm" height="210mm" viewBox="0 0 297 210"`);
    const [x, y, width, tall] = /<image x="([\d.]+)" y="([\d.]+)" width="([\d.]+)" height="([\d.]+)"/
      .exec(svg)!
      .slice(1)
      .map(Number);
    expect(width).toBeCloseTo(200, 0);
    expect(tall).toBeCloseTo(25 * 4, 0);
    expect(y).toBeCloseTo(height - images[0].y - images[0].height, 3);
    const ground = /points="([^"]+)" fill="none" stroke="#b22222"/
      .exec(svg)![1]
      .split(" ")
      .map((pair) => pair.split(",").map(Number));
    const png = decode(Buffer.from(/base64,([^"]+)/.exec(svg)![1], "base64"));
    const dotAt = ([left, down]: number[]) => {
      const column = Math.floor(((left - x) / width) * png.width);
      const row = Math.floor(((down - y) / tall) * png.height);
      return [...png.data.slice(4 * (row * png.width + column), 4 * (row * png.width + column) + 4)];
    };
    const shades = [-1, 0].map((up) => dotAt([ground[0][0] + 0.01, ground[0][1] + up * 0.1]));
    expect(shades).toContainEqual([255, 0, 0, 255]);
    expect(svg).toContain("<title>axis &lt;1&gt;</title>");
    expect(svg).toContain("lengths 1:500, heights 1:250");
  });

  it("shows of several points of a dot the one nearest to the line, and colours of 8 bits as they are", () => {
    const dots = new Dots(2, "scan");
    dots.add(0.5, -3, 2, 10, 20, 30);
    dots.add(0.5, -2.5, 1, 40, 50, 60);
    dots.add(0.5, -3, 3, 70, 80, 90);
    dots.add(9, 70, 0, 1, 2, 3);
    expect(dots.rows).toEqual([-3, 70]);
    const { data, columns, rows } = dots.pixels(-3, 70);
    expect([columns, rows]).toEqual([2, 74]);
    expect([...data.subarray(-8)]).toEqual([40, 50, 60, 255, 0, 0, 0, 0]);
    expect([...data.subarray(0, 8)]).toEqual([0, 0, 0, 0, 1, 2, 3, 255]);
  });

  it("refuses to be larger than memory", () => {
    const dots = new Dots(20_000, "scan");
    expect(() => {
      for (let row = 0; row < 1e6; row += 64) dots.add(0, row, 0, 0, 0, 0);
    }).toThrow(expect.objectContaining({ code: "EXPORT_PICTURE" }));
    // Two dots far apart: what lies between them takes room too.
    const apart = new Dots(10, "scan");
    apart.add(0, 0, 0, 0, 0, 0);
    expect(() => apart.add(0, 1e9, 0, 0, 0, 0)).toThrow(expect.objectContaining({ code: "EXPORT_PICTURE" }));
  });

  it("has the largest round scale that fits onto A3", () => {
    expect([10, 38.8, 38.9, 100, 5000].map(fittingScale)).toEqual([50, 100, 200, 500, 20000]);
    expect([0.3, 1, 1.01, 7, 0.02].map(roundStep)).toEqual([0.5, 1, 2, 10, 0.02]);
  });

  it.each([
    [{ most: 5.6 }, "lengths 1:250, heights 1:50"],
    [{ most: 5 }, "lengths 1:250, heights 1:50"],
    [{ most: 1 }, "1:250"],
    [{ most: 0.7 }, "lengths 1:250, heights 1:500"],
    [5.6, "lengths 1:250, heights 1:44.6429"],
  ])("stretches heights by %j in round scales where it may choose", (exaggeration, words) => {
    const picture = new ProfilePicture({
      ...{ from: 0, to: 90, unit: 1, heightUnit: 1, file: "scan", exaggeration },
    });
    picture.add(0, 0, 0, 0, 0, 0);
    expect(picture.sheet(WORDS).texts.map(({ text }) => text)).toContain(words);
  });

  it("has stations at its axis where they are counted anew", () => {
    const marks = (stationOf: (chainage: number) => number) =>
      new ProfilePicture({ from: 1000, to: 1100, unit: 1, heightUnit: 1, file: "scan", scale: 500 })
        .sheet({ ...WORDS, stationOf })
        .texts.flatMap(({ text }) => text.match(/^\d+\+[\d.]+$/) ?? []);
    expect(marks((chainage) => (chainage < 1050 ? chainage : chainage + 950))).toEqual(
      [1000, 1010, 1020, 1030, 1040, 2000, 2010, 2020, 2030, 2040, 2050].map(
        (station) => `${Math.floor(station / 1000)}+${String(station % 1000).padStart(3, "0")}`,
      ),
    );
    expect(marks((chainage) => chainage + 0.25).slice(0, 2)).toEqual(["1+000.25", "1+010.25"]);
  });

  it.each([{ scale: 0 }, { scale: Number.NaN }, { exaggeration: -1 }, { exaggeration: { most: 0 } }])(
    "is refused with %j",
    (given) => {
      const place = { from: 0, to: 1, unit: 1, heightUnit: 1, file: "scan" };
      expect(() => new ProfilePicture({ ...place, ...given })).toThrow(RangeError);
    },
  );
});
