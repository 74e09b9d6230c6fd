import { describe, expect, it } from "vitest";
import { cloudAddress, nameClouds, readPageOptions } from "./address.js";
import { PageError } from "./panel/page-error.js";

const page = "http://localhost:8080/globe/?x=1";

/** Code of the error that reading throws. */
function codeOf(read: () => unknown): string {
  try {
    read();
  } catch (thrown) {
    if (thrown instanceof PageError) return thrown.code;
    throw thrown;
  }
  return "none";
}

describe("what is shown", () => {
  it("is the globe, a map beside it or the map alone, in step unless that is not wanted", () => {
    const shown = (query: string) => readPageOptions(`${page}${query}`);
    expect([shown(""), shown("&map=0&link=1")]).toEqual([
      { clouds: [], fly: true },
      { clouds: [], fly: true },
    ]);
    expect(shown("&map=1&link=0")).toMatchObject({ shown: "both", linked: false });
    expect(shown("&map=only")).toEqual({ clouds: [], shown: "map", fly: true });
    expect(codeOf(() => shown("&map=2"))).toBe("PAGE_OPTION");
  });
});

describe("the address of a cloud", () => {
  it.each([
    ["/data/site.copc.laz", "http://localhost:8080/data/site.copc.laz"],
    ["site.copc.laz", "http://localhost:8080/globe/site.copc.laz"],
    ["../data/a b.copc.laz", "http://localhost:8080/data/a%20b.copc.laz"],
    ["https://example.org/s.copc.laz?key=1", "https://example.org/s.copc.laz?key=1"],
    ["//example.org/s.copc.laz", "http://example.org/s.copc.laz"],
    ["  /data/site.copc.laz ", "http://localhost:8080/data/site.copc.laz"],
  ])("%s is taken", (text, address) => {
    expect(cloudAddress(text, page)).toBe(address);
  });

  it.each([
    "javascript:alert(1)",
    " JavaScript:alert(1)",
    "data:application/octet-stream,LASF",
    "blob:http://localhost:8080/1",
    "file:///etc/passwd",
    "ftp://example.org/s.copc.laz",
    "C:\\scans\\site.copc.laz",
    "https://user:secret@example.org/s.copc.laz",
    "http://",
    "",
    "   ",
  ])("%j is refused", (text) => {
    expect(codeOf(() => cloudAddress(text, page))).toBe("PAGE_ADDRESS");
  });

  it("is refused without repeating a password", () => {
    expect(() => cloudAddress("https://user:secret@example.org/s.laz", page)).toThrow(/^(?!.*secret)/);
  });
});

describe("the options of the page", () => {
  const read = (query: string) => readPageOptions(`http://localhost:8080/?${query}`);

  it("are few by default", () => {
    expect(read("")).toEqual({ clouds: [], fly: true });
  });

  it("are read together", () => {
    expect(
      read(
        "cloud=/data/s.copc.laz&budget=300000&size=2.5&color=intensity&fly=0&crs=EPSG:2056&georef=s.georef&other=1",
      ),
    ).toEqual({
      clouds: [
        {
          address: "http://localhost:8080/data/s.copc.laz",
          georef: "http://localhost:8080/s.georef",
          crs: "EPSG:2056",
        },
      ],
      budget: 300_000,
      size: 2.5,
      color: "intensity",
      fly: false,
    });
  });

  it.each([
    "budget=0",
    "budget=1e6",
    "budget=1.5",
    "budget=-1",
    "budget=",
    "budget=999999999999",
    "size=0.5",
    "size=65",
    "size=NaN",
    "size=2px",
    "fly=yes",
  ])("%s is refused", (query) => {
    expect(codeOf(() => read(query))).toBe("PAGE_OPTION");
  });

  it("name several clouds, each with what is said of it", () => {
    const { clouds } = read(
      "crs=EPSG:2056&cloud=/a.laz&cloud=b.laz&vertical=ellipsoidal&georef=b.georef&cloud=/c.laz",
    );
    expect(clouds).toEqual([
      { address: "http://localhost:8080/a.laz", crs: "EPSG:2056" },
      {
        ...{ address: "http://localhost:8080/b.laz", vertical: "ellipsoidal" },
        georef: "http://localhost:8080/b.georef",
      },
      { address: "http://localhost:8080/c.laz" },
    ]);
    const page = new URL("http://localhost:8080/?fly=0&cloud=old.laz&crs=EPSG:1");
    nameClouds(page, [...clouds, { address: "https://example.org/d.laz" }]);
    expect(readPageOptions(page.href)).toEqual({
      clouds: [...clouds, { address: "https://example.org/d.laz" }],
      fly: false,
    });
    expect(page.href).not.toContain("localhost%3A");
  });

  it("name a terrain, relative to the page or not", () => {
    expect(read("terrain=/terrain/").terrain).toBe("http://localhost:8080/terrain/");
    expect(codeOf(() => read("terrain=javascript:alert(1)"))).toBe("PAGE_ADDRESS");
  });

  it("do not open what is no address of a cloud", () => {
    expect(codeOf(() => read("cloud=javascript:alert(1)"))).toBe("PAGE_ADDRESS");
    expect(codeOf(() => read("cloud="))).toBe("PAGE_ADDRESS");
  });
});
