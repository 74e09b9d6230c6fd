import { afterEach, describe, expect, it } from "vitest";
import { messages as german } from "./catalogues/de.po";
import { i18n } from "./i18n.js";
import { noteWords } from "./note-words.js";

afterEach(() => i18n.activate("en"));

describe("remarks of the libraries", () => {
  it.each([
    ["half a step of the stored integers", "halber Schritt der gespeicherten ganzen Zahlen"],
    ["EGM96 height: drawn without its geoid", "EGM96 height: ohne sein Geoid gezeichnet"],
    ["greatest of 12 residuals, their RMS is 0.034 m", "größter von 12 Restfehlern, ihr RMS ist 0,034 m"],
    [
      "declared as shifted by 0.5 (Vertical_Shift), which is not applied",
      "als um 0,5 verschoben angegeben (Vertical_Shift), was nicht angewendet wird",
    ],
    [
      "declared as depths below an ellipsoid, which other software takes for heights",
      "als Tiefen unter einem Ellipsoid angegeben, was andere Programme als Höhen lesen",
    ],
    [
      "declared above the ellipsoid of WGS 84, and taken as above that of ETRS89, as PROJ does",
      "über dem Ellipsoid von WGS 84 angegeben und wie PROJ als über dem von ETRS89 genommen",
    ],
    [
      "shown as ellipsoidal; if the heights are above sea level, such as LN02 height (EPSG:5728), the points should be 47.3 m higher",
      "als ellipsoidisch gezeigt; falls die Höhen über dem Meer gelten, gehören die Punkte 47,3 m höher (etwa LN02 height (EPSG:5728))",
    ],
    [
      "the header declares 100000 points, the file has room for 120000; the rest is skipped",
      "der Dateikopf nennt 100.000 Punkte, die Datei hat Platz für 120.000; der Rest wird übergangen",
    ],
    [
      "2 extended variable length records are announced, 1 are there",
      "2 Datensätze variabler Länge sind angekündigt, 1 sind da",
    ],
    [
      "the declared bounds do not hold the points (x 0 to 1, y 2.5 to 3, z 4 to 5); the octree's cube is used",
      "die angegebenen Grenzen umfassen die Punkte nicht (x 0 … 1, y 2.5 … 3, z 4 … 5); der Würfel des Octrees wird genommen",
    ],
  ])("%s", (english, other) => {
    expect(noteWords(english)).toEqual({ text: english, translated: true });
    i18n.loadAndActivate({ locale: "de", messages: german });
    expect(noteWords(english)).toEqual({ text: other, translated: true });
  });

  it("stay English where the page does not know them, and say so", () => {
    i18n.loadAndActivate({ locale: "de", messages: german });
    expect(noteWords("Some operation (3)")).toEqual({ text: "Some operation (3)", translated: false });
  });
});
