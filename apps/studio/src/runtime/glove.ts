import {
  copyPose,
  FINGERS,
  fingerBend,
  handBend,
  handClosed,
  profileOfHand,
  RAW_HAND_COLUMNS,
  readRawHand,
  writeDemonstration,
  type Pose,
} from "@twincell/core";
import { gloveStore, keepHand, wearerOf, type Calibration } from "../stores/glove.ts";
import { notify } from "../stores/notices.ts";
import { words } from "../messages/index.ts";
import { theLive } from "./live.ts";
import { openDemonstration } from "./planning/demonstrating.ts";

/** A serial line of the browser (Web Serial), or a double in a test (row M-25: open, close, send, read). */
export interface SerialLine {
  open(options: { readonly baudRate: number }): Promise<void>;
  close(): Promise<void>;
  readonly readable: ReadableStream<Uint8Array> | null;
  readonly writable: WritableStream<Uint8Array> | null;
}
export const BAUD = 115_200;
/** Samples asked for a second (row M-34). */
export const WANTED_HZ = 50;
/** A line longer than this is none: the line may send anything. */
const LONGEST_LINE = 400;
const TELL_EVERY_MS = 80;
/** A recording ends by itself after this many samples. */
const MOST_RECORDED = 200_000;
const MOST_RAW = 4095;
const HIGHEST_V = 5;
const NO_SWEEP: Calibration = {
  sweeps: Array.from({ length: FINGERS }, () => ({ low: Infinity, high: -Infinity })),
  rest_V: null,
};

let line: SerialLine | null = null;
let reader: ReadableStreamDefaultReader<Uint8Array> | null = null;
let recorded: string[] | null = null;
let start: Pose<"world", "tcp"> | null = null;
let last: readonly number[] | null = null;
let closed = false;
let samples = 0;
let dropped = 0;
let told_ms = 0;
let since: { readonly at_ms: number; readonly samples: number } = { at_ms: 0, samples: 0 };

/** Opens the line, asks the glove to send, and reads until it is closed or gone. Resolves when the line has ended. */
export async function openGlove(port: SerialLine, clock_ms: () => number = () => performance.now()): Promise<void> {
  if (gloveStore.getState().link !== "none") return;
  gloveStore.setState({ link: "opening" });
  try {
    await port.open({ baudRate: BAUD });
  } catch (problem) {
    gloveStore.setState({ link: "none" });
    notify("bad", words.glove.notOpened(problem instanceof Error ? problem.message : String(problem)));
    return;
  }
  line = port;
  samples = 0;
  dropped = 0;
  told_ms = clock_ms();
  since = { at_ms: told_ms, samples: 0 };
  gloveStore.setState({ link: "open", samples: 0, dropped: 0, rate_Hz: 0 });
  await send(`START ${WANTED_HZ}\n`);
  const decoder = new TextDecoder();
  let rest = "";
  let lost = false;
  try {
    reader = port.readable?.getReader() ?? null;
    for (;;) {
      const part = await reader?.read();
      if (!part || part.done) break;
      const lines = (rest + decoder.decode(part.value, { stream: true })).split(/\r\n|\r|\n/);
      rest = (lines.pop() ?? "").slice(-LONGEST_LINE);
      for (const each of lines) take(each);
      if (clock_ms() - told_ms >= TELL_EVERY_MS) tell(clock_ms());
    }
  } catch {
    lost = true; // unplugged: what the stream says of it means nothing to a person
  }
  lost ||= line !== null;
  line = null;
  reader = null;
  gloveStore.setState({ link: "none", rate_Hz: 0, calibration: null });
  if (lost) notify("warn", words.glove.lost, words.glove.lostHint);
  endRecording();
}
/** Asks the glove to be quiet, and closes the line. */
export async function closeGlove(): Promise<void> {
  const port = line;
  if (!port) return;
  await send("STOP\n");
  line = null;
  try {
    await reader?.cancel();
    reader?.releaseLock();
    await port.close();
  } catch {
    return; // a line that is gone is closed
  }
}
async function send(text: string): Promise<void> {
  const writer = line?.writable?.getWriter();
  if (!writer) return;
  try {
    await writer.write(new TextEncoder().encode(text));
  } catch {
    return; // one that only sends needs no asking
  } finally {
    writer.releaseLock();
  }
}

