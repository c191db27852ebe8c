import { expect, test } from "vitest";
import { createVideoRelay, type VideoLine } from "./relay.ts";
import {
  LARGEST_PICTURE,
  PICTURE_HEAD_BYTES,
  readPictureHead,
  readVideoEvent,
  writePictureHead,
  writeVideo,
  type VideoRequest,
  type VideoEvent,
} from "./wire.ts";

/** A picture as a camera sends it: head and the least JPEG there is. */
function picture(sequence: number, captured_s = 1, bytes = PICTURE_HEAD_BYTES + 64): Uint8Array {
  const all = new Uint8Array(bytes);
  writePictureHead(all, {
    camera: 0,
    sequence,
    captured_s,
    sent_s: captured_s + 0.01,
    relayed_s: 0,
    uncertain_s: 0.001,
  });
  all.set([0xff, 0xd8], PICTURE_HEAD_BYTES);
  return all;
}
function bench() {
  let now_s = 100;
  const relay = createVideoRelay(() => now_s, ["https://192.0.2.1:7341/camera/?code=1"]);
  const join = () => {
    const told: VideoEvent[] = [];
    const pictures: number[] = [];
    const bytes: Uint8Array[] = [];
    let closed = false;
    const line: VideoLine = {
      send(text) {
        const heard = readVideoEvent(text);
        if (heard.kind === "fault") throw new Error(heard.sentence);
        told.push(heard.message);
      },
      picture(lent) {
        pictures.push(readPictureHead(lent)!.sequence);
        bytes.push(lent);
      },
      close() {
        closed = true;
      },
    };
    const commander = relay.join(line);
    return {
      told,
      pictures,
      bytes,
      seat: commander,
      ask: (ask: VideoRequest) => {
        commander.hear(writeVideo(ask));
      },
      get closed() {
        return closed;
      },
      last: () => told.at(-1),
    };
  };
  return {
    relay,
    join,
    wait: (by_s: number) => {
      now_s += by_s;
    },
    now_s: () => now_s,
  };
}
function filming(name = "Phone") {
  const { join, ...rest } = bench();
  const camera = join();
  const viewer = join();
  camera.ask({ type: "camera", name, key: "key of phone" });
  viewer.ask({ type: "viewer" });
  return { join, camera, viewer, ...rest };
}

test("X-40 the bytes of a picture are those that are written down", () => {
  // u16 0x5654, camera 3, sequence 7, captured 1, sent 2, relayed 3, uncertain 0.5, zero, then FF D8.
  const written = Uint8Array.of(
    0x54,
    0x56,
    3,
    0,
    7,
    0,
    0,
    0,
    0,
    0,
    0,
    0,
    0,
    0,
    0xf0,
    0x3f,
    0,
    0,
    0,
    0,
    0,
    0,
    0,
    0x40,
    0,
    0,
    0,
    0,
    0,
    0,
    8,
    0x40,
    0,
    0,
    0,
    0x3f,
    0,
    0,
    0,
    0,
    0xff,
    0xd8,
    0xff,
    0xd9,
  );
  const head = { camera: 3, sequence: 7, captured_s: 1, sent_s: 2, relayed_s: 3, uncertain_s: 0.5 };
  expect(readPictureHead(written)).toEqual(head);
  const ours = Uint8Array.from(written).fill(9, 0, PICTURE_HEAD_BYTES);
  writePictureHead(ours, head);
  expect([...ours]).toEqual([...written]);
});

test("X-40 a picture goes to those who look, with the camera's number and the relay's clock, and to nobody else", () => {
  const { camera, viewer, join } = filming();
  const other = join();
  other.ask({ type: "viewer" });
  expect(viewer.last()).toEqual({ type: "cameras", cameras: [{ camera: 1, name: "Phone" }] });
  viewer.ask({ type: "watch", camera: 1 });
  expect(camera.last()).toEqual({ type: "watchers", watchers: 1 });
  camera.seat.hearPicture(picture(0));
  expect(camera.last()).toEqual({ type: "arrived", sequence: 0, watchers: 1 });
  expect(viewer.pictures).toEqual([0]);
  expect(readPictureHead(viewer.bytes[0]!)).toMatchObject({ camera: 1, relayed_s: 100, captured_s: 1 });
  expect(other.pictures).toEqual([]);
});

