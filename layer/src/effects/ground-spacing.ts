/**
 * The distance between points that one size on the ground has to bridge: the median over the picture, 0 where there is
 * nothing. The finest level's would leave holes in all that is coarser, and most of a picture is, for points are chosen
 * to lie evenly on the screen; the coarsest's would lay the finer parts over one another many times.
 *
 * The median is found by quickselect (C. A. R. Hoare, "Algorithm 65: Find", 1961), which goes on in that part alone that
 * it lies in.
 * @param spacings of each part of the picture whose points lie evenly, the distance between them, metres on the ground;
 *   reordered together with `pixels`
 * @param pixels what each part takes of the picture
 */
export function groundSpacing(spacings: Float64Array, pixels: Float64Array): number {
  let all = 0;
  for (let at = 0; at < pixels.length; at++) all += pixels[at];
  let low = 0;
  let high = spacings.length;
  /** Pixels of the parts before `low`, which are all closer together than the median. */
  let closer = 0;
  while (high > low) {
    const pivot = spacings[(low + high) >> 1];
    // Three parts: closer together than the pivot before `equal`, wider apart from `wider` on.
    let equal = low;
    let wider = high;
    let below = 0;
    let same = 0;
    for (let at = low; at < wider; ) {
      const spacing = spacings[at];
      if (spacing < pivot) {
        below += pixels[at];
        swap(spacings, pixels, at++, equal++);
      } else if (spacing > pivot) swap(spacings, pixels, at, --wider);
      else same += pixels[at++];
    }
    if (equal > low && closer + below >= 0.5 * all) high = equal;
    else if (wider === high || closer + below + same >= 0.5 * all) return pivot;
    else {
      closer += below + same;
      low = wider;
    }
  }
  return 0;
}

function swap(spacings: Float64Array, pixels: Float64Array, a: number, b: number): void {
  const spacing = spacings[a];
  const taken = pixels[a];
  spacings[a] = spacings[b];
  pixels[a] = pixels[b];
  spacings[b] = spacing;
  pixels[b] = taken;
}
