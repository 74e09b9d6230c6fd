import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { Corridor } from "../profile/corridor.js";
import { inUnit, TOLERANCE } from "./alignment.js";
import { readDxfLine } from "./read-dxf.js";
import { readLandXml } from "./read-landxml.js";
import { StationEquations } from "./station-equations.js";

const refused = (message: RegExp) =>
  expect.objectContaining({ code: "FORMAT_ALIGNMENT", message: expect.stringMatching(message) });

const landXml = (parts: string, attributes = 'name="A" staStart="1000"', more = "") =>
  `<?xml version="1.0"?><LandXML xmlns="http://www.landxml.org/schema/LandXML-1.2" version="1.2">
<Units><Metric linearUnit="meter" areaUnit="squareMeter"/></Units>
<CgPoints><CgPoint name="7">20 30</CgPoint></CgPoints>
<Alignments><Alignment ${attributes}><CoordGeom>${parts}</CoordGeom>${more}</Alignment></Alignments></LandXML>`;

/** The angle between x to y of the x axis and a place, and its length by the power series of Fresnel's integrals. */
function clothoidEnd(length: number, curvature: number): [number, number] {
  const turn = (length * curvature) / 2;
  let [x, y, term] = [0, 0, 1];
  for (let n = 0; n < 30; n++) {
    const part = (length * term) / (2 * n + 1);
    if (n % 2 === 0) x += n % 4 === 0 ? part : -part;
    else y += n % 4 === 1 ? part : -part;
    term *= turn / (n + 1);
  }
  return [x, y];
}

