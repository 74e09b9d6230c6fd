import type { Scene } from "./scene.js";

/** Width of the widest points on screen, drawing-buffer pixels: those of the node whose points lie widest apart. */
export function pointWidth({ style, facts }: Scene): number {
  const { pixelRatio, spacings } = facts;
  if (style.size === "fixed") return style.pointSize * pixelRatio;
  const width = style.spacingFactor * spacings[1];
  return Math.min(Math.max(width, style.minimumSize * pixelRatio), style.maximumSize * pixelRatio);
}

/** Pixels by which neighbouring points overlap where they do most. */
export function pointOverlap(scene: Scene): number {
  const { spacings } = scene.facts;
  if (scene.style.size === "fixed") return Math.max(0, pointWidth(scene) - spacings[0]);
  return Math.max(0, pointWidth(scene) * (1 - 1 / scene.style.spacingFactor));
}
