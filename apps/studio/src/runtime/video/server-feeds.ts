import { PICTURE_HEAD_BYTES, readPictureHead, type PictureHead } from "@twincell/protocol";
import { changePanel, videoStore } from "../../stores/video.ts";
import { words } from "../../messages/index.ts";
import { drawPicture, type Feed } from "./feed.ts";
import { openVideoLink, type VideoLink } from "./link.ts";

interface Waiting {
  readonly bytes: Uint8Array;
  readonly head: PictureHead;
  readonly at_s: number;
}
interface Watched {
  readonly feed: Feed;
  readonly name: string;
  camera: number | null;
  busy: boolean;
  waiting: Waiting | null;
}

const watched = new Map<string, Watched>();
let link: VideoLink | null = null;

/** Asks the server which cameras show themselves, from now on. */
export function lookForCameras(): void {
  link ??= openVideoLink({
    state(server, sentence) {
      videoStore.setState({ server, sentence, ...(server === "open" ? {} : { cameras: [] }) });
      if (server === "open") link!.say({ type: "viewer" });
      else
        for (const each of watched.values()) {
          each.camera = null;
          changePanel(each.feed.id, { trouble: sentence || words.video.connecting });
        }
    },
    links(links) {
      videoStore.setState({ links });
    },
    tell(message) {
      if (message.type !== "cameras") return;
      videoStore.setState({ cameras: message.cameras });
      for (const each of watched.values()) find(each);
    },
    picture(bytes, at_s) {
      const head = readPictureHead(bytes);
      const each = head && [...watched.values()].find(({ camera }) => camera === head.camera);
      if (!each) return;
      const waiting = { bytes, head, at_s };
      if (!each.busy) {
        void unpack(each, waiting);
        return;
      }
      // Only the newest waits; the one it replaces is done with.
      if (each.waiting) {
        each.feed.dropped++;
        seen(each.waiting.head);
      }
      each.waiting = waiting;
    },
  });
}
const seen = ({ camera, sequence }: PictureHead): void => {
  link?.say({ type: "seen", camera, sequence });
};

/** The camera of that name, now or when it comes. */
function find(each: Watched): void {
  const camera = videoStore.getState().cameras.find(({ name }) => name === each.name)?.camera ?? null;
  if (camera === each.camera) return;
  each.camera = camera;
  if (camera === null) {
    changePanel(each.feed.id, { trouble: words.video.cameraGone(each.name) });
    return;
  }
  changePanel(each.feed.id, { trouble: "" });
  link?.say({ type: "watch", camera });
}

async function unpack(each: Watched, { bytes, head, at_s }: Waiting): Promise<void> {
  each.busy = true;
  const { feed } = each;
  try {
    const bitmap = await createImageBitmap(
      new Blob([bytes.subarray(PICTURE_HEAD_BYTES) as Uint8Array<ArrayBuffer>], { type: "image/jpeg" }),
    );
    const clock = link!.clock;
    feed.uncertain_s = clock.uncertain_s + head.uncertain_s;
    drawPicture(feed, bitmap, bitmap.width, bitmap.height, head.captured_s - clock.offset_s);
    bitmap.close();
    feed.stages = {
      taken_s: head.sent_s - head.captured_s,
      toServer_s: head.relayed_s - head.sent_s,
      toHere_s: at_s + clock.offset_s - head.relayed_s,
      unpacked_s: feed.times!.shown_s - at_s,
    };
  } catch (problem) {
    changePanel(feed.id, {
      trouble: words.video.unreadable(problem instanceof Error ? problem.message : String(problem)),
    });
  }
  seen(head);
  each.busy = false;
  const { waiting } = each;
  each.waiting = null;
  if (waiting && watched.get(feed.id) === each) void unpack(each, waiting);
}

export function watchServerCamera(feed: Feed, name: string): () => void {
  const each: Watched = { feed, name, camera: null, busy: false, waiting: null };
  watched.set(feed.id, each);
  lookForCameras();
  find(each);
  return () => {
    watched.delete(feed.id);
    if (each.camera !== null) link?.say({ type: "unwatch", camera: each.camera });
  };
}
