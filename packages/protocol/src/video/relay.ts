import {
  LARGEST_PICTURE,
  LONGEST_VIDEO_TEXT,
  MAX_PENDING,
  readPictureHead,
  readVideoRequest,
  stampPicture,
  VIDEO_PROTOCOL,
  writeVideo,
  type VideoRequest,
  type VideoEvent,
} from "./wire.ts";

const MOST_CAMERAS = 8;
const MOST_GUESTS = 64;
/** More than this from one camera in a second is no camera any more. */
const MOST_PICTURES_PER_S = 130;
const MOST_BYTES_PER_S = 24 * 1024 * 1024;

/** A line to a camera or a viewer. Bytes of a picture are not written to any more once they are handed to `picture`. */
export interface VideoLine {
  send(text: string): void;
  picture(bytes: Uint8Array): void;
  close(): void;
}
export interface VideoViewer {
  hear(text: string): void;
  /** The relay keeps these bytes and writes into their head. */
  hearPicture(bytes: Uint8Array): void;
  leave(): void;
}
export interface VideoRelay {
  join(line: VideoLine): VideoViewer;
  /** Bytes of pictures that are kept: one for each camera. */
  readonly keptBytes: number;
}
interface Camera {
  readonly number: number;
  readonly name: string;
  readonly key: string;
  readonly guest: Guest;
  newest: Uint8Array | null;
  sequence: number;
  second: number;
  pictures: number;
  bytes: number;
}
interface Watch {
  underWay: number[];
  told: number;
}
interface Guest {
  readonly line: VideoLine;
  camera: Camera | null;
  viewer: boolean;
  readonly watches: Map<number, Watch>;
  over: boolean;
}

/**
 * Hands the pictures of cameras to those who look. A picture stands alone, so any may be left out: to each viewer at
 * most two are under way, and when one was unpacked the newest goes next, never a queue of old ones. Who comes late
 * gets the newest at once. It keeps one picture a camera, whatever comes. Whatever is no message ends that connection
 * with one sentence.
 */
