/**
 * A flight without end over a place: random poses, and so many frames from each to the next, straight and with a height
 * that changes by equal factors.
 *
 * @param {() => { x: number, y: number, height: number, heading: number, pitch: number }} pose a random one
 */
export function* flight(pose, frames) {
  for (let from = pose(), to = pose(); ; from = to, to = pose()) {
    for (let frame = 0; frame < frames; frame++) {
      const part = frame / frames;
      const between = (name) => from[name] + (to[name] - from[name]) * part;
      yield {
        ...{ x: between("x"), y: between("y"), heading: between("heading"), pitch: between("pitch") },
        height: from.height * (to.height / from.height) ** part,
      };
    }
  }
}