/** One line of the glove: time, three voltages, orientation, five 12-bit numbers. Anything else is left out. */
function take(text: string): void {
  if (text.trim() === "" || text.startsWith("#") || /^\s*t_s\b/i.test(text)) return;
  const values = text.split(",").map(part => (part.trim() === "" ? NaN : Number(part)));
  const fingers = values.slice(-FINGERS);
  const isGood =
    values.length === RAW_HAND_COLUMNS.length &&
    values.every(Number.isFinite) &&
    values.slice(1, 4).every(V => V >= 0 && V <= HIGHEST_V) &&
    fingers.every(raw => Number.isInteger(raw) && raw >= 0 && raw <= MOST_RAW);
  if (isGood) {
    samples++;
    last = values;
    sweep(values, fingers);
    recorded?.push(text);
    const profile = wearerOf(gloveStore.getState());
    if (profile) closed = handClosed(handBend(fingers, profile), closed);
    if (recorded !== null && recorded.length >= MOST_RECORDED) endRecording();
  } else dropped++;
}
function tell(now_ms: number): void {
  told_ms = now_ms;
  const profile = wearerOf(gloveStore.getState());
  const passed_s = (now_ms - since.at_ms) / 1000;
  const rate_Hz = passed_s > 0 ? (samples - since.samples) / passed_s : 0;
  if (passed_s > 2) since = { at_ms: now_ms, samples };
  const raw = last?.slice(-FINGERS) ?? [];
  gloveStore.setState({
    samples,
    dropped,
    rate_Hz,
    closed,
    bends_rad: profile
      ? profile.fingers.map((finger, i) => fingerBend(raw[i] ?? finger.flat, finger))
      : raw.map(() => 0),
  });
}

/** Begins a profile: the hand opens and closes, and rests once. */
export const beginCalibration = (): void => gloveStore.setState({ calibration: NO_SWEEP });
function sweep(values: readonly number[], fingers: readonly number[]): void {
  const { calibration } = gloveStore.getState();
  if (!calibration) return;
  const sweeps = calibration.sweeps.map(({ low, high }, i) => ({
    low: Math.min(low, fingers[i]!),
    high: Math.max(high, fingers[i]!),
  }));
  // The tracker rests as soon as it is told to; until then the last voltages stand for it.
  const rest_V = (values[1]! + values[2]! + values[3]!) / 3;
  gloveStore.setState({ calibration: { sweeps, rest_V: calibration.rest_V ?? rest_V } });
}
/** The tracker lies still now: what it says is no acceleration. */
export function takeRest(): void {
  const { calibration } = gloveStore.getState();
  if (calibration && last)
    gloveStore.setState({ calibration: { ...calibration, rest_V: (last[1]! + last[2]! + last[3]!) / 3 } });
}
/**
 * Keeps the profile of the one who wears the glove, or says what is missing. Its line (row M-30) goes through the rest.
 *
 * @param slope_mps2_per_V  of the tracker, as its maker states it.
 */
export function keepCalibration(
  name: string,
  slope_mps2_per_V: number,
  store: Pick<Storage, "getItem" | "setItem">,
): boolean {
  const { calibration } = gloveStore.getState();
  if (!calibration || calibration.rest_V === null || name.trim() === "") return false;
  const made = profileOfHand(
    name.trim(),
    calibration.sweeps.map(({ low, high }) => [low, high]),
    { slope_mps2_per_V, intercept_mps2: -slope_mps2_per_V * calibration.rest_V },
  );
  if (made.kind === "incomplete") {
    notify("warn", made.sentence);
    return false;
  }
  if (!keepHand(made.profile, store)) notify("warn", words.glove.notKept);
  return true;
}

/** Records what the hand shows from here on; the tool begins where it stands. False without a wearer. */
export function beginRecording(): boolean {
  const state = gloveStore.getState();
  if (state.link !== "open" || !wearerOf(state)) return false;
  recorded = [];
  start = copyPose(theLive().worldFromTcp);
  gloveStore.setState({ recording: true });
  return true;
}
/** Ends the recording: it is opened as a demonstration, filtered and laid over the cell. */
export function endRecording(): void {
  const lines = recorded;
  recorded = null;
  const profile = wearerOf(gloveStore.getState());
  if (lines === null || !profile || !start) return;
  gloveStore.setState({ recording: false });
  const read = readRawHand(lines.join("\n"), profile, start);
  if (read.kind === "unreadable") {
    notify("warn", read.sentence);
    return;
  }
  openDemonstration(writeDemonstration(read.demonstration), `${profile.name}.csv`);
}
