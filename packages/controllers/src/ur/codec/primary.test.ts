/** Bytes written out by hand from the description of the primary interface: int32 size, kind, body, all big-endian. */
import { seededRandom } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { lineBytes, lineReader } from "./lines.ts";
import {
  errorMessage,
  exceptionMessage,
  keyMessage,
  PART,
  primaryPackages,
  readMessage,
  readState,
  safetyModeMessage,
  statePackage,
  textMessage,
  versionMessage,
} from "./primary.ts";
import { onlyRequests, readCommand, valueIn } from "./dashboard.ts";

const hex = (text: string): Uint8Array => Uint8Array.from(text.trim().split(/\s+/), byte => Number.parseInt(byte, 16));
const letters = (text: string): string =>
  [...text].map(letter => letter.charCodeAt(0).toString(16).padStart(2, "0")).join(" ");
const CLOCK = "00 00 00 00 00 0f 42 40";
const TIME_US = 1_000_000;

describe("messages of the primary interface", () => {
  test("version: length and name, major, minor, bugfix, build, date", () => {
    const bytes = hex(
      `00 00 00 26 14 ${CLOCK} ff 03 04 ${letters("URCo")} 05 0c 00 00 00 01 00 00 00 2a ${letters("22-03-22")}`,
    );
    expect(versionMessage(TIME_US, "URCo", [5, 12, 1, 42], "22-03-22")).toEqual(bytes);
    expect(readMessage(bytes.subarray(5))).toEqual({ kind: "version", name: "URCo", major: 5, minor: 12 });
  });

  test("safety mode, error, key, runtime exception, text", () => {
    const safety = hex(`00 00 00 20 14 ${CLOCK} ff 05 00 00 00 00 00 00 00 00 03 00 00 00 00 00 00 00 00`);
    expect(safetyModeMessage(TIME_US, 3)).toEqual(safety);
    expect(readMessage(safety.subarray(5))).toEqual({ kind: "safety-mode", mode: 3 });
    const error = hex(
      `00 00 00 26 14 ${CLOCK} ff 06 00 00 00 d2 00 00 00 00 00 00 00 01 00 00 00 00 00 00 00 00 ${letters("lok")}`,
    );
    expect(errorMessage(TIME_US, 210, 1, "lok")).toEqual(error);
    expect(readMessage(error.subarray(5))).toEqual({ kind: "error", code: 210, level: 1, text: "lok" });
    const key = hex(
      `00 00 00 2d 14 ${CLOCK} fe 07 00 00 00 00 00 00 00 00 13 ${letters("PROGRAM_XXX_STARTED")} ${letters("ab")}`,
    );
    expect(keyMessage(TIME_US, "PROGRAM_XXX_STARTED", "ab")).toEqual(key);
    expect(readMessage(key.subarray(5))).toEqual({ kind: "key", title: "PROGRAM_XXX_STARTED", text: "ab" });
    const exception = hex(`00 00 00 19 14 ${CLOCK} fe 0a 00 00 00 03 00 00 00 07 ${letters("no")}`);
    expect(exceptionMessage(TIME_US, 3, 7, "no")).toEqual(exception);
    expect(readMessage(exception.subarray(5))).toEqual({ kind: "exception", line: 3, column: 7, text: "no" });
    const text = hex(`00 00 00 11 14 ${CLOCK} fe 00 ${letters("hi")}`);
    expect(textMessage(TIME_US, "hi")).toEqual(text);
    expect(readMessage(text.subarray(5))).toEqual({ kind: "text", text: "hi" });
  });

  test("messages that are cut short, or of a kind nobody knows, are nothing", () => {
    const whole = errorMessage(TIME_US, 1, 1, "");
    for (let length = 0; length < whole.length - 5; length++)
      expect(readMessage(whole.subarray(5, 5 + length))).toBeNull();
    expect(readMessage(hex(`${CLOCK} ff 63 00`))).toBeNull();
  });
});

describe("states of the primary interface", () => {
  const arm = { lower_rad: [-1], upper_rad: [1], speed_rad_s: [2], acceleration_rad_s2: [3], type: 2 };
  const state = {
    time_us: TIME_US,
    powerOn: true,
    emergencyStopped: false,
    protectiveStopped: true,
    running: true,
    paused: false,
    robotMode: 7,
    safetyMode: 3,
    remote: true,
    speedFraction: 1,
    q_rad: [1, 2, 3, 4, 5, 6],
    qd_rad_s: [0, 0, 0, 0, 0, 0],
    jointMode: 253,
    tcp: [0.5, 0, 0, 0, 0, 0],
    tcpOffset: [0, 0, 0, 0, 0, 0],
    digitalIn: 5,
    digitalOut: 0x101,
  };

  test("parts have the sizes that clients count on, and hold what they should where they should", () => {
    const bytes = statePackage(state, arm);
    const view = new DataView(bytes.buffer);
    const parts = new Map<number, { readonly size: number; readonly at: number }>();
    expect([view.getInt32(0), bytes[4]]).toEqual([bytes.length, 16]);
    for (let at = 5; at < bytes.length; at += view.getUint32(at))
      parts.set(bytes[at + 4]!, { size: view.getUint32(at), at });
    expect(parts.get(PART.mode)?.size).toBe(47);
    expect(parts.get(PART.joints)?.size).toBe(251);
    expect(parts.get(PART.cartesian)?.size).toBe(101);
    expect(parts.get(PART.configuration)?.size).toBe(445);
    const mode = parts.get(PART.mode)!.at;
    const joints = parts.get(PART.joints)!.at;
    const cartesian = parts.get(PART.cartesian)!.at;
    const configuration = parts.get(PART.configuration)!.at;
    // connected, enabled, power on, e-stopped, protective stopped, running, paused; robot mode
    expect([...bytes.subarray(mode + 13, mode + 21)]).toEqual([1, 1, 1, 0, 1, 1, 0, 7]);
    expect([0, 1, 5].map(i => view.getFloat64(joints + 5 + 41 * i))).toEqual([1, 2, 6]);
    expect(bytes[joints + 5 + 40]).toBe(253);
    expect(view.getFloat64(cartesian + 5)).toBe(0.5);
    expect(view.getInt32(configuration + 445 - 8)).toBe(2);
    expect(readState(bytes.subarray(5))).toEqual({ q_rad: Float64Array.of(1, 2, 3, 4, 5, 6), robotMode: 7 });
  });
});

