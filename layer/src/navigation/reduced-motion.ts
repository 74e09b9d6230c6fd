/** Whether the reader asked for less motion: what glides and flies is there at once then. */
export function reducedMotion(): boolean {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}
