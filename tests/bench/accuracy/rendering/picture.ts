/** A picture: RGB of each pixel, 0 to 255, row by row from above. */
export interface Picture {
  readonly width: number;
  readonly height: number;
  readonly rgb: Uint8ClampedArray;
}

/** How far two pictures are apart. */
export interface Difference {
  /** Root mean square over all channels of all pixels, steps of 255. */
  readonly rms: number;
  /** Share of pixels of which a channel differs by more than {@link VISIBLE}. */
  readonly changed: number;
}

/** Steps of 255 from which on a pixel counts as changed. */
const VISIBLE = 16;

/** What a canvas shows, each pixel the mean of a square of `samples` × `samples` of its own. */
export function pictureOf(canvas: HTMLCanvasElement, samples: number): Picture {
  const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", {
    willReadFrequently: true,
  })!;
  copy.drawImage(canvas, 0, 0);
  const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
  const [width, height] = [canvas.width / samples, canvas.height / samples];
  const rgb = new Uint8ClampedArray(3 * width * height);
  for (let pixel = 0; pixel < width * height; pixel++) {
    const corner = samples * (Math.floor(pixel / width) * canvas.width + (pixel % width));
    for (let channel = 0; channel < 3; channel++) {
      let sum = 0;
      for (let row = 0; row < samples; row++) {
        for (let column = 0; column < samples; column++) {
          sum += data[4 * (corner + row * canvas.width + column) + channel]!;
        }
      }
      rgb[3 * pixel + channel] = Math.round(sum / samples ** 2);
    }
  }
  return { width, height, rgb };
}

export function differenceOf(a: Picture, b: Picture): Difference {
  if (a.width !== b.width || a.height !== b.height) throw new Error("pictures of different sizes");
  let squares = 0;
  let changed = 0;
  for (let at = 0; at < a.rgb.length; at += 3) {
    let most = 0;
    for (let channel = at; channel < at + 3; channel++) {
      const apart = Math.abs(a.rgb[channel]! - b.rgb[channel]!);
      squares += apart * apart;
      most = Math.max(most, apart);
    }
    if (most > VISIBLE) changed++;
  }
  return { rms: Math.sqrt(squares / a.rgb.length), changed: changed / (a.rgb.length / 3) };
}

/** The middles of pictures beside each other as a JPEG in base64, of so many bytes at most. */
export async function strip(pictures: readonly Picture[], width: number, height: number, bytes: number) {
  const gap = 4;
  const canvas = new OffscreenCanvas(pictures.length * (width + gap) - gap, height);
  const into = canvas.getContext("2d")!;
  into.fillStyle = "white";
  into.fillRect(0, 0, canvas.width, canvas.height);
  for (const [index, picture] of pictures.entries()) {
    const image = into.createImageData(picture.width, picture.height);
    for (let pixel = 0; pixel < picture.width * picture.height; pixel++) {
      image.data.set(picture.rgb.subarray(3 * pixel, 3 * pixel + 3), 4 * pixel);
      image.data[4 * pixel + 3] = 255;
    }
    const [left, top] = [Math.floor((picture.width - width) / 2), Math.floor((picture.height - height) / 2)];
    into.putImageData(image, index * (width + gap) - left, -top, left, top, width, height);
  }
  for (let quality = 0.9; ; quality -= 0.1) {
    const blob = await canvas.convertToBlob({ type: "image/jpeg", quality });
    if (blob.size > bytes && quality > 0.2) continue;
    let binary = "";
    for (const byte of new Uint8Array(await blob.arrayBuffer())) binary += String.fromCharCode(byte);
    return btoa(binary);
  }
}
