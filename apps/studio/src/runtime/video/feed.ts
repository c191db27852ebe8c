import type { PictureTimes } from "./freshness.ts";

/** How long a picture was in each place on its way [s]. */
export interface RunContexts {
  readonly taken_s: number;
  readonly toServer_s: number;
  readonly toHere_s: number;
  readonly unpacked_s: number;
}

/** The newest picture of a camera, drawn where panels and the headset take it from. Written in place. */
export interface Feed {
  readonly id: string;
  readonly canvas: HTMLCanvasElement;
  /** Of the picture that is drawn; null before the first. */
  times: PictureTimes | null;
  /** How far the clocks may be off [s]. */
  uncertain_s: number;
  stages: RunContexts | null;
  /** Counts up with every picture. */
  revision: number;
  /** Pictures that were left out because a newer one was there. */
  dropped: number;
}
const listeners = new Map<string, Set<(feed: Feed) => void>>();

export function newFeed(id: string): Feed {
  const canvas = document.createElement("canvas");
  canvas.width = 16;
  canvas.height = 9;
  return { id, canvas, times: null, uncertain_s: 0, stages: null, revision: 0, dropped: 0 };
}

/** Called after each picture of that feed was drawn. */
export function onPicture(id: string, listen: (feed: Feed) => void): () => void {
  const all = listeners.get(id) ?? new Set();
  listeners.set(id, all.add(listen));
  return () => {
    all.delete(listen);
    if (all.size === 0) listeners.delete(id);
  };
}

/** Draws a picture and says so. @param captured_s by the page's clock */
export function drawPicture(
  feed: Feed,
  picture: ImageBitmap | HTMLVideoElement,
  width: number,
  height: number,
  captured_s: number,
): void {
  const { canvas } = feed;
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  canvas.getContext("2d")!.drawImage(picture, 0, 0);
  feed.times = { captured_s, shown_s: performance.now() / 1000 };
  feed.revision++;
  for (const listen of listeners.get(feed.id) ?? []) listen(feed);
}
