/** What the ground in the middle of a view is drawn like. */
export interface Ground {
  /** Metres of ground per CSS pixel, from left to right. */
  readonly metresPerPixel: number;
  /** Where true north is in the picture: radians clockwise from its upper edge. */
  readonly north: number;
}

/** The picture of a view, and what is drawn beside it. */
export interface ViewShot {
  readonly image: HTMLCanvasElement;
  /** Where the view is in the page, CSS pixels. */
  readonly box: DOMRect;
  /** Undefined where the view shows no ground in its middle. */
  readonly ground: Ground | undefined;
  /** Whether the ground lies in perspective, so that its scale holds in the middle alone. */
  readonly perspective: boolean;
}

/**
 * A canvas for the picture of a view, to be drawn in CSS pixels of the view.
 * @param ratio pixels of the picture per CSS pixel
 */
export function viewCanvas({ width, height }: DOMRect, ratio: number): CanvasRenderingContext2D {
  const canvas = document.createElement("canvas");
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d");
  if (!context) throw new Error("the browser gives no canvas to draw a picture on");
  context.scale(ratio, ratio);
  return context;
}

/**
 * Draws the figures and labels of the measuring tool, which lie over a view as elements of the page.
 * @param context in CSS pixels of the view
 */
export function drawFigures(context: CanvasRenderingContext2D, view: Element, box: DOMRect): void {
  for (const overlay of Array.from(view.querySelectorAll(".groma-measure"))) {
    for (const shape of Array.from(overlay.querySelectorAll("path, circle"))) drawShape(context, shape);
    for (const label of Array.from(overlay.querySelectorAll(".groma-label"))) drawLabel(context, label, box);
  }
}

function drawShape(context: CanvasRenderingContext2D, shape: Element): void {
  const style = getComputedStyle(shape);
  if (style.visibility === "hidden") return;
  const path = new Path2D(shape.getAttribute("d") ?? "");
  const [x, y, radius] = ["cx", "cy", "r"].map((name) => Number(shape.getAttribute(name)));
  if (radius) path.arc(x!, y!, radius, 0, 2 * Math.PI);
  context.save();
  context.filter = style.filter;
  context.lineJoin = "round";
  context.lineWidth = Number.parseFloat(style.strokeWidth);
  if (style.fill !== "none") {
    context.fillStyle = style.fill;
    context.fill(path);
  }
  if (style.stroke !== "none") {
    context.strokeStyle = style.stroke;
    context.stroke(path);
  }
  context.restore();
}

function drawLabel(context: CanvasRenderingContext2D, label: Element, view: DOMRect): void {
  const { left, top, width, height } = label.getBoundingClientRect();
  if (width === 0) return;
  const style = getComputedStyle(label);
  const lines = label.textContent.split("\n");
  context.save();
  context.translate(left - view.left, top - view.top);
  context.beginPath();
  context.roundRect(0, 0, width, height, Number.parseFloat(style.borderRadius) || 0);
  context.fillStyle = style.backgroundColor;
  context.fill();
  context.font = style.font;
  context.fillStyle = style.color;
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (const [at, line] of lines.entries()) {
    context.fillText(line, width / 2, ((at + 0.5) * height) / lines.length, width);
  }
  context.restore();
}
