import { LARGEST_PICTURE, MAX_PENDING, PICTURE_HEAD_BYTES, writePictureHead } from "@twincell/protocol";
import { eachPicture } from "./camera.ts";
import { openVideoLink } from "./link.ts";
import type { PackAnswer, PackRequest } from "./packing.ts";

/** Wider pictures are made smaller: what a person steers by is there, and the line stays short [pixels]. */
const WIDEST_PX = 1280;
const QUALITY = 0.72;
/** While nobody looks there is one picture in so long, for who comes next [s]. */
const UNWATCHED_EVERY_S = 1;

export interface SenderListener {
  state(state: "connecting" | "open" | "gone", sentence: string): void;
  watchers(count: number): void;
  trouble(sentence: string): void;
}
export interface Sender {
  readonly video: HTMLVideoElement;
  /** Pictures that were sent since it was asked last. */
  takeCount(): number;
  stop(): void;
}
const now_s = (): number => performance.now() / 1000;

/**
 * Shows a camera through the server: always the picture that is new now. One is packed at a time and at most two are on
 * their way; what comes meanwhile is not kept.
 *
 * @param key  the same for as long as this camera means itself
 */
export function startSender(stream: MediaStream, name: string, key: string, listener: SenderListener): Sender {
  const worker = new Worker(new URL("../../workers/picture.worker.ts", import.meta.url), { type: "module" });
  let open = false;
  let busy = false;
  let sequence = 0;
  let arrived = -1;
  let watchers = 0;
  let sent_s = -Infinity;
  let count = 0;
  let over = false;
  const link = openVideoLink({
    state(state, sentence) {
      open = state === "open";
      if (open) {
        sequence = 0;
        arrived = -1;
        link.say({ type: "camera", name, key });
      }
      listener.state(state, sentence);
    },
    tell(message) {
      if (message.type === "arrived") arrived = Math.max(arrived, message.sequence);
      if ((message.type === "arrived" || message.type === "watchers") && message.watchers !== watchers)
        listener.watchers((watchers = message.watchers));
    },
  });
  const done = (): void => {
    busy = false;
  };
  const failed = (problem: unknown): void => {
    done();
    if (!over)
      listener.trouble(
        `The picture could not be taken from the camera: ${problem instanceof Error ? problem.message : String(problem)}.`,
      );
  };

  async function send(video: HTMLVideoElement, captured_s: number): Promise<void> {
    const scale = Math.min(1, WIDEST_PX / video.videoWidth);
    const { clock } = link;
    const bitmap = await createImageBitmap(video, {
      resizeWidth: Math.round(video.videoWidth * scale),
      resizeHeight: Math.round(video.videoHeight * scale),
    });
    const answer = await new Promise<PackAnswer>(resolve => {
      worker.onmessage = ({ data }: MessageEvent<PackAnswer>) => {
        resolve(data);
      };
      worker.postMessage(
        { bitmap, quality: QUALITY, headBytes: PICTURE_HEAD_BYTES, most: LARGEST_PICTURE } satisfies PackRequest,
        [bitmap],
      );
    });
    if ("fault" in answer) {
      listener.trouble(answer.fault);
      return;
    }
    if (!open || over) return;
    sent_s = now_s();
    writePictureHead(answer.bytes, {
      camera: 0,
      sequence: sequence++,
      captured_s: captured_s + clock.offset_s,
      sent_s: sent_s + clock.offset_s,
      relayed_s: 0,
      uncertain_s: clock.uncertain_s,
    });
    link.picture(answer.bytes);
    count++;
  }
  const { video, stop } = eachPicture(stream, (from, captured_s) => {
    // Without the relay's clock a picture has no time, and without an answer the line is full.
    if (busy || !open || from.videoWidth === 0 || Number.isNaN(link.clock.offset_s) || sequence - arrived > MAX_PENDING)
      return;
    if (watchers === 0 && now_s() - sent_s < UNWATCHED_EVERY_S) return;
    busy = true;
    send(from, captured_s).then(done, failed);
  });
  for (const track of stream.getVideoTracks())
    track.addEventListener("ended", () => {
      if (!over) listener.trouble("The camera was taken away or its permission withdrawn.");
    });
  return {
    video,
    takeCount() {
      const taken = count;
      count = 0;
      return taken;
    },
    stop() {
      over = true;
      stop();
      link.close();
      worker.terminate();
    },
  };
}
