import type { PointCloudLayer } from "@groma/layer/cesium";

/** What all switches of the panel share. Each is declared once: what it is called, reads, and changes. */
interface FieldBase {
  /** Unique in the page; the `id` of its input. */
  readonly id: string;
  readonly label: string;
  /** Where it does not hold, the switch would change nothing and is not shown. */
  readonly when?: (layer: PointCloudLayer) => boolean;
}

/** A number between two ends. */
export interface SliderField extends FieldBase {
  readonly kind: "slider";
  readonly least: number;
  readonly most: number;
  readonly step: number;
  /** What stands behind the number. */
  readonly unit?: string;
  /** Where the slider moves evenly over the logarithm: powers of ten between `least` and `most`. */
  readonly logarithmic?: boolean;
  read(layer: PointCloudLayer): number;
  write(layer: PointCloudLayer, value: number): void;
}

/** One of several words. */
export interface ChoiceField extends FieldBase {
  readonly kind: "choice";
  options(layer: PointCloudLayer): readonly { readonly value: string; readonly label: string }[];
  read(layer: PointCloudLayer): string;
  write(layer: PointCloudLayer, value: string): void;
}

/** On or off. */
export interface CheckField extends FieldBase {
  readonly kind: "check";
  read(layer: PointCloudLayer): boolean;
  write(layer: PointCloudLayer, value: boolean): void;
}

/** Two numbers, the first below the second; both empty where the whole range is meant. */
export interface RangeField extends FieldBase {
  readonly kind: "range";
  /** What an empty end stands for; undefined where it is not known. */
  whole(layer: PointCloudLayer): readonly [number, number] | undefined;
  read(layer: PointCloudLayer): readonly [number, number] | undefined;
  write(layer: PointCloudLayer, value: readonly [number, number] | undefined): void;
}

export type Field = SliderField | ChoiceField | CheckField | RangeField;

/** A field on the page. */
export interface FieldView {
  readonly element: HTMLElement;
  /** Shows how a layer is drawn now. */
  show(layer: PointCloudLayer): void;
}
