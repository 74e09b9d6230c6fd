import type { Scene } from "./scene.js";

/**
 * Width of the widest points on screen, drawing-buffer pixels: of one size on the ground the nearest, of adaptive sizes
 * those that lie widest apart.
 */
export function pointWidth({ style, facts }: Scene): number {
  const { pixelRatio, spacings, groundSpacing, pixelsPerMetre } = facts;
  if (style.size === "fixed") return style.pointSize * pixelRatio;
  const apart = style.size === "attenuated" ? groundSpacing * pixelsPerMetre : spacings[1];
  const width = style.spacingFactor * apart;
  return Math.min(Math.max(width, style.minimumSize * pixelRatio), style.maximumSize * pixelRatio);
}

/** Pixels by which neighbouring points overlap where they do most. */
export function pointOverlap(scene: Scene): number {
  const { spacings } = scene.facts;
  if (scene.style.size !== "adaptive") return Math.max(0, pointWidth(scene) - spacings[0]);
  return Math.max(0, pointWidth(scene) * (1 - 1 / scene.style.spacingFactor));
}