test("X-40 a slow viewer gets the newest picture and never a queue; a quick one beside it gets all", () => {
  const { camera, viewer: slow, join } = filming();
  const quick = join();
  for (const viewer of [slow, quick]) viewer.ask({ type: "watch", camera: 1 });
  for (let sequence = 0; sequence < 100; sequence++) {
    camera.seat.hearPicture(picture(sequence));
    quick.ask({ type: "seen", camera: 1, sequence });
  }
  expect(quick.pictures).toEqual(Array.from({ length: 100 }, (_, i) => i));
  expect(slow.pictures).toEqual([0, 1]);
  slow.ask({ type: "seen", camera: 1, sequence: 0 });
  expect(slow.pictures).toEqual([0, 1, 99]);
  slow.ask({ type: "seen", camera: 1, sequence: 1 });
  slow.ask({ type: "seen", camera: 1, sequence: 99 });
  expect(slow.pictures, "the same picture is not sent twice").toEqual([0, 1, 99]);
});

test("X-40 who comes late sees the newest picture at once, and one picture a camera is all that is kept", () => {
  const { camera, join, relay } = filming();
  for (let sequence = 0; sequence < 50; sequence++) camera.seat.hearPicture(picture(sequence, 1, 1000));
  expect(relay.keptBytes).toBe(1000);
  const late = join();
  late.ask({ type: "viewer" });
  late.ask({ type: "watch", camera: 1 });
  expect(late.pictures).toEqual([49]);
});

test("X-40 several cameras, of the same name too; one that leaves is gone from the list and from memory", () => {
  const { camera, viewer, join, relay } = filming();
  const second = join();
  second.ask({ type: "camera", name: "Phone", key: "another key" });
  expect(viewer.last()).toEqual({
    type: "cameras",
    cameras: [
      { camera: 1, name: "Phone" },
      { camera: 2, name: "Phone 2" },
    ],
  });
  viewer.ask({ type: "watch", camera: 2 });
  camera.seat.hearPicture(picture(0));
  second.seat.hearPicture(picture(0));
  expect(viewer.pictures.length).toBe(1);
  second.seat.leave();
  expect(viewer.last()).toEqual({ type: "cameras", cameras: [{ camera: 1, name: "Phone" }] });
  camera.seat.leave();
  expect(relay.keptBytes).toBe(0);
  viewer.ask({ type: "watch", camera: 1 });
  expect(viewer.closed, "asking for one that has just gone is no fault").toBe(false);
  expect(join().told).toEqual([{ type: "hello", protocol: 1, links: ["https://192.0.2.1:7341/camera/?code=1"] }]);
});

test("X-40 a camera that comes again by a new line takes its own place, not a second one", () => {
  const { camera, viewer, join } = filming();
  const again = join();
  again.ask({ type: "camera", name: "Phone", key: "key of phone" });
  expect(camera.closed).toBe(true);
  expect(viewer.last()).toEqual({ type: "cameras", cameras: [{ camera: 2, name: "Phone" }] });
});

test("X-40 a camera is told when the last viewer goes, also by leaving", () => {
  const { camera, viewer, join } = filming();
  const other = join();
  viewer.ask({ type: "watch", camera: 1 });
  other.ask({ type: "watch", camera: 1 });
  viewer.ask({ type: "unwatch", camera: 1 });
  expect(camera.last()).toEqual({ type: "watchers", watchers: 1 });
  other.seat.leave();
  expect(camera.last()).toEqual({ type: "watchers", watchers: 0 });
});

