import type { PlotAxes } from "@groma/layer/tools";

/** What pointer, wheel and keys do to a plot; pixels count from its upper left corner. */
export interface PlotActions {
  readonly pan: (right: number, down: number) => void;
  readonly zoom: (x: number, y: number, factor: number, axes: PlotAxes) => void;
  readonly hover: (x: number, y: number) => void;
  readonly leave: () => void;
  readonly click: (x: number, y: number) => void;
  readonly crosshair: (at: readonly [x: number, y: number] | undefined) => void;
  readonly fit: () => void;
  readonly trueScale: () => void;
  readonly size: () => readonly [width: number, height: number];
}

/** Pixels that a pointer may move between down and up for a click. */
const STILL = 4;

/** Pixels that an arrow key moves the crosshair, and with Shift. */
const STEP = 12;
const FINE = 1;

const ARROWS: ReadonlyMap<string, readonly [number, number]> = new Map([
  ["ArrowLeft", [-1, 0]],
  ["ArrowRight", [1, 0]],
  ["ArrowUp", [0, -1]],
  ["ArrowDown", [0, 1]],
]);

/**
 * Dragging pans, the wheel zooms about the pointer (with Shift along the line alone, with Ctrl or Alt heights alone), a double
 * click fits. Keys: arrows move a crosshair, and beyond the edge the plot; + and - zoom, 0 fits, 1 shows true angles, Enter is a
 * click at the crosshair, Escape takes it away.
 */
export function watchPlot(root: HTMLElement, actions: PlotActions): void {
  const at = ({ clientX, clientY }: MouseEvent) => {
    const { left, top } = root.getBoundingClientRect();
    return [clientX - left, clientY - top] as const;
  };
  let down: { x: number; y: number; moved: boolean } | undefined;
  root.addEventListener("pointerdown", (event) => {
    const [x, y] = at(event);
    down = { x, y, moved: false };
    root.setPointerCapture(event.pointerId);
  });
  root.addEventListener("pointermove", (event) => {
    const [x, y] = at(event);
    if (!down) {
      actions.hover(x, y);
      return;
    }
    if (!down.moved && Math.hypot(x - down.x, y - down.y) < STILL) return;
    actions.pan(x - down.x, y - down.y);
    down = { x, y, moved: true };
  });
  root.addEventListener("pointerup", (event) => {
    if (down && !down.moved) actions.click(...at(event));
    down = undefined;
  });
  root.addEventListener("pointercancel", () => {
    down = undefined;
  });
  root.addEventListener("pointerleave", () => actions.leave());
  root.addEventListener("dblclick", () => actions.fit());
  root.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      // Some browsers turn the wheel with Shift sideways.
      const turn = event.deltaY || event.deltaX;
      const axes = event.shiftKey ? "along" : event.ctrlKey || event.altKey ? "up" : "both";
      actions.zoom(...at(event), 2 ** (-turn / (event.deltaMode === 0 ? 300 : 9)), axes);
    },
    { passive: false },
  );
  watchKeys(root, actions);
}

function watchKeys(root: HTMLElement, actions: PlotActions): void {
  let crosshair: [number, number] | undefined;
  const middle = (): [number, number] => {
    const [width, height] = actions.size();
    return [width / 2, height / 2];
  };
  root.addEventListener("blur", () => {
    crosshair = undefined;
    actions.crosshair(undefined);
  });
  root.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { key } = event;
    const arrow = ARROWS.get(key);
    const [x, y] = crosshair ?? middle();
    if (arrow) {
      const step = event.shiftKey ? FINE : STEP;
      crosshair = moved([x + step * arrow[0], y + step * arrow[1]], actions);
      actions.crosshair(crosshair);
    } else if (key === "+" || key === "=") actions.zoom(x, y, 1.5, "both");
    else if (key === "-") actions.zoom(x, y, 1 / 1.5, "both");
    else if (key === "0") actions.fit();
    else if (key === "1") actions.trueScale();
    else if (key === "Enter" || key === " ") actions.click(x, y);
    else if (key === "Escape" && crosshair) {
      crosshair = undefined;
      actions.crosshair(undefined);
    } else return;
    event.preventDefault();
  });
}

/** Keeps the crosshair in the plot, which moves instead. */
function moved([x, y]: readonly [number, number], { size, pan }: PlotActions): [number, number] {
  const [width, height] = size();
  const held = [Math.min(width, Math.max(0, x)), Math.min(height, Math.max(0, y))] as [number, number];
  if (held[0] !== x || held[1] !== y) pan(held[0] - x, held[1] - y);
  return held;
}
