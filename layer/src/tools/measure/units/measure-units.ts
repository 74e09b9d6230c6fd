import { MeasureError } from "../../../errors/index.js";
import { type Kinds, kindOf, oneOf, some } from "../../../options/index.js";
import type { Quantity, SiUnit } from "../worth/quantity.js";
import { dms } from "./dms.js";
import { decimalsOf, numberText } from "./numbers.js";
import {
  ANGLES,
  type AngleUnit,
  AREAS,
  type AreaUnit,
  LENGTHS,
  type LengthUnit,
  type SlopeUnit,
  VOLUMES,
  type VolumeUnit,
} from "./tables.js";

/** In which units values are written. */
export interface MeasureUnitsOptions {
  /** Default: `metres`. */
  readonly length?: LengthUnit | undefined;
  /** Default: `squareMetres`. */
  readonly area?: AreaUnit | undefined;
  /** Default: `cubicMetres`. */
  readonly volume?: VolumeUnit | undefined;
  /** Azimuths and angles between lines. Default: `degrees`. */
  readonly angle?: AngleUnit | undefined;
  /** Default: `degrees`. */
  readonly slope?: SlopeUnit | undefined;
  /** Longitudes and latitudes. Default: `degrees`. */
  readonly coordinates?: "degrees" | "dms" | undefined;
  /** BCP 47. Default: the reader's. */
  readonly locale?: string | undefined;
  /** What is said of uncertainties, in the language of the application. Default: English. */
  readonly words?: WorthWords | undefined;
}

/** Words for uncertainties. */
export interface WorthWords {
  /** Where all of it is unknown: `± unknown`. */
  readonly unknown: string;
  /** Where a part is unknown. @param worth what the known parts come to, as `± 0.032 m` */
  readonly atLeast: (worth: string) => string;
}

const ENGLISH: WorthWords = { unknown: "± unknown", atLeast: (worth) => `at least ${worth}` };

const names = <Name extends string>(table: Readonly<Record<Name, unknown>>) => Object.keys(table) as Name[];

const KINDS: Kinds<MeasureUnitsOptions> = {
  length: oneOf(...names(LENGTHS)),
  area: oneOf(...names(AREAS)),
  volume: oneOf(...names(VOLUMES)),
  angle: oneOf(...names(ANGLES), "dms"),
  slope: oneOf(...names(ANGLES), "dms", "percent", "grade", "ratio"),
  coordinates: oneOf("degrees", "dms"),
  words: kindOf("{ unknown, atLeast }, a text and a function", isWords),
  locale: kindOf("a BCP 47 language tag, as en-GB", (given): given is string => isLocale(given)),
};

/** A value and its uncertainty as text. */
export interface Words {
  /** `1,523.847` */
  readonly value: string;
  /** `m` */
  readonly unit: string;
  /** `± 0.032 m`, `at least ± 0.001 m` where a part is unknown, `± unknown` where all parts are. */
  readonly worth: string;
  /** `1,523.847 m` */
  readonly main: string;
  /** All of it: `1,523.847 m ± 0.032 m`. */
  readonly text: string;
}

/** Writes measured values in units and a language. Values are never rounded but in text. */
export class MeasureUnits {
  readonly length: LengthUnit;
  readonly area: AreaUnit;
  readonly volume: VolumeUnit;
  readonly angle: AngleUnit;
  readonly slope: SlopeUnit;
  readonly coordinates: "degrees" | "dms";
  readonly locale: string | undefined;
  readonly #words: WorthWords;

  /** @throws MeasureError MEASURE_OPTION for a unit or a language that there is not */
  constructor(given: MeasureUnitsOptions = {}) {
    const options = some(KINDS).read(given, {
      name: "units",
      context: undefined,
      refuse: (cause, fix) => {
        throw new MeasureError({ code: "MEASURE_OPTION", file: "MeasureUnits", cause, fix });
      },
    });
    this.length = options.length ?? "metres";
    this.area = options.area ?? "squareMetres";
    this.volume = options.volume ?? "cubicMetres";
    this.angle = options.angle ?? "degrees";
    this.slope = options.slope ?? "degrees";
    this.coordinates = options.coordinates ?? "degrees";
    this.locale = options.locale;
    this.#words = options.words ?? ENGLISH;
  }

  /** A length, area, volume or ratio; an angle in the units of angles. */
  words(quantity: Quantity): Words {
    if (quantity.unit === "rad") return this.#angleWords(quantity, this.angle);
    const { symbol, size } = this.#entry(quantity.unit);
    return this.#plain(quantity, symbol, size);
  }

  /** A direction from 0 to a full turn, in the units of angles; what rounds to the full turn is 0. */
  azimuthWords(quantity: Quantity<"rad">): Words {
    const words = this.words(quantity);
    const turn = this.words({ ...quantity, value: 2 * Math.PI });
    return words.value === turn.value ? this.words({ ...quantity, value: 0 }) : words;
  }

