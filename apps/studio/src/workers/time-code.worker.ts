import { findCode, grayOf } from "../runtime/video/code-finder.ts";
import type { SightingAnswer, SightingRequest } from "../runtime/video/sightings.ts";

/** Looks for a time code in pictures, beside the page. */
let canvas: OffscreenCanvas | null = null;
addEventListener("message", ({ data: { bitmap, session, drawn_s } }: MessageEvent<SightingRequest>) => {
  const { width, height } = bitmap;
  canvas ??= new OffscreenCanvas(width, height);
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext("2d", { willReadFrequently: true })!;
  context.drawImage(bitmap, 0, 0);
  bitmap.close();
  const sighting = findCode(
    grayOf(context.getImageData(0, 0, width, height).data, new Uint8Array(width * height)),
    width,
    height,
    session,
  );
  postMessage({ sighting, drawn_s } satisfies SightingAnswer);
});