describe("an alignment of LandXML", () => {
  it("has lines, arcs and clothoids by their true lengths, northing before easting", () => {
    // 100 m east, a clothoid of 50 m into a left arc of 200 m radius, and the quarter of it.
    const [ex, ey] = clothoidEnd(50, 1 / 200);
    const turn = 50 / 400;
    const corner = 100 + ex - ey / Math.tan(turn);
    const [sx, sy] = [100 + ex, ey];
    const [cx, cy] = [sx - 200 * Math.sin(turn), sy + 200 * Math.cos(turn)];
    const end = [cx + 200 * Math.sin(turn + Math.PI / 2), cy - 200 * Math.cos(turn + Math.PI / 2)];
    const text = landXml(`<Line><Start>0 0</Start><End>0 100</End></Line>
<Spiral length="50" radiusStart="INF" radiusEnd="200" rot="ccw" spiType="clothoid"><Start>0 100</Start><PI>0 ${corner}</PI><End>${sy} ${sx}</End></Spiral>
<Curve rot="ccw"><Start>${sy} ${sx}</Start><Center>${cy} ${cx}</Center><End>${end[1]} ${end[0]}</End></Curve>`);
    const { vertices, lengths, start, unit, name } = readLandXml(text, undefined, "axis.xml");
    expect({ start, unit, name }).toEqual({ start: 1000, unit: 1, name: "A" });
    expect(lengths.reduce((sum, length) => sum + length, 0)).toBeCloseTo(150 + 100 * Math.PI, 8);
    let along = 0;
    for (const [index, length] of lengths.entries()) {
      const [a, b] = [vertices[index], vertices[index + 1]];
      const chord = Math.hypot(b[0] - a[0], b[1] - a[1]);
      expect(chord).toBeLessThanOrEqual(length + 1e-9);
      // What a chord lacks of its arc bounds its sagitta: s² ≈ 3/8 · c · (arc - c).
      expect(Math.sqrt((3 / 8) * chord * Math.max(0, length - chord))).toBeLessThan(1.05 * TOLERANCE + 1e-7);
      along += length;
      if (along > 150 + 1e-6) expect(Math.hypot(b[0] - cx, b[1] - cy)).toBeCloseTo(200, 6);
      else if (along > 100 + 1e-6) {
        const [x, y] = clothoidEnd(along - 100, (along - 100) / 50 / 200);
        expect(b[0]).toBeCloseTo(100 + x, 7);
        expect(b[1]).toBeCloseTo(y, 7);
      }
    }
    expect(vertices[vertices.length - 1]).toEqual(end);
  });

  it("knows the direction of its curves everywhere, which its chords do not have", () => {
    // A clothoid of 40 m into a right arc of 50 m radius, of 0.6 radians.
    const [ex, ey] = clothoidEnd(40, 1 / 50);
    const [sx, sy, turned] = [ex, -ey, -0.4];
    const [cx, cy] = [sx + 50 * Math.sin(turned), sy - 50 * Math.cos(turned)];
    const end = [cx - 50 * Math.sin(turned - 0.6), cy + 50 * Math.cos(turned - 0.6)];
    const text = landXml(`<Line><Start>0 -10</Start><End>0 0</End></Line>
<Spiral length="40" radiusStart="INF" radiusEnd="50" rot="cw" spiType="clothoid"><Start>0 0</Start><PI>0 ${ex - ey / Math.tan(0.4)}</PI><End>${sy} ${sx}</End></Spiral>
<Curve rot="cw"><Start>${sy} ${sx}</Start><Center>${cy} ${cx}</Center><End>${end[1]} ${end[0]}</End></Curve>`);
    const { vertices, ...course } = readLandXml(text, undefined, "axis.xml");
    expect(course.headings[0]).toBeUndefined();
    const line = new Corridor(vertices, 1, { ...course, start: 0 });
    for (let along = 0; along < 80; along += 0.37) {
      const s = along - 10;
      const heading = s < 0 ? 0 : s < 40 ? -(s * s) / (2 * 40 * 50) : turned - (s - 40) / 50;
      const [dx, dy] = line.at(along)!.direction;
      // 5 µm to the side at a metre for 100 m of it: half a chord would be off by 2e-3.
      expect(Math.abs(Math.atan2(dy, dx) - heading)).toBeLessThan(5e-6);
    }
  });

  it("has no circle where an arc has no length, and one where it says so", () => {
    const arc = (end: string, more = "") => `<Line><Start>0 0</Start><End>0 20.001</End></Line>
<Curve rot="ccw" ${more}><Start>0 20</Start><Center>50 20</Center><End>${end}</End></Curve>
<Line><Start>0 20</Start><End>0 40</End></Line>`;
    const lengthOf = (parts: string) =>
      readLandXml(landXml(parts), undefined, "axis.xml").lengths.reduce((sum, length) => sum + length, 0);
    expect(lengthOf(arc("0 20"))).toBe(40);
    expect(lengthOf(arc("0 19.9999999"))).toBe(40);
    expect(lengthOf(arc("0 20", `length="${100 * Math.PI}"`))).toBeCloseTo(40 + 100 * Math.PI, 2);
    const exact = arc("0 20", `length="${100 * Math.PI}"`).replace("20.001", "20");
    expect(lengthOf(exact)).toBeCloseTo(40 + 100 * Math.PI, 9);
    const spiral =
      '<Spiral length="0" spiType="clothoid"><Start>0 20</Start><PI>0 20</PI><End>0 20</End></Spiral>';
    expect(lengthOf(`<Line><Start>0 0</Start><End>0 20</End></Line>${spiral}`)).toBe(20);
  });

  it("takes right turns, references to points, irregular lines and station equations", () => {
    const text = landXml(
      `<Line><Start>0 10</Start><End pntRef="7"/></Line>
<Curve rot="cw"><Start>20 30</Start><Center>20 40</Center><End>20 50</End></Curve>
<IrregularLine><Start>20 50</Start><End>0 60</End><PntList2D>20 50 10 55 0 60</PntList2D></IrregularLine>`,
      'name="B"',
      '<StaEquation staInternal="50" staAhead="200"/><StaEquation staInternal="80" staAhead="20" staIncrement="decreasing"/>',
    );
    const { vertices, lengths, equations } = readLandXml(text, "B", "axis.xml");
    expect(vertices.slice(0, 2)).toEqual([
      [10, 0],
      [30, 20],
    ]);
    expect(vertices.slice(-3)).toEqual([
      [50, 20],
      [55, 10],
      [60, 0],
    ]);
    // Clockwise from the west of the centre: over the north.
    expect(Math.max(...vertices.map(([, y]) => y))).toBeCloseTo(30, 3);
    expect(lengths.reduce((sum, length) => sum + length, 0)).toBeCloseTo(
      20 * Math.SQRT2 + 10 * Math.PI + 2 * Math.hypot(5, 10),
      6,
    );
    expect(equations).toEqual([
      { internal: 50, ahead: 200, increment: "increasing" },
      { internal: 80, ahead: 20, increment: "decreasing" },
    ]);
  });

  it.each([
    ["<a><b></a>", /well-formed/],
    [landXml(""), /it has no line/],
    [landXml("<Line><Start>0 0</Start></Line>"), /a Line of it has no End/],
    [
      landXml("<Line><Start>0 0</Start><End>0 1</End></Line><Line><Start>5 5</Start><End>6 6</End></Line>"),
      /begins away/,
    ],
    [
      landXml('<Spiral spiType="bloss" length="1"><Start>0 0</Start><PI>0 1</PI><End>0 2</End></Spiral>'),
      /type bloss/,
    ],
    [
      landXml(
        '<Spiral length="50" radiusStart="INF" radiusEnd="20" rot="cw"><Start>0 0</Start><PI>0 30</PI><End>0 50</End></Spiral>',
      ),
      /away from its End/,
    ],
    [
      landXml('<Curve rot="cw"><Start>0 0</Start><Center>0 10</Center><End>0 30</End></Curve>'),
      /other distances/,
    ],
    [landXml("<Chain>1 2</Chain>"), /a Chain of it has no Start/],
    [landXml("", 'name="A" staStart="1+000"'), /staStart is no number: 1\+000/],
    [landXml("").replace("meter", "ell"), /unit of length is not known: ell/],
    [
      landXml("", undefined, '<StaEquation staInternal="5" staAhead="1"/>'.repeat(2)),
      /two station equations at 5/,
    ],
    [landXml("", undefined, '<StaEquation staInternal="" staAhead="1"/>'), /equation of it has no numbers/],
    [
      landXml("<Curve><Start>0 0</Start><Center>0 10</Center><End>0 20</End></Curve>"),
      /Curve of it turns neither cw nor ccw/,
    ],
    [
      landXml(
        "<IrregularLine><Start>0 0</Start><End>0 9</End><PntList2D>0 0 x 5</PntList2D></IrregularLine>",
      ),
      /place without numbers/,
    ],
    [
      landXml("<Line><Start>0 0</Start><End>0 1</End></Line>").replace(/<Alignment .*<\/Alignment>/s, "$&$&"),
      /2 lines.*give each line a name/is,
    ],
  ])("is refused where %s", (text, message) => {
    expect(() => readLandXml(text, undefined, "axis.xml")).toThrow(refused(message));
  });
});

