/** Messages written out by hand from the samples of the protocol specification, not by our encoder. */
import { seededRandom } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { C3_MAX_BYTES, C3Reader, C3Writer, isC3Type } from "./c3.ts";
import { readC3Reply, writeC3Reply, type C3Reply } from "./c3-replies.ts";
import { readC3Request, writeC3Request, type C3Request } from "./c3-requests.ts";

const hex = (text: string): Uint8Array => Uint8Array.from(text.trim().split(/\s+/), byte => Number.parseInt(byte, 16));
const ascii = (text: string): string => [...text].map(sign => sign.charCodeAt(0).toString(16)).join(" ");
const wide = (text: string): string => [...text].map(sign => `${sign.charCodeAt(0).toString(16)} 0`).join(" ");
type Sent = Exclude<C3Request, { readonly kind: "malformed" }>;
type Answer = Exclude<C3Reply, { readonly kind: "malformed" }>;

/** [what, tag, request, its bytes] as the specification prints them. */
const REQUESTS: readonly (readonly [string, number, Sent, string])[] = [
  ["0 read, ASCII", 256, { kind: "read", wide: false, name: "$ACCU_STATE" }, `1 0 0 e 0 0 b ${ascii("$ACCU_STATE")}`],
  [
    "1 write, ASCII",
    256,
    { kind: "write", wide: false, name: "$VEL_ACT", value: "10.2" },
    `1 0 0 11 1 0 8 ${ascii("$VEL_ACT")} 0 4 ${ascii("10.2")}`,
  ],
  ["4 read", 512, { kind: "read", wide: true, name: "$ACT_BASE" }, `2 0 0 15 4 0 9 ${wide("$ACT_BASE")}`],
  [
    "5 write",
    256,
    { kind: "write", wide: true, name: "$VEL_ACT", value: "5" },
    `1 0 0 17 5 0 8 ${wide("$VEL_ACT")} 0 1 ${wide("5")}`,
  ],
  [
    "6 read many",
    1024,
    { kind: "read-many", names: ["PING", "@PROXY_PORT"] },
    `4 0 0 24 6 2 0 4 ${wide("PING")} 0 b ${wide("@PROXY_PORT")}`,
  ],
  [
    "7 write many",
    1024,
    { kind: "write-many", pairs: [{ name: "$VEL_ACT", value: "5" }] },
    `4 0 0 18 7 1 0 8 ${wide("$VEL_ACT")} 0 1 ${wide("5")}`,
  ],
  ["10 reset the submit interpreter", 652, { kind: "control", command: 1, interpreter: 0 }, "2 8c 0 4 a 1 0 0"],
  [
    "10 select",
    1,
    { kind: "select", run: false, name: "/R1/A", parameters: "", force: true },
    `0 1 0 13 a 5 0 1 0 5 ${wide("/R1/A")} 0 0 1`,
  ],
  ["13 about the proxy", 0, { kind: "info" }, "0 0 0 1 d"],
  ["14 what it can do", 0, { kind: "features" }, "0 0 0 1 e"],
  ["29 a buffer to write a file", 3, { kind: "put-begin", size: 70_000 }, "0 3 0 6 1d 1 0 1 11 70"],
  [
    "29 a piece of it",
    3,
    { kind: "put-data", offset: 256, data: Uint8Array.of(1, 2, 3) },
    "0 3 0 d 1d 2 0 0 1 0 0 0 0 3 1 2 3",
  ],
  ["29 its end", 3, { kind: "put-end", flags: 64, name: "A" }, `0 3 0 a 1d 4 0 0 0 40 0 1 ${wide("A")}`],
  ["30 a piece to read", 9, { kind: "get-data", offset: 0, most: 0xffffffff }, "0 9 0 a 1e 2 0 0 0 0 ff ff ff ff"],
  ["63 confirm all messages", 7, { kind: "confirm-all" }, "0 7 0 1 3f"],
];
const REPLIES: readonly (readonly [string, number, number, Answer, string])[] = [
  ["0", 256, 0, { kind: "value", value: "#CHARGE_OK", error: 1 }, `1 0 0 10 0 0 a ${ascii("#CHARGE_OK")} 0 1 1`],
  ["1", 256, 1, { kind: "value", value: "10.2", error: 1 }, `1 0 0 a 1 0 4 ${ascii("10.2")} 0 1 1`],
  ["4", 512, 4, { kind: "value", value: "1", error: 1 }, `2 0 0 8 4 0 1 ${wide("1")} 0 1 1`],
  [
    "6",
    1024,
    6,
    {
      kind: "values",
      items: [
        { error: 1, value: "PONG" },
        { error: 1, value: "7000" },
      ],
      error: 1,
    },
    `4 0 0 1b 6 2 1 0 4 ${wide("PONG")} 1 0 4 ${wide("7000")} 0 1 1`,
  ],
  [
    "7",
    1024,
    7,
    { kind: "values", items: [{ error: 1, value: "5" }], error: 1 },
    `4 0 0 a 7 1 1 0 1 ${wide("5")} 0 1 1`,
  ],
  ["10", 652, 10, { kind: "control", command: 1, error: 1 }, "2 8c 0 5 a 1 0 1 1"],
  [
    "14",
    0,
    14,
    { kind: "features", types: [0, 1, 4, 5, 6, 7, 10, 11, 12, 13, 14, 63], error: 1 },
    `0 0 0 24 e ${"0 ".repeat(24)}80 ${"0 ".repeat(5)}7c f3 0 1 1`,
  ],
  [
    "29",
    3,
    29,
    { kind: "file", step: 2, offset: 256, size: 3, data: new Uint8Array(), error: 1 },
    "0 3 0 d 1d 2 0 0 1 0 0 0 0 3 0 1 1",
  ],
  [
    "30",
    9,
    30,
    { kind: "file", step: 2, offset: 0, size: 2, data: Uint8Array.of(65, 66), error: 1 },
    "0 9 0 f 1e 2 0 0 0 0 0 0 0 2 41 42 0 1 1",
  ],
  ["an error", 5, 6, { kind: "plain", error: 9 }, "0 5 0 4 6 0 9 0"],
];

