/** Range and mean of one attribute over the whole data set, in the attribute's own units. */
export interface AttributeStatistics {
  readonly name: string;
  readonly min: number;
  readonly max: number;
  readonly mean: number;
}

/** What a converter counted while it wrote a data set. */
export interface CloudStatistics {
  readonly points: number;
  /** Bits per colour channel that the scan really uses; null where it has no colour. */
  readonly rgbBits: 8 | 16 | null;
  readonly attributes: readonly AttributeStatistics[];
  /** Number of points by class number. */
  readonly classes: Readonly<Record<string, number>>;
  /** Number of points by return number. */
  readonly returns: Readonly<Record<string, number>>;
}