it("comes into another unit whole: places, lengths, start, equations", () => {
  const line = "<Line><Start>0 0</Start><End>0 10</End></Line>";
  const equation = '<StaEquation staInternal="1004" staAhead="2000" staIncrement="decreasing"/>';
  const metres = readLandXml(landXml(line, undefined, equation), undefined, "axis.xml");
  expect(inUnit(metres, 1)).toBe(metres);
  expect(inUnit(metres, 0.5)).toMatchObject({
    ...{
      unit: 0.5,
      vertices: [
        [0, 0],
        [20, 0],
      ],
      lengths: [20],
      start: 2000,
    },
    equations: [{ internal: 2008, ahead: 4000, increment: "decreasing" }],
  });
  const untold = { ...metres, unit: undefined };
  expect(inUnit(untold, 0.3048)).toBe(untold);
});

const dxf = (...entities: string[]) => `0\nSECTION\n2\nENTITIES\n${entities.join("")}0\nENDSEC\n0\nEOF\n`;
const light = (layer: string, ...vertices: number[][]) =>
  `0\nLWPOLYLINE\n8\n${layer}\n90\n${vertices.length}\n70\n0\n${vertices.map(([x, y, bulge]) => `10\n${x}\n20\n${y}\n${bulge ? `42\n${bulge}\n` : ""}`).join("")}`;

