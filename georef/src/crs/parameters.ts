import type { ParameterId } from "./model.js";

/** What a parameter is measured in. */
export type Quantity = "angle" | "length" | "ratio";

interface Row {
  readonly id: ParameterId;
  readonly quantity: Quantity;
  /** EPSG parameter codes, WKT2 and PROJJSON. */
  readonly codes: readonly number[];
  /** Names of WKT2 (EPSG) and of the dialects of WKT1, letters only. */
  readonly names: readonly string[];
}

const ROWS: readonly Row[] = [
  {
    ...{ id: "latitudeOrigin", quantity: "angle", codes: [8801, 8811, 8821] },
    names: [
      ...["latitudeoforigin", "latitudeofnaturalorigin", "latitudeoffalseorigin", "centralparallel"],
      ...["latitudeofcenter", "latitudeofprojectioncentre", "latitudeofprojectioncenter"],
    ],
  },
  {
    ...{ id: "longitudeOrigin", quantity: "angle", codes: [8802, 8812, 8822, 8833] },
    names: [
      ...["centralmeridian", "longitudeofnaturalorigin", "longitudeoffalseorigin", "longitudeoforigin"],
      ...["longitudeofcenter", "longitudeofprojectioncentre", "longitudeofprojectioncenter"],
      "straightverticallongitudefrompole",
    ],
  },
  {
    ...{ id: "standardParallel1", quantity: "angle", codes: [8823] },
    names: ["standardparallel1", "latitudeof1ststandardparallel"],
  },
  {
    ...{ id: "standardParallel2", quantity: "angle", codes: [8824] },
    names: ["standardparallel2", "latitudeof2ndstandardparallel"],
  },
  { id: "standardParallel", quantity: "angle", codes: [8832], names: ["latitudeofstandardparallel"] },
  {
    ...{ id: "scale", quantity: "ratio", codes: [8805, 8815, 8819] },
    names: [
      ...["scalefactor", "scalefactoratnaturalorigin", "scalefactoratprojectioncentre"],
      "scalefactoronpseudostandardparallel",
    ],
  },
  {
    ...{ id: "falseEasting", quantity: "length", codes: [8806, 8816, 8826] },
    names: ["falseeasting", "eastingatfalseorigin", "eastingatprojectioncentre"],
  },
  {
    ...{ id: "falseNorthing", quantity: "length", codes: [8807, 8817, 8827] },
    names: ["falsenorthing", "northingatfalseorigin", "northingatprojectioncentre"],
  },
  {
    ...{ id: "azimuth", quantity: "angle", codes: [8813, 1036] },
    names: ["azimuth", "azimuthatprojectioncentre", "azimuthofinitialline", "colatitudeofconeaxis"],
  },
  {
    ...{ id: "gridAngle", quantity: "angle", codes: [8814] },
    names: ["rectifiedgridangle", "anglefromrectifiedtoskewgrid"],
  },
  {
    ...{ id: "pseudoParallel", quantity: "angle", codes: [8818] },
    names: ["pseudostandardparallel1", "latitudeofpseudostandardparallel"],
  },
  { id: "xScale", quantity: "ratio", codes: [], names: ["xscale"] },
  { id: "yScale", quantity: "ratio", codes: [], names: ["yscale"] },
  { id: "planeRotation", quantity: "angle", codes: [], names: ["xyplanerotation"] },
  { id: "auxiliarySphere", quantity: "ratio", codes: [], names: ["auxiliaryspheretype"] },
];

/** Letters and digits of a name, lower case: what the spellings of one name share. */
export function letters(name: string): string {
  return name.toLowerCase().replace(/[^a-z0-9]/g, "");
}

/** What a parameter means, by its EPSG code if it has one, else by name. */
export function findParameter(name: string, code?: number): Pick<Row, "id" | "quantity"> | undefined {
  const plain = letters(name);
  return (
    ROWS.find((row) => code !== undefined && row.codes.includes(code)) ??
    ROWS.find((row) => row.names.includes(plain))
  );
}
