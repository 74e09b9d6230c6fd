/** Metres per unit of PROJ's linear units (PROJ, units.cpp). */
const LINEAR: ReadonlyMap<string, number> = new Map(
  Object.entries({
    m: 1,
    km: 1000,
    dm: 0.1,
    cm: 0.01,
    mm: 0.001,
    kmi: 1852,
    in: 0.0254,
    ft: 0.3048,
    yd: 0.9144,
    mi: 1609.344,
    fath: 1.8288,
    ch: 20.1168,
    link: 0.201168,
    "us-in": 100 / 3937,
    "us-ft": 1200 / 3937,
    "us-yd": 3600 / 3937,
    "us-ch": 79200 / 3937,
    "us-mi": 6336000 / 3937,
    "ind-yd": 0.91439523,
    "ind-ft": 0.30479841,
    "ind-ch": 20.11669506,
  }),
);

/** Radians per unit of PROJ's angular units. */
const ANGULAR: ReadonlyMap<string, number> = new Map([
  ["rad", 1],
  ["deg", Math.PI / 180],
  ["grad", Math.PI / 200],
]);

/** Metres per unit, of a name or a factor; nothing for anything else. */
export function linearUnit(text: string): number | undefined {
  return LINEAR.get(text) ?? factor(text);
}

/** Radians per unit, of a name; a bare factor is taken for a linear unit. */
export function angularUnit(text: string): number | undefined {
  return ANGULAR.get(text);
}

function factor(text: string): number | undefined {
  const value = Number(text);
  return text !== "" && Number.isFinite(value) && value > 0 ? value : undefined;
}