  /** An angle against the level, in the units of slopes. */
  slopeWords(quantity: Quantity<"rad">): Words {
    const { slope } = this;
    if (slope !== "percent" && slope !== "grade" && slope !== "ratio")
      return this.#angleWords(quantity, slope);
    const { value, atLeast } = quantity;
    // What may be vertical has no tangent, and what may be level is one in no number: as an angle they are told apart.
    const least = slope === "ratio" ? Math.abs(value) : Math.PI / 2 - Math.abs(value);
    if (least <= Math.max(atLeast, UPRIGHT) && (slope !== "ratio" || value !== 0)) {
      return this.#angleWords(quantity, "degrees");
    }
    const tangent = Math.tan(value);
    const rate = 1 + tangent ** 2;
    if (slope === "ratio") {
      const level = Math.abs(1 / tangent);
      const scaled = scaledTo(quantity, level, rate / tangent ** 2);
      // Steeper than any number tells, or level.
      if (!Number.isFinite(level)) return this.#joined("1 : ∞", "", scaled);
      const decimals = decimalsOf(scaled.atLeast) ?? 2;
      return this.#joined(
        `${tangent < 0 ? "−" : ""}1 : ${numberText(level, decimals, this.locale)}`,
        "",
        scaled,
      );
    }
    const factor = slope === "percent" ? 100 : 1;
    return this.#plain(
      scaledTo(quantity, tangent * factor, rate * factor),
      slope === "percent" ? "%" : "",
      1,
    );
  }

  /**
   * A longitude or latitude of WGS 84.
   * @param hemispheres letters for positive and negative ones: `EW`, `NS`
   */
  coordinateWords(quantity: Quantity<"rad">, hemispheres: "EW" | "NS"): Words {
    if (this.coordinates === "dms") return this.#angleWords(quantity, "dms", hemispheres);
    const { value, unit, worth } = this.#angleWords(
      { ...quantity, value: Math.abs(quantity.value) },
      "degrees",
    );
    const letter = hemispheres[quantity.value < 0 ? 1 : 0];
    const text = `${value}${unit} ${letter}`;
    return { value: text, unit: "", worth, ...texts(text, worth) };
  }

  #entry(unit: Exclude<SiUnit, "rad">): { readonly symbol: string; readonly size: number } {
    switch (unit) {
      case "m":
        return LENGTHS[this.length];
      case "m²":
        return AREAS[this.area];
      case "m³":
        return VOLUMES[this.volume];
      case "1":
        return { symbol: "", size: 1 };
    }
  }

  #angleWords(quantity: Quantity, unit: AngleUnit, hemispheres?: string): Words {
    if (unit !== "dms") return this.#plain(quantity, ANGLES[unit].symbol, ANGLES[unit].size);
    const second = Math.PI / 180 / 3600;
    const seconds = scaledTo(quantity, quantity.value / second, 1 / second);
    const decimals = Math.max(0, decimalsOf(seconds.atLeast) ?? 4);
    const value = dms(quantity.value, decimals, this.locale, hemispheres);
    return this.#joined(value, "", seconds, "″");
  }

  #plain(quantity: Quantity, symbol: string, size: number): Words {
    const scaled = scaledTo(quantity, quantity.value / size, 1 / size);
    const decimals = decimalsOf(scaled.atLeast) ?? defaultDecimals(quantity.unit, size);
    return this.#joined(numberText(scaled.value, decimals, this.locale), symbol, scaled);
  }

  #joined(value: string, unit: string, scaled: Scaled, worthUnit = unit): Words {
    const worth = this.#worth(scaled, worthUnit);
    return { value, unit, worth, ...texts(`${value}${spaced(unit)}`, worth) };
  }

  #worth({ uncertainty, atLeast }: Scaled, unit: string): string {
    const decimals = decimalsOf(atLeast);
    if (decimals === undefined) return uncertainty === null ? this.#words.unknown : "";
    const size = `± ${numberText(atLeast, decimals, this.locale)}${spaced(unit)}`;
    return uncertainty === null ? this.#words.atLeast(size) : size;
  }
}

/** Radians to the vertical, or the level, below which a ratio tells nothing. */
const UPRIGHT = 1e-9;

function texts(main: string, worth: string): Pick<Words, "main" | "text"> {
  return { main, text: worth === "" ? main : `${main} ${worth}` };
}

/** What text needs of a value in another unit. */
interface Scaled {
  readonly value: number;
  readonly uncertainty: number | null;
  readonly atLeast: number;
  readonly unit: SiUnit;
}

/** @param rate derivative of the new value by the old one */
function scaledTo<Q extends Quantity>(quantity: Q, value: number, rate: number): Q {
  const { uncertainty, atLeast } = quantity;
  return {
    ...quantity,
    value,
    uncertainty: uncertainty === null ? null : uncertainty * rate,
    atLeast: atLeast * rate,
  };
}

/** Decimals where no uncertainty tells: a millimetre, and what it is of areas and angles of the size of a scan. */
function defaultDecimals(unit: SiUnit, size: number): number {
  const step = { m: 1e-3, "m²": 1e-2, "m³": 1e-2, rad: 1e-5, "1": 1e-6 }[unit];
  return Math.max(0, Math.ceil(-Math.log10(step / size)));
}

/** A unit behind its number: no space before degrees, minutes, seconds. */
function spaced(symbol: string): string {
  return symbol === "" || /^[°′″]/.test(symbol) ? symbol : `\u00a0${symbol}`;
}

function isWords(given: unknown): given is WorthWords {
  if (typeof given !== "object" || given === null) return false;
  const { unknown, atLeast } = given as Partial<Record<keyof WorthWords, unknown>>;
  return typeof unknown === "string" && typeof atLeast === "function";
}

function isLocale(given: unknown): boolean {
  if (typeof given !== "string") return false;
  try {
    return Intl.getCanonicalLocales(given).length === 1;
  } catch {
    return false;
  }
}
