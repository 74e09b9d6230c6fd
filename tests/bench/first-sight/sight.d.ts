/** What a page measures. */
export interface Sight {
  /** From the call that opens the scan to the first frame with points of it, milliseconds. */
  readonly first: number;
  /** From there to the first frame with all points that the view wants, milliseconds. */
  readonly complete: number;
  /** Points of that frame. */
  readonly points: number;
}

declare global {
  interface Window {
    /** Opens a scan, looks at the whole of it from the south, 45° down, and waits until the view is complete. */
    look(address: string): Promise<Sight>;
  }
}
