/** An operation that is wrong as it is registered. */
interface Faulty {
  /** As it stands in the names of PROJ's operations. */
  readonly names: readonly string[];
  /** What is wrong with it, without a closing stop. */
  readonly why: string;
}

/**
 * EPSG:9142 and 9143 (Kosovo), published as 1 m, lead 1,600 m east of where EPSG:7676 (Serbia), 6206 (North Macedonia) and
 * 3962 (former Yugoslavia) do, which agree within 20 m there. Their rotations, read as centesimal seconds of a coordinate
 * frame in place of arc-seconds of a position vector, lead to within 2 m of Serbia's in plane.
 */
const FAULTY: readonly Faulty[] = [
  {
    names: ["MGI 1901 to WGS 84 (14)", "MGI 1901 to KOSOVAREF01 (1)"],
    why: "as EPSG has it, it leads 1,600 m away from where those of the neighbours do, which agree",
  },
];

/** What is known against an operation; nothing for most. */
export function faultOf(operation: string): string | undefined {
  return FAULTY.find(({ names }) => names.some((name) => operation.includes(name)))?.why;
}