test("X-40 what is no message or no picture ends that connection with one sentence, and no other", () => {
  const { camera, viewer, join } = filming();
  viewer.ask({ type: "watch", camera: 1 });
  const texts = [
    "",
    "{",
    "null",
    "[]",
    '{"type":"camera"}',
    '{"type":"camera","name":""}',
    '{"type":"watch","camera":1e99}',
    '{"type":"viewer","more":1}',
    '{"type":"ping","sent_s":null}',
    "x".repeat(3_000_000),
  ];
  for (const text of texts) {
    const stranger = join();
    stranger.told.length = 0;
    stranger.seat.hear(text);
    stranger.seat.hear(writeVideo({ type: "viewer" }));
    stranger.seat.hearPicture(picture(0));
    expect([stranger.told.map(({ type }) => type), stranger.closed], text.slice(0, 40)).toEqual([["fault"], true]);
  }
  const nan = picture(0, NaN);
  const noJpeg = picture(0);
  noJpeg[PICTURE_HEAD_BYTES] = 0;
  for (const bytes of [new Uint8Array(0), new Uint8Array(39), new Uint8Array(LARGEST_PICTURE + 1), nan, noJpeg]) {
    const stranger = join();
    stranger.ask({ type: "camera", name: "x", key: "another key" });
    stranger.seat.hearPicture(bytes);
    expect([stranger.last()?.type, stranger.closed]).toEqual(["fault", true]);
  }
  const silent = join();
  silent.seat.hearPicture(picture(0));
  expect(silent.last()).toMatchObject({
    type: "fault",
    sentence: expect.stringContaining("has not said that it is one") as string,
  });
  camera.seat.hearPicture(picture(5));
  expect(viewer.pictures).toEqual([5]);
  expect(camera.closed || viewer.closed).toBe(false);
});

test("X-40 a camera that sends too much, or backwards, is turned away; so is one too many", () => {
  const { camera, join, wait } = filming();
  for (let sequence = 0; sequence < 130; sequence++) camera.seat.hearPicture(picture(sequence));
  expect(camera.closed).toBe(false);
  wait(1);
  camera.seat.hearPicture(picture(130));
  expect(camera.closed).toBe(false);
  camera.seat.hearPicture(picture(130));
  expect(camera.closed).toBe(true);
  const flood = join();
  flood.ask({ type: "camera", name: "Flood", key: "another key" });
  for (let sequence = 0; sequence < 200; sequence++) flood.seat.hearPicture(picture(sequence));
  expect(flood.closed).toBe(true);
  const many = Array.from({ length: 9 }, (_, i) => {
    const one = join();
    one.ask({ type: "camera", name: "Many", key: `key number ${i}` });
    return one.closed;
  });
  expect(many.filter(closed => closed).length).toBe(1);
});

test("X-40 200,000 damaged messages: no exception, one picture a camera kept, an honest pair goes on", () => {
  let seed = 40;
  const random = (below: number): number => {
    seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
    return Math.floor((seed / 2 ** 32) * below);
  };
  const { camera, viewer, join, relay, wait } = filming();
  viewer.ask({ type: "watch", camera: 1 });
  const words: VideoRequest[] = [
    { type: "viewer" },
    { type: "camera", name: "y", key: "key of another" },
    { type: "watch", camera: 1 },
    { type: "unwatch", camera: 1 },
    { type: "seen", camera: 1, sequence: 3 },
    { type: "ping", sent_s: 1 },
  ];
  let stranger = join();
  let faults = 0;
  for (let i = 0; i < 200_000; i++) {
    if (stranger.closed || random(200) === 0) {
      if (stranger.closed) faults++;
      stranger.seat.leave();
      stranger = join();
    }
    stranger.told.length = stranger.pictures.length = stranger.bytes.length = 0;
    if (random(2) === 0) {
      const text = [...writeVideo(words[random(words.length)]!)];
      for (let k = random(3); k > 0; k--) text[random(text.length)] = String.fromCharCode(random(0xffff));
      stranger.seat.hear(text.join("").slice(0, random(4) === 0 ? random(60) : undefined));
    } else {
      const bytes = picture(random(100), random(100), PICTURE_HEAD_BYTES + 4 + random(60));
      for (let k = random(4); k > 0; k--) bytes[random(bytes.length)] = random(256);
      stranger.seat.hearPicture(bytes.slice(random(8) === 0 ? random(20) : 0));
    }
    if (i % 1000 === 0) {
      wait(1);
      camera.seat.hearPicture(picture(i / 1000));
      viewer.ask({ type: "seen", camera: 1, sequence: i / 1000 });
    }
  }
  expect(faults).toBeGreaterThan(10_000);
  expect(viewer.pictures).toEqual(Array.from({ length: 200 }, (_, i) => i));
  expect(relay.keptBytes).toBeLessThanOrEqual(2 * (PICTURE_HEAD_BYTES + 64));
}, 60_000);