describe("messages of the C3 Bridge Interface", () => {
  test.each(REQUESTS)("%s: byte for byte, there and back", (_, tag, request, text) => {
    const bytes = hex(text);
    expect(writeC3Request(new C3Writer(), tag, request)).toEqual(bytes);
    expect(readC3Request(bytes[4]!, bytes.subarray(5))).toEqual(request);
  });
  test.each(REPLIES)("the answer of type %s: byte for byte, there and back", (_, tag, type, reply, text) => {
    const bytes = hex(text);
    expect(writeC3Reply(new C3Writer(), tag, type, reply)).toEqual(bytes);
    expect(readC3Reply(type, bytes.subarray(5))).toEqual(reply);
  });

  test("in pieces of any size and run together they are the same messages", () => {
    const all = REQUESTS.map(([, , , text]) => hex(text));
    const stream = Uint8Array.from(all.flatMap(bytes => [...bytes]));
    for (const size of [1, 2, 3, 7, 64, stream.length]) {
      const reader = new C3Reader();
      const got: number[][] = [];
      for (let at = 0; at < stream.length; at += size) {
        const lent = stream.slice(at, at + size);
        expect(
          reader.push(lent, (tag, type, payload) => {
            got.push([tag >> 8, tag & 255, (payload.length + 1) >> 8, (payload.length + 1) & 255, type, ...payload]);
            return true;
          }),
        ).toBeNull();
        lent.fill(0xee);
      }
      expect(got).toEqual(all.map(bytes => [...bytes]));
      expect(reader.partial).toBe(false);
    }
  });

  test("a message without a type ends the stream with a sentence; what does not fit into a message is no message", () => {
    expect(new C3Reader().push(hex("0 1 0 0"), () => true)).toContain("length 0");
    const out = new C3Writer();
    const long = "x".repeat(40_000);
    expect(writeC3Request(out, 1, { kind: "write", wide: true, name: "A", value: long })).toBeNull();
    const reply = writeC3Reply(out, 1, 6, { kind: "values", items: [{ error: 1, value: long }], error: 1 });
    expect([...reply]).toEqual([0, 1, 0, 4, 6, 0, 10, 0]);
  });

  test("types: named by the specification, reserved, free", () => {
    expect([0, 7, 10, 17, 20, 30, 50, 66, 255].map(isC3Type)).toEqual(Array(9).fill(true));
    expect([8, 9, 18, 31, 49, 67, 129, 254].map(isC3Type)).toEqual(Array(8).fill(false));
  });

  test("a payload that is cut off or has something behind it is malformed, never an exception", () => {
    for (const [, , , text] of REQUESTS) {
      const bytes = hex(text);
      const type = bytes[4]!;
      const payload = bytes.subarray(5);
      for (let cut = 0; cut < payload.length; cut++) {
        const read = readC3Request(type, payload.subarray(0, cut));
        // What is left of a list may be a shorter message of its own.
        if (read.kind !== "malformed") expect(read).not.toEqual(readC3Request(type, payload));
      }
      expect(readC3Request(type, Uint8Array.from([...payload, 0])).kind).toBe("malformed");
    }
  });

  test("any bytes: no crash, one sentence at most, never more than one message held (5,000 inputs)", () => {
    const random = seededRandom(1);
    for (let round = 0; round < 5_000; round++) {
      const bytes = Uint8Array.from({ length: Math.floor(random() * 60) }, () =>
        random() < 0.5 ? Math.floor(random() * 8) : Math.floor(random() * 256),
      );
      const reader = new C3Reader();
      reader.push(bytes, (_, type, payload) => {
        expect(payload.length).toBeLessThan(C3_MAX_BYTES);
        readC3Request(type, payload);
        readC3Reply(type, payload);
        return true;
      });
    }
  });
});
