import type { CodeSighting } from "./code-finder.ts";
import { onPicture, type Feed } from "./feed.ts";

export interface SightingRequest {
  readonly bitmap: ImageBitmap;
  readonly session: number;
  readonly drawn_s: number;
}
export interface SightingAnswer {
  readonly sighting: CodeSighting;
  readonly drawn_s: number;
}

/**
 * What time code the pictures of a camera show, one picture at a time; what comes meanwhile is left out.
 *
 * @param tell  called with what was seen in the picture that was drawn at `drawn_s`
 */
export function watchCodes(feed: Feed, session: number, tell: (answer: SightingAnswer) => void): () => void {
  const worker = new Worker(new URL("../../workers/time-code.worker.ts", import.meta.url), { type: "module" });
  let busy = false;
  let over = false;
  worker.addEventListener("message", ({ data }: MessageEvent<SightingAnswer>) => {
    busy = false;
    if (!over) tell(data);
  });
  const stop = onPicture(feed.id, ({ canvas, times }) => {
    if (busy || !times) return;
    busy = true;
    const drawn_s = times.shown_s;
    createImageBitmap(canvas).then(
      bitmap => {
        worker.postMessage({ bitmap, session, drawn_s } satisfies SightingRequest, [bitmap]);
      },
      () => {
        busy = false;
      },
    ); // a canvas that has just changed its size is looked at next time
  });
  return () => {
    over = true;
    stop();
    worker.terminate();
  };
}