export function createVideoRelay(now_s: () => number, links: readonly string[] = []): VideoRelay {
  const cameras = new Map<number, Camera>();
  const guests = new Set<Guest>();
  let count = 0;
  const tell = (guest: Guest, message: VideoEvent): void => {
    if (!guest.over) guest.line.send(writeVideo(message));
  };
  const list = (): VideoEvent => ({
    type: "cameras",
    cameras: [...cameras.values()].map(({ number, name }) => ({ camera: number, name })),
  });
  const tellList = (): void => {
    for (const guest of guests) if (guest.viewer) tell(guest, list());
  };
  const watchersOf = (number: number): number =>
    [...guests].reduce((sum, guest) => sum + (guest.watches.has(number) ? 1 : 0), 0);
  const tellWatchers = (number: number): void => {
    const camera = cameras.get(number);
    if (camera) tell(camera.guest, { type: "watchers", watchers: watchersOf(number) });
  };
  function handOn(guest: Guest, watch: Watch, camera: Camera): void {
    if (camera.newest === null || watch.told === camera.sequence || watch.underWay.length >= MAX_PENDING) return;
    watch.told = camera.sequence;
    watch.underWay.push(camera.sequence);
    guest.line.picture(camera.newest);
  }
  function forget(guest: Guest): void {
    if (guest.over) return;
    guest.over = true;
    guests.delete(guest);
    const watched = [...guest.watches.keys()];
    guest.watches.clear();
    for (const number of watched) tellWatchers(number);
    if (!guest.camera) return;
    const { number } = guest.camera;
    cameras.delete(number);
    for (const other of guests) other.watches.delete(number);
    tellList();
  }
  function fault(guest: Guest, sentence: string): void {
    tell(guest, { type: "fault", sentence });
    forget(guest);
    guest.line.close();
  }
  function hear(guest: Guest, ask: VideoRequest): void {
    switch (ask.type) {
      case "ping":
        tell(guest, { type: "pong", sent_s: ask.sent_s, relay_s: now_s() });
        return;
      case "viewer":
        guest.viewer = true;
        tell(guest, list());
        return;
      case "camera": {
        if (guest.camera) {
          fault(guest, "This connection is a camera already.");
          return;
        }
        // The same camera by a new line: the old one may be half open for minutes.
        for (const old of [...cameras.values()])
          if (old.key === ask.key) {
            forget(old.guest);
            old.guest.line.close();
          }
        if (cameras.size >= MOST_CAMERAS) {
          fault(guest, `There are ${MOST_CAMERAS} cameras already, and no more are taken. Close one of them.`);
          return;
        }
        const taken = new Set([...cameras.values()].map(({ name }) => name));
        const number = (count = (count % 0xffff) + 1);
        let name = ask.name;
        for (let n = 2; taken.has(name); n++) name = `${ask.name} ${n}`;
        guest.camera = {
          number,
          name,
          key: ask.key,
          guest,
          newest: null,
          sequence: -1,
          second: -1,
          pictures: 0,
          bytes: 0,
        };
        cameras.set(number, guest.camera);
        tell(guest, { type: "watchers", watchers: 0 });
        tellList();
        return;
      }
      case "watch": {
        const camera = cameras.get(ask.camera);
        // A camera may leave while somebody asks for it; the list that says so is on its way.
        if (!camera || guest.watches.has(ask.camera)) return;
        const watch: Watch = { underWay: [], told: -1 };
        guest.watches.set(ask.camera, watch);
        tellWatchers(ask.camera);
        handOn(guest, watch, camera);
        return;
      }
      case "unwatch":
        if (guest.watches.delete(ask.camera)) tellWatchers(ask.camera);
        return;
      case "seen": {
        const watch = guest.watches.get(ask.camera);
        const camera = cameras.get(ask.camera);
        if (!watch || !camera) return;
        watch.underWay = watch.underWay.filter(sequence => sequence > ask.sequence);
        handOn(guest, watch, camera);
        return;
      }
    }
  }
  function hearPicture(guest: Guest, bytes: Uint8Array): void {
    const { camera } = guest;
    const head = readPictureHead(bytes);
    if (!camera) {
      fault(guest, "Only a camera sends pictures, and this connection has not said that it is one.");
      return;
    }
    if (!head) {
      fault(
        guest,
        `A message of ${bytes.length} bytes is no picture of this protocol; the longest is ${LARGEST_PICTURE} bytes.`,
      );
      return;
    }
    if (head.sequence <= camera.sequence) {
      fault(guest, `Picture ${head.sequence} came after picture ${camera.sequence}.`);
      return;
    }
    const at_s = now_s();
    if (Math.floor(at_s) !== camera.second) {
      camera.second = Math.floor(at_s);
      camera.pictures = camera.bytes = 0;
    }
    camera.pictures++;
    camera.bytes += bytes.length;
    if (camera.pictures > MOST_PICTURES_PER_S || camera.bytes > MOST_BYTES_PER_S) {
      fault(
        guest,
        `The camera “${camera.name}” sends more than ${MOST_PICTURES_PER_S} pictures or ${MOST_BYTES_PER_S / 1024 / 1024} MB a second.`,
      );
      return;
    }
    stampPicture(bytes, camera.number, at_s);
    camera.newest = bytes;
    camera.sequence = head.sequence;
    tell(guest, { type: "arrived", sequence: head.sequence, watchers: watchersOf(camera.number) });
    for (const other of guests) {
      const watch = other.watches.get(camera.number);
      if (watch) handOn(other, watch, camera);
    }
  }
  return {
    join(line) {
      const guest: Guest = { line, camera: null, viewer: false, watches: new Map(), over: false };
      if (guests.size >= MOST_GUESTS) {
        fault(guest, `${MOST_GUESTS} cameras and viewers are connected already, and no more are taken.`);
      } else {
        guests.add(guest);
        tell(guest, { type: "hello", protocol: VIDEO_PROTOCOL, links: [...links] });
      }
      return {
        hear(text) {
          if (guest.over) return;
          if (text.length > LONGEST_VIDEO_TEXT) {
            fault(guest, `A message of ${text.length} characters is too long to be one about cameras.`);
            return;
          }
          const heard = readVideoRequest(text);
          if (heard.kind === "fault") fault(guest, heard.sentence);
          else hear(guest, heard.message);
        },
        hearPicture(bytes) {
          if (!guest.over) hearPicture(guest, bytes);
        },
        leave() {
          forget(guest);
        },
      };
    },
    get keptBytes() {
      return [...cameras.values()].reduce((sum, { newest }) => sum + (newest?.length ?? 0), 0);
    },
  };
}
