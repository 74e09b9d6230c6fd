/** What an engine says of the way it chose. */
export interface OperationReport {
  /** Name of the operation, as PROJ or EPSG has it. */
  readonly name: string;
  /**
   * Metres as published; `null` when nobody has stated it. Where EGM96 stands for a country's geoid, that of the
   * operation in plane.
   */
  readonly accuracy: number | null;
  /** A difference of datums is passed over: the place may be off by hundreds of metres. */
  readonly ballpark: boolean;
  /** Files of the grids whose windows the transformation carries. */
  readonly grids: readonly string[];
  /** Better operations whose grids were not there, with the files they want. */
  readonly lacking: readonly {
    readonly name: string;
    readonly accuracy: number | null;
    readonly grids: readonly string[];
  }[];
  /** Greatest difference to the engine itself over the points compared, metres; `null` where none were. */
  readonly worstDifference: number | null;
  /** In words. */
  readonly notes: readonly string[];
}
