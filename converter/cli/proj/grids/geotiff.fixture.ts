const BANDS = {
  vertical: ["geoid_undulation"],
  horizontal: ["longitude_offset", "latitude_offset"],
  /** As `horizontal`, counted to the east, which alone `gridshift` takes. */
  eastward: ["longitude_offset", "latitude_offset"],
  geocentric: ["x_translation", "y_translation", "z_translation"],
} as const;
const UNITS = {
  vertical: "metre",
  horizontal: "degree",
  eastward: "arc-second",
  geocentric: "metre",
} as const;
const SCALES = { vertical: 0.01, horizontal: 1e-6, eastward: 3.6e-3, geocentric: 1e-4 } as const;
const TYPES = {
  vertical: "VERTICAL_OFFSET_GEOGRAPHIC_TO_VERTICAL",
  horizontal: "HORIZONTAL_OFFSET",
  eastward: "HORIZONTAL_OFFSET",
  geocentric: "GEOCENTRIC_TRANSLATION",
} as const;

/**
 * A GeoTIFF of heights or shifts in int16 with scale and offset, pixels as areas, one strip: 0.9° by 0.35°.
 *
 * @param corner longitude and latitude of its north-west corner, degrees
 */
export function geoTiff(kind: keyof typeof BANDS, corner = [5, 52.4]): Buffer {
  const descriptions = BANDS[kind];
  const [width, height, bands] = [9, 7, descriptions.length];
  const values = Int16Array.from({ length: width * height * bands }, (_, i) =>
    Math.round(900 * Math.sin(i * 1.7)),
  );
  const items = descriptions.map((description, sample) => {
    const item = (name: string, role: string, value: string | number) =>
      `<Item name="${name}" sample="${sample}" role="${role}">${value}</Item>`;
    return [
      item("DESCRIPTION", "description", description),
      item("UNITTYPE", "unittype", UNITS[kind]),
      item("SCALE", "scale", SCALES[kind]),
      item("OFFSET", "offset", bands === 2 ? 1e-4 : 40),
      kind === "horizontal" && description === "longitude_offset"
        ? item("positive_value", "", "west").replace(' role=""', "")
        : "",
    ].join("");
  });
  const type = TYPES[kind];
  const metadata = `<GDALMetadata><Item name="TYPE">${type}</Item>${items.join("")}</GDALMetadata>\0`;
  const short = (...numbers: number[]) => ({ type: 3, bytes: Buffer.from(Uint16Array.from(numbers).buffer) });
  const double = (...numbers: number[]) => ({
    type: 12,
    bytes: Buffer.from(Float64Array.from(numbers).buffer),
  });
  const long = (number: number) => ({ type: 4, bytes: Buffer.from(Uint32Array.of(number).buffer) });
  const sizes: Record<number, number> = { 2: 1, 3: 2, 4: 4, 12: 8 };
  const data = Buffer.from(values.buffer);
  const tags: [number, { type: number; bytes: Buffer }][] = [
    [256, short(width)],
    [257, short(height)],
    [258, short(...Array(bands).fill(16))],
    [259, short(1)],
    [262, short(1)],
    [273, long(8)],
    [277, short(bands)],
    [278, short(height)],
    [279, long(data.length)],
    [284, short(1)],
    [339, short(...Array(bands).fill(2))],
    [33550, double(0.1, 0.05, 0)],
    [33922, double(0, 0, 0, ...corner, 0)],
    [34735, short(1, 1, 0, 3, 1024, 0, 1, 2, 1025, 0, 1, 1, 2048, 0, 1, 4326)],
    [42112, { type: 2, bytes: Buffer.from(metadata, "latin1") }],
  ];
  const directory = Buffer.alloc(2 + 12 * tags.length + 4);
  const tail: Buffer[] = [];
  let at = 8 + data.length + directory.length;
  directory.writeUInt16LE(tags.length, 0);
  for (const [i, [tag, { type: kindOfTag, bytes }]] of tags.entries()) {
    const entry = 2 + 12 * i;
    directory.writeUInt16LE(tag, entry);
    directory.writeUInt16LE(kindOfTag, entry + 2);
    directory.writeUInt32LE(bytes.length / sizes[kindOfTag], entry + 4);
    if (bytes.length <= 4) bytes.copy(directory, entry + 8);
    else {
      directory.writeUInt32LE(at, entry + 8);
      tail.push(bytes);
      at += bytes.length;
    }
  }
  const head = Buffer.from("II*\0\0\0\0\0", "latin1");
  head.writeUInt32LE(8 + data.length, 4);
  return Buffer.concat([head, data, directory, ...tail]);
}
