/** Bytes written out by hand from the description of RTDE: size (header included), kind, payload, all big-endian. */
import { seededRandom } from "@twincell/core";
import { describe, expect, test } from "vitest";
import {
  accepted,
  askInputs,
  askOutputs,
  askProtocol,
  askVersion,
  dataBuffer,
  namesIn,
  outputsAsked,
  packData,
  pause,
  readText,
  readVersion,
  recipeAnswer,
  recipeAnswered,
  recipeOf,
  RTDE,
  rtdeFrames,
  start,
  textFrame,
  unexpected,
  unpackData,
  versionAnswer,
  viewOf,
} from "./rtde.ts";
import { INPUT_FIELDS, OUTPUT_FIELDS, SHAPES, SLOTS, slotOf, type Field } from "./rtde-fields.ts";

const hex = (text: string): Uint8Array => Uint8Array.from(text.trim().split(/\s+/), byte => Number.parseInt(byte, 16));
const letters = (text: string): string =>
  [...text].map(letter => letter.charCodeAt(0).toString(16).padStart(2, "0")).join(" ");
const field = (name: string): Field => OUTPUT_FIELDS.get(name) ?? INPUT_FIELDS.get(name)!;

describe("frames of RTDE", () => {
  test("questions without a payload, and the protocol", () => {
    expect(askProtocol(2)).toEqual(hex("00 05 56 00 02"));
    expect(askVersion()).toEqual(hex("00 03 76"));
    expect(start()).toEqual(hex("00 03 53"));
    expect(pause()).toEqual(hex("00 03 50"));
    expect(accepted(RTDE.protocolVersion, true)).toEqual(hex("00 04 56 01"));
    expect(accepted(RTDE.start, false)).toEqual(hex("00 04 53 00"));
  });

  test("the version is four numbers of 32 bits", () => {
    const bytes = hex("00 13 76 00 00 00 05 00 00 00 0c 00 00 00 00 00 10 ce 1d");
    expect(versionAnswer([5, 12, 0, 1_101_341])).toEqual(bytes);
    expect(readVersion(bytes.subarray(3))).toEqual([5, 12, 0, 1_101_341]);
    expect(readVersion(bytes.subarray(3, 10))).toBeNull();
  });

  test("outputs: a frequency and names with commas; a comma at the end names nothing", () => {
    // 125 Hz = 405f400000000000
    const bytes = hex(`00 1d 4f 40 5f 40 00 00 00 00 00 ${letters("timestamp,payload,")}`);
    expect(outputsAsked(bytes.subarray(3), 2)).toEqual({ frequency_Hz: 125, names: ["timestamp", "payload"] });
    expect(askOutputs(["timestamp", "payload"], 125)).toEqual(
      hex(`00 1c 4f 40 5f 40 00 00 00 00 00 ${letters("timestamp,payload")}`),
    );
    expect(outputsAsked(hex(letters("timestamp,payload")), 1)).toEqual({
      frequency_Hz: 0,
      names: ["timestamp", "payload"],
    });
    expect(askInputs(["speed_slider_mask"])).toEqual(hex(`00 14 49 ${letters("speed_slider_mask")}`));
    expect(namesIn(hex(letters(",,")))).toEqual([]);
  });

  test("answers to recipes: an id in protocol 2, none in protocol 1, a word in the place of a type that cannot be had", () => {
    expect(recipeAnswer(RTDE.outputs, 1, ["DOUBLE", "VECTOR6D"])).toEqual(
      hex(`00 13 4f 01 ${letters("DOUBLE,VECTOR6D")}`),
    );
    expect(recipeAnswer(RTDE.outputs, null, ["DOUBLE"])).toEqual(hex(`00 09 4f ${letters("DOUBLE")}`));
    expect(recipeAnswer(RTDE.inputs, 0, ["IN_USE", "NOT_FOUND"])).toEqual(
      hex(`00 14 49 00 ${letters("IN_USE,NOT_FOUND")}`),
    );
    expect(recipeAnswered(hex(`07 ${letters("INT32,UINT8")}`), true)).toEqual({ id: 7, types: ["INT32", "UINT8"] });
    expect(unexpected([field("payload"), field("robot_mode")], ["DOUBLE", "NOT_FOUND"])).toEqual([
      "robot_mode (NOT_FOUND)",
    ]);
    expect(unexpected([field("payload")], [])).toEqual(["1 variables, 0 types"]);
  });

  test("texts of both protocols", () => {
    const two = hex(`00 0b 4d 03 ${letters("hot")} 02 ${letters("PC")} 02`);
    const one = hex(`00 07 4d 01 ${letters("hot")}`);
    expect(textFrame({ message: "hot", source: "PC", level: "warning" }, 2)).toEqual(two);
    expect(readText(two.subarray(3), 2)).toEqual({ message: "hot", source: "PC", level: "warning" });
    expect(textFrame({ message: "hot", source: "", level: "error" }, 1)).toEqual(one);
    expect(readText(one.subarray(3), 1)).toEqual({ message: "hot", source: "", level: "error" });
  });

  test("a data package of every width: doubles, whole numbers with and without sign, 64 bits, bytes", () => {
    const fields = [
      "timestamp",
      "robot_mode",
      "runtime_state",
      "actual_digital_input_bits",
      "input_bit_register_64",
      "payload_cog",
      "joint_mode",
    ].map(field);
    const recipe = recipeOf(3, fields);
    const slots = new Float64Array(SLOTS);
    slots[slotOf("timestamp")] = 41.5;
    slots[slotOf("robot_mode")] = -1;
    slots[slotOf("runtime_state")] = 2;
    slots[slotOf("actual_digital_input_bits")] = 0x3_0081;
    slots[slotOf("input_bit_register_64")] = 1;
    slots.set([0.5, -2, 0], slotOf("payload_cog"));
    slots.set([253, 253, 255, -1, 0, 1], slotOf("joint_mode"));
    const bytes = hex(`00 4d 55 03
      40 44 c0 00 00 00 00 00  ff ff ff ff  00 00 00 02  00 00 00 00 00 03 00 81  01
      3f e0 00 00 00 00 00 00  c0 00 00 00 00 00 00 00  00 00 00 00 00 00 00 00
      00 00 00 fd  00 00 00 fd  00 00 00 ff  ff ff ff ff  00 00 00 00  00 00 00 01`);
    const out = dataBuffer(recipe, true);
    packData(recipe, slots, out, viewOf(out));
    expect(out).toEqual(bytes);
    const read = new Float64Array(SLOTS);
    expect(unpackData(recipe, bytes.subarray(4), read)).toBe(true);
    expect(read).toEqual(slots);
    expect(unpackData(recipe, bytes.subarray(4, 20), read)).toBe(false);
    expect(dataBuffer(recipe, false)).toHaveLength(bytes.length - 1);
  });

  test("the fields that clients of this robot ask for are there, with the types the vendor gives them", () => {
    const types: Readonly<Record<string, string>> = {
      actual_q: "VECTOR6D",
      target_moment: "VECTOR6D",
      joint_mode: "VECTOR6INT32",
      actual_tool_accelerometer: "VECTOR3D",
      actual_digital_output_bits: "UINT64",
      robot_mode: "INT32",
      runtime_state: "UINT32",
      speed_scaling: "DOUBLE",
      output_int_register_47: "INT32",
      output_double_register_0: "DOUBLE",
      output_bit_registers0_to_31: "UINT32",
      output_bit_register_127: "BOOL",
      input_int_register_24: "INT32",
    };
    for (const [name, type] of Object.entries(types)) expect(OUTPUT_FIELDS.get(name)?.type, name).toBe(type);
    for (const [name, type] of Object.entries({
      speed_slider_mask: "UINT32",
      standard_digital_output_mask: "UINT8",
      external_force_torque: "VECTOR6D",
      input_bit_register_64: "BOOL",
    }))
      expect(INPUT_FIELDS.get(name)?.type, name).toBe(type);
    expect(INPUT_FIELDS.has("actual_q")).toBe(false);
    expect(
      Object.entries(SHAPES)
        .map(([type, { bytes }]) => `${type} ${bytes}`)
        .sort(),
    ).toEqual([
      "BOOL 1",
      "DOUBLE 8",
      "INT32 4",
      "UINT32 4",
      "UINT64 8",
      "UINT8 1",
      "VECTOR3D 24",
      "VECTOR6D 48",
      "VECTOR6INT32 24",
      "VECTOR6UINT32 24",
    ]);
  });
});

