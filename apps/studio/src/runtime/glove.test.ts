import { radians } from "@twincell/core";
import { beforeEach, describe, expect, test, vi } from "vitest";
import { gloveStore, readHands } from "../stores/glove.ts";
import { noticeStore } from "../stores/notices.ts";
import {
  BAUD,
  beginCalibration,
  beginRecording,
  closeGlove,
  endRecording,
  keepCalibration,
  openGlove,
  takeRest,
  type SerialLine,
} from "./glove.ts";

const opened = vi.hoisted(() => [] as { text: string; name: string }[]);
vi.mock("./planning/demonstrating.ts", () => ({
  openDemonstration: (text: string, name: string) => opened.push({ text, name }),
}));

/** A glove on a line: what is fed to it is read, what it is told is kept. */
class SimulatedGlove implements SerialLine {
  readonly told: string[] = [];
  baud = 0;
  isOpen = false;
  #feed!: ReadableStreamDefaultController<Uint8Array>;
  readonly readable = new ReadableStream<Uint8Array>({ start: feed => void (this.#feed = feed) });
  readonly writable = new WritableStream<Uint8Array>({
    write: bytes => void this.told.push(new TextDecoder().decode(bytes)),
  });
  open({ baudRate }: { readonly baudRate: number }): Promise<void> {
    this.baud = baudRate;
    this.isOpen = true;
    return Promise.resolve();
  }
  close(): Promise<void> {
    this.isOpen = false;
    return Promise.resolve();
  }
  say(text: string): void {
    this.#feed.enqueue(new TextEncoder().encode(text));
  }
  unplug(): void {
    this.#feed.error(new Error("The device has been lost."));
  }
}
let now_ms = 0;
const clock = (): number => now_ms;
const lineOf = (t: number, finger: number, volt = 2.5): string =>
  `${t},${volt},2.5,2.5,0,0,0,1,${finger},${finger},${finger},${finger},${finger}\n`;
/** Lets the reading side take what was said, 100 ms later by its clock. */
const heard = async (): Promise<void> => {
  now_ms += 100;
  for (let i = 0; i < 6; i++) await new Promise(resolve => setTimeout(resolve, 0));
};
const shelf = (): Pick<Storage, "getItem" | "setItem"> => {
  const kept = new Map<string, string>();
  return { getItem: key => kept.get(key) ?? null, setItem: (key, value) => void kept.set(key, value) };
};
async function worn(): Promise<{ glove: SimulatedGlove; done: Promise<void>; store: ReturnType<typeof shelf> }> {
  const glove = new SimulatedGlove();
  const done = openGlove(glove, clock);
  await heard();
  beginCalibration();
  for (const finger of [300, 3000, 300]) glove.say(lineOf(0, finger));
  await heard();
  takeRest();
  const store = shelf();
  expect(keepCalibration("Ana", 9.6, store)).toBe(true);
  return { glove, done, store };
}
beforeEach(() => {
  opened.length = 0;
  gloveStore.setState(gloveStore.getInitialState());
  noticeStore.setState({ notices: [] });
});

describe("a glove on a serial line", () => {
  test("M-25 M-23 it is opened, told to send 50 samples a second, read, told to stop and closed", async () => {
    const { glove, done } = await worn();
    expect(glove.baud).toBe(BAUD);
    expect(glove.told).toEqual(["START 50\n"]);
    expect(gloveStore.getState().link).toBe("open");
    await closeGlove();
    await done;
    expect(glove.told).toEqual(["START 50\n", "STOP\n"]);
    expect([glove.isOpen, gloveStore.getState().link]).toEqual([false, "none"]);
    expect(noticeStore.getState().notices).toEqual([]);
  });

  test("M-20 M-24 M-27 M-28 M-29 the wizard makes a profile that is kept for its person; half bent is 45°, closing picks", async () => {
    const { glove, done, store } = await worn();
    expect(gloveStore.getState().profiles[0]).toMatchObject({
      name: "Ana",
      fingers: Array.from({ length: 5 }, () => ({ flat: 300, bent: 3000 })),
      accelerometer: { slope_mps2_per_V: 9.6, intercept_mps2: -24 },
    });
    await heard();
    glove.say(lineOf(1, 1650));
    await heard();
    expect(gloveStore.getState().bends_rad[0]).toBeCloseTo(radians(45), 9);
    expect(gloveStore.getState().closed).toBe(false);
    glove.say(lineOf(1.1, 2900));
    await heard();
    expect(gloveStore.getState().closed).toBe(true);
    gloveStore.setState({ profiles: [], wearer: "" });
    readHands(store);
    expect(gloveStore.getState().wearer).toBe("Ana");
    await closeGlove();
    await done;
  });

  test("M-26 garbage is counted and left out: half lines, other numbers, fingers beyond 12 bits, a line without an end", async () => {
    const { glove, done } = await worn();
    const before = gloveStore.getState();
    await heard();
    glove.say(`\u0000\u0007\n1,2,3\n${lineOf(1, 4096)}${lineOf(1, 300, 7)}NaN,x\n${"9".repeat(5000)}`);
    await heard();
    glove.say(`\n# a remark\n${lineOf(2, 300)}`);
    await heard();
    const after = gloveStore.getState();
    expect(after.dropped - before.dropped).toBe(6);
    expect(after.samples).toBe(4);
    await closeGlove();
    await done;
  });

  test("M-01 what is recorded becomes a demonstration; one that is unplugged ends it, says so and loses nothing", async () => {
    const { glove, done } = await worn();
    expect(beginRecording()).toBe(true);
    for (let i = 0; i <= 60; i++) glove.say(lineOf(i / 50, i > 40 ? 2900 : 300, i < 25 ? 2.6 : i < 50 ? 2.4 : 2.5));
    await heard();
    glove.unplug();
    await done;
    expect(gloveStore.getState()).toMatchObject({ link: "none", recording: false });
    expect(noticeStore.getState().notices.map(({ tone }) => tone)).toEqual(["warn"]);
    expect(opened).toHaveLength(1);
    expect(opened[0]!.name).toBe("Ana.csv");
    const rows = opened[0]!.text.trim().split("\n").slice(1);
    expect(rows).toHaveLength(61);
    endRecording();
    expect(opened).toHaveLength(1);
  });

  test("a line that cannot be opened, a wearer without a profile and a hand that hardly moved are said, and nothing begins", async () => {
    const refused = new SimulatedGlove();
    refused.open = () => Promise.reject(new Error("in use"));
    await openGlove(refused);
    expect(noticeStore.getState().notices[0]!.sentence).toContain("in use");
    expect(beginRecording()).toBe(false);
    const glove = new SimulatedGlove();
    const done = openGlove(glove, clock);
    await heard();
    beginCalibration();
    glove.say(lineOf(0, 300));
    await heard();
    expect(keepCalibration("Ben", 9.6, shelf())).toBe(false);
    expect(gloveStore.getState().profiles).toEqual([]);
    await closeGlove();
    await done;
  });
});