describe("a polyline of DXF", () => {
  it("has vertices and arcs by their bulges, left of the chord where these are positive", () => {
    const half = light("axis", [0, 0, 1], [10, 0, -1], [20, 0, 0], [20, 5]);
    const { vertices, lengths, name } = readDxfLine(dxf(half), undefined, "axis.dxf");
    expect(name).toBe("axis");
    expect(lengths.reduce((sum, length) => sum + length, 0)).toBeCloseTo(10 * Math.PI + 5, 9);
    // A half circle counter-clockwise from (0, 0) to (10, 0) runs below the chord.
    expect(Math.min(...vertices.map(([, y]) => y))).toBeCloseTo(-5, 3);
    expect(Math.max(...vertices.filter(([x]) => x < 20).map(([, y]) => y))).toBeCloseTo(5, 3);
    for (const [x, y] of vertices.filter(([x]) => x < 10)) expect(Math.hypot(x - 5, y)).toBeCloseTo(5, 9);
    // Downwards at first, and again where the second half circle ends; the last piece is straight.
    const { headings } = readDxfLine(dxf(half), undefined, "axis.dxf");
    expect(Math.sin(headings[0]![0])).toBeCloseTo(-1, 12);
    expect(Math.sin(headings.at(-2)![1])).toBeCloseTo(-1, 12);
    expect(headings.at(-1)).toBeUndefined();
  });

  it("is found by its layer, in the old form too, and closed where it says so", () => {
    const old =
      "0\nPOLYLINE\n8\nold\n66\n1\n70\n1\n10\n0\n20\n0\n0\nVERTEX\n8\nold\n10\n1\n20\n2\n0\nVERTEX\n8\nold\n10\n3\n20\n2\n0\nVERTEX\n8\nold\n10\n3\n20\n7\n0\nSEQEND\n8\nold\n";
    const text = dxf(light("a", [0, 0], [1, 1]), "0\nLINE\n8\nx\n10\n9\n20\n9\n", old);
    expect(readDxfLine(text, "old", "axis.dxf").vertices).toEqual([
      [1, 2],
      [3, 2],
      [3, 7],
      [1, 2],
    ]);
    expect(readDxfLine(text.replaceAll("\n", "\r\n"), "a", "axis.dxf").lengths).toEqual([Math.SQRT2]);
    expect(() => readDxfLine(text, undefined, "axis.dxf")).toThrow(
      refused(/it has 2 lines.*name one of "a", "old"/is),
    );
    expect(() => readDxfLine(text, "b", "axis.dxf")).toThrow(refused(/no line of the name "b"/));
    expect(() => readDxfLine("AutoCAD Binary DXF\r\n", undefined, "axis.dxf")).toThrow(refused(/binary/));
    expect(() => readDxfLine(dxf(light("a", [0, 0], [Number.NaN, 1])), undefined, "axis.dxf")).toThrow(
      refused(/no place/),
    );
  });

  it("is what is drawn in model space: no control points, meshes, or lines of sheets", () => {
    const vertex = (x: number, y: number, flags: number) =>
      `0\nVERTEX\n8\na\n10\n${x}\n20\n${y}\n70\n${flags}\n`;
    const old = (flags: number, ...vertices: string[]) =>
      `0\nPOLYLINE\n8\na\n66\n1\n70\n${flags}\n${vertices.join("")}0\nSEQEND\n8\na\n`;
    // A spline of two points that are drawn, and its frame.
    const spline = old(4, vertex(0, 0, 16), vertex(1, 9, 16), vertex(0, 0, 8), vertex(3, 4, 8));
    const meshes = [
      old(16, vertex(0, 0, 64), vertex(5, 5, 64)),
      old(64, vertex(0, 0, 192), vertex(1, 1, 192)),
    ];
    const sheet = light("a", [0, 0], [9, 9]).replace("8\na\n", "67\n1\n8\na\n");
    const { vertices, lengths } = readDxfLine(dxf(...meshes, spline, sheet), undefined, "axis.dxf");
    expect(vertices).toEqual([
      [0, 0],
      [3, 4],
    ]);
    expect(lengths).toEqual([5]);
    expect(() => readDxfLine(dxf("0\nLINE\n8\na\n10\n0\n20\n0\n"), undefined, "axis.dxf")).toThrow(
      refused(/no line.*lines, arcs and splines have to be joined/is),
    );
  });

  it("has the unit of the header, unless that is one of templates", () => {
    const header = (unit: number) =>
      `0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1024\n9\n$INSUNITS\n70\n     ${unit}\n0\nENDSEC\n`;
    const unitOf = (front: string) =>
      readDxfLine(front + dxf(light("a", [0, 0], [1, 1])), undefined, "axis.dxf").unit;
    expect([2, 6, 21].map((unit) => unitOf(header(unit)))).toEqual([0.3048, 1, 1200 / 3937]);
    expect([0, 1, 4].map((unit) => unitOf(header(unit)))).toEqual([undefined, undefined, undefined]);
    expect(unitOf("")).toBeUndefined();
  });

  it("lies in the world where its own plane is seen from below, and is refused in a tilted one", () => {
    const seen = (...normal: number[]) =>
      dxf(
        light("a", [-20, 0, 1], [-10, 0]) +
          normal.map((part, axis) => `${210 + 10 * axis}\n${part}\n`).join(""),
      );
    const { vertices } = readDxfLine(seen(0, 0, -1), undefined, "axis.dxf");
    expect([vertices[0], vertices[vertices.length - 1]]).toEqual([
      [20, 0],
      [10, 0],
    ]);
    // A half circle to the left, seen from below: to the right in the world, below the chord in both.
    expect(Math.min(...vertices.map(([, y]) => y))).toBeCloseTo(-5, 3);
    const above = readDxfLine(seen(0, 0, 1), undefined, "axis.dxf").vertices;
    expect(above).toHaveLength(vertices.length);
    for (const [index, [x, y]] of above.entries())
      expect(Math.hypot(x + vertices[index][0], y - vertices[index][1])).toBeLessThan(1e-12);
    const space = "0\nPOLYLINE\n8\na\n70\n8\n210\n0\n220\n0\n230\n-1\n";
    const places = [1, 2].map((x) => `0\nVERTEX\n8\na\n10\n${x}\n20\n0\n70\n32\n`).join("");
    expect(readDxfLine(dxf(`${space}${places}`), undefined, "axis.dxf").vertices[0]).toEqual([1, 0]);
    expect(() => readDxfLine(seen(0, 1, 1), undefined, "axis.dxf")).toThrow(refused(/tilted plane/));
  });
});

