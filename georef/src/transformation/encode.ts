import { requireFields } from "../errors/arguments.js";
import type { GridWindow } from "../grid/window.js";
import { ByteWriter } from "./bytes.js";
import { CHOICE, DIRECTIONS, KINDS, MAGIC, TURNED_PROJECTION, VERSION } from "./format.js";
import { writeGridValues } from "./grid-values.js";
import type { EllipsoidAxes, Patchwork, Step, Transformation } from "./step.js";

/**
 * A transformation as bytes, layout in docs/transformation.md. {@link decodeTransformation} gives it back exactly.
 *
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function encodeTransformation(transformation: Transformation): Uint8Array {
  requireFields(transformation, { steps: "list" }, "encodeTransformation: transformation");
  const { steps } = transformation;
  const writer = new ByteWriter();
  writer.raw(MAGIC);
  writer.u8(VERSION);
  writer.u8(steps.length);
  for (const step of steps) {
    writer.u8(numberOf(step));
    writeStep(writer, step);
  }
  return writer.finish();
}

function numberOf(step: Step): number {
  if (step.kind === "choice") return CHOICE;
  const turned = step.kind === "projection" && step.patchwork.centre;
  return turned ? TURNED_PROJECTION : KINDS.indexOf(step.kind);
}

function writeStep(writer: ByteWriter, step: Step): void {
  switch (step.kind) {
    case "projection":
      writePatchwork(writer, step.patchwork);
      break;
    case "height":
      writer.f64(step.metresPerUnit);
      break;
    case "horizontalShift":
      writer.u8(DIRECTIONS.indexOf(step.direction));
      writeWindow(writer, step.window);
      break;
    case "verticalShift":
      writer.f64(step.multiplier);
      writeWindow(writer, step.window);
      break;
    case "datumShift":
      writeEllipsoid(writer, step.from);
      writeEllipsoid(writer, step.to);
      writer.f64(...step.translation, ...step.matrix);
      writer.u8(step.keepHeight ? 1 : 0);
      break;
    case "choice":
      writer.u8(step.ways.length);
      for (const { area, steps } of step.ways) {
        writer.f64(area.minX, area.minY, area.maxX, area.maxY);
        writer.u8(steps.length);
        for (const inner of steps) {
          writer.u8(numberOf(inner));
          writeStep(writer, inner);
        }
      }
      break;
    case "geocentric":
      writeEllipsoid(writer, step.ellipsoid);
      break;
  }
}

function writeEllipsoid(writer: ByteWriter, { a, f }: EllipsoidAxes): void {
  writer.f64(a, f);
}

function writePatchwork(writer: ByteWriter, { bound, patches, centre }: Patchwork): void {
  if (centre) writer.f64(...centre);
  writer.f64(bound);
  writer.u16(patches.length);
  for (const { minX, minY, maxX, maxY, degree, coefficients } of patches) {
    writer.f64(minX, minY, maxX, maxY);
    writer.u8(degree);
    writer.f64(...coefficients);
  }
}

function writeWindow(writer: ByteWriter, window: GridWindow): void {
  writer.text(window.grid);
  writer.f64(window.west, window.south, window.stepLongitude, window.stepLatitude);
  writer.u32(window.columns);
  writer.u32(window.rows);
  writer.u8(window.channels);
  writer.f64(window.unit);
  // A value that is not finite says nothing that the values do not say themselves.
  const stated = window.noData !== undefined && Number.isFinite(window.noData);
  writer.u8(stated ? 1 : 0);
  if (stated) writer.f64(window.noData);
  writeGridValues(writer, window.values, window);
}