describe("a stream of frames", () => {
  const whole = hex("00 04 56 01  00 03 53  00 05 4d 01 41  00 04 53 01");
  const wanted = ["86: 1", "83: ", "77: 1,65", "83: 1"];
  const read = (chunks: readonly Uint8Array[]): { seen: string[]; why: string | null } => {
    const frames = rtdeFrames();
    const seen: string[] = [];
    let why: string | null = null;
    for (const chunk of chunks) {
      const lent = chunk.slice();
      why ??= frames.push(lent, (type, payload) => {
        seen.push(`${type}: ${payload.join()}`);
      });
      lent.fill(0xee);
    }
    return { seen, why };
  };

  test("comes out the same however it was split", () => {
    expect(read([whole])).toEqual({ seen: wanted, why: null });
    expect(read([...whole].map(byte => Uint8Array.of(byte)))).toEqual({ seen: wanted, why: null });
    for (let seed = 1; seed <= 200; seed++) {
      const random = seededRandom(seed);
      const chunks: Uint8Array[] = [];
      for (let at = 0; at < whole.length; ) {
        const size = 1 + Math.floor(random() * 6);
        chunks.push(whole.subarray(at, at + size));
        at += size;
      }
      expect(read(chunks).seen).toEqual(wanted);
    }
  });

  test("a size below the header's ends it with a sentence", () => {
    expect(read([hex("00 02 56 01")]).why).toBe("A frame of RTDE has at least 3 bytes; one of 2 came.");
    expect(read([hex("00"), hex("00"), hex("56")]).why).toBe("A frame of RTDE has at least 3 bytes; one of 0 came.");
  });

  test("any bytes: no crash, frames within the bound, or a sentence", () => {
    for (let seed = 1; seed <= 300; seed++) {
      const random = seededRandom(seed);
      const frames = rtdeFrames();
      let why: string | null = null;
      for (let i = 0; i < 40 && why === null; i++) {
        const chunk = Uint8Array.from({ length: Math.floor(random() * 300) }, () => Math.floor(random() * 256));
        why = frames.push(chunk, (type, payload) => {
          expect(payload.length).toBeLessThan(0xffff);
          readText(payload, 1 + (seed % 2));
          readVersion(payload);
          outputsAsked(payload, 1 + (seed % 2));
          recipeAnswered(payload, type % 2 === 0);
          unpackData(recipeOf(1, [field("actual_q")]), payload, new Float64Array(SLOTS));
        });
      }
      if (why !== null) expect(why).toMatch(/^A frame of RTDE .*\.$/);
    }
  });
});