describe("streams", () => {
  test("packages come out the same however they were split; a size that is none ends them with a sentence", () => {
    const whole = [textMessage(1, "one"), textMessage(2, "two"), statePackageOf()].flatMap(bytes => [...bytes]);
    for (const size of [1, 3, 7, 1000]) {
      const packages = primaryPackages();
      const seen: string[] = [];
      for (let at = 0; at < whole.length; at += size)
        expect(
          packages.push(Uint8Array.from(whole.slice(at, at + size)), (type, body) => {
            seen.push(`${type} ${body.length}`);
          }),
        ).toBeNull();
      expect(seen).toEqual(["20 13", "20 13", `16 ${statePackageOf().length - 5}`]);
    }
    expect(
      primaryPackages().push(hex("7f ff ff ff 10"), () => {
        /* Never. */
      }),
    ).toBe("A package has 5 to 65536 bytes; one of 2147483647 came.");
    expect(
      primaryPackages().push(hex("00 00 00 04 10"), () => {
        /* Never. */
      }),
    ).toMatch(/one of 4 came\.$/);
  });

  test("lines end with LF, a CR before it is no part of them; a line without an end is not kept for ever", () => {
    const lines = lineReader(10);
    const seen: string[] = [];
    expect(
      lines.push(hex("61 62 0d 0a 63"), line => {
        seen.push(line);
      }),
    ).toBeNull();
    expect(
      lines.push(hex("0a 0a e4 0a"), line => {
        seen.push(line);
      }),
    ).toBeNull();
    expect(seen).toEqual(["ab", "c", "", "?"]);
    expect(
      lines.push(new Uint8Array(11).fill(97), () => {
        /* Never. */
      }),
    ).toBe("A line has at most 10 letters; a longer one came.");
    expect(lineBytes("ok")).toEqual(hex("6f 6b 0a"));
  });

  test("any bytes: no crash, or a sentence", () => {
    for (let seed = 1; seed <= 300; seed++) {
      const random = seededRandom(seed);
      const packages = primaryPackages();
      const lines = lineReader();
      let why: string | null = null;
      for (let i = 0; i < 20; i++) {
        const chunk = Uint8Array.from({ length: Math.floor(random() * 200) }, (_, k) =>
          k % 9 < 3 ? 0 : Math.floor(random() * 256),
        );
        why ??= packages.push(chunk, (_, body) => {
          readMessage(body);
          readState(body);
        });
        lines.push(chunk, line => {
          readCommand(line);
        });
      }
      if (why !== null) expect(why).toMatch(/^A package .*\.$/);
    }
  });
});
const statePackageOf = (): Uint8Array =>
  statePackage(
    {
      time_us: 0,
      powerOn: false,
      emergencyStopped: false,
      protectiveStopped: false,
      running: false,
      paused: false,
      robotMode: 3,
      safetyMode: 1,
      remote: true,
      speedFraction: 1,
      q_rad: [],
      qd_rad_s: [],
      jointMode: 0,
      tcp: [],
      tcpOffset: [],
      digitalIn: 0,
      digitalOut: 0,
    },
    { lower_rad: [], upper_rad: [], speed_rad_s: [], acceleration_rad_s2: [], type: 0 },
  );

describe("words of the dashboard", () => {
  test("capitals count the same, arguments keep theirs, longer commands go before shorter", () => {
    expect(readCommand("RobotMode")).toEqual({ command: "robotmode", argument: "" });
    expect(readCommand("load Pick.urp ")).toEqual({ command: "load", argument: "Pick.urp" });
    expect(readCommand("load installation Cell.installation")).toEqual({
      command: "load installation",
      argument: "Cell.installation",
    });
    expect(readCommand("popup Hello there")).toEqual({ command: "popup", argument: "Hello there" });
    expect(readCommand("programState")?.command).toBe("programstate");
    for (const wrong of ["", "robotmodes", "dance", "stopp"]) expect(readCommand(wrong)).toBeNull();
    expect([onlyRequests("safetymode"), onlyRequests("power on"), onlyRequests("stop")]).toEqual([true, false, false]);
    expect(valueIn("Robotmode: RUNNING")).toBe("RUNNING");
  });
});