describe("station equations", () => {
  it("count anew from their places on, and lead back to every chainage that has a station", () => {
    const equations = new StationEquations([
      { internal: 100, ahead: 500 },
      { internal: 200, ahead: 90, increment: "decreasing" },
    ]);
    expect(equations.stationOf(99)).toEqual({ station: 99, stretch: 0 });
    expect(equations.stationOf(100)).toEqual({ station: 500, stretch: 1 });
    expect(equations.stationOf(210)).toEqual({ station: 80, stretch: 2 });
    expect(equations.chainagesOf(80)).toEqual([80, 210]);
    expect(equations.chainagesOf(300)).toEqual([]);
    expect(
      () =>
        new StationEquations([
          { internal: 1, ahead: 2 },
          { internal: 1, ahead: 3 },
        ]),
    ).toThrow(RangeError);
    const whole = fc.array(
      fc.record({ internal: fc.nat(1000), ahead: fc.integer({ min: -500, max: 2000 }) }),
      { maxLength: 5 },
    );
    fc.assert(
      fc.property(whole, fc.integer({ min: -100, max: 1200 }), (all, chainage) => {
        fc.pre(new Set(all.map(({ internal }) => internal)).size === all.length);
        const some = new StationEquations(all);
        expect(some.chainagesOf(some.stationOf(chainage).station)).toContain(chainage);
      }),
    );
  });
});
