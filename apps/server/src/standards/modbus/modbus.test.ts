/** States, lines and stops by Modbus TCP, asked for by pymodbus: `npm run clients` installs it. */
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { robotById } from "@twincell/core";
import { afterEach, expect, test } from "vitest";
import { foreignScript, isMissing, plant, type Plant } from "../testing/foreign.ts";
import { readModbusLines } from "./table.ts";

let open: Plant | undefined;
afterEach(async () => {
  await open?.close();
  open = undefined;
});
const home = robotById("ur10e")!.home_rad;
const turned = (by_rad: number): number[] => home.map((q, i) => (i === 0 ? q + by_rad : q));

test.skipIf(isMissing("pymodbus"))(
  "pymodbus reads state and joints to 0.001°, writes inputs of a virtual controller, is told what cannot be read or written, and stops a motion",
  async () => {
    open = await plant({ modbus: 0 });
    const script = foreignScript("modbus_client.py", open.port("Modbus"));
    const { sample } = (await open.ask("GET", "/robots/arm/state")) as { sample: { q_rad: number[] } };
    const read = await script.next();
    expect(read["joints"]).toEqual(sample.q_rad.map(q => Math.round((q * 180_000) / Math.PI)));
    expect((read["head"] as number[])[0]! & 1).toBe(1);
    expect((read["head"] as number[])[2]).toBe(6);
    expect(read).toMatchObject({ holding: true, wrote: true, many: true, coils: [true, false, false, true] });
    expect(read["inputs"]).toEqual(read["coils"]);
    expect(read).toMatchObject({ none: { exception: 2 }, register: 2 });
    expect(await script.next()).toEqual({
      count0: "00030000000301" + "8303",
      unknown: "00040000000301" + "e301",
      split: "00050000000501" + "04020006",
    });
    expect(await script.next()).toEqual({ garbage: "" });
    const lease = await open.lease();
    const moved = open.ask("POST", "/robots/arm/move", { q_rad: turned(2) }, lease);
    for (;;) {
      const { sample: now } = (await open.ask("GET", "/robots/arm/state")) as { sample: { moving: boolean } };
      if (now.moving) break;
    }
    script.say("go");
    expect(await script.next()).toEqual({ moving: 2 });
    expect(await script.next()).toEqual({ stopped: true });
    expect(await moved).toMatchObject({ kind: "stopped" });
    await script.ended();
  },
  60_000,
);

test("a file of lines that cannot be read is refused with its place", () => {
  const path = join(mkdtempSync(join(tmpdir(), "twincell-lines-")), "lines.json");
  const read = (value: unknown): ReadonlyMap<string, readonly string[]> => {
    writeFileSync(path, typeof value === "string" ? value : JSON.stringify(value));
    return readModbusLines(path);
  };
  expect(read({ format: "twincell.modbus", version: 1, robots: { arm: ["a", "b"] } }).get("arm")).toEqual(["a", "b"]);
  expect(() => read({ format: "twincell.modbus", version: 1, robots: { arm: [1] } })).toThrow("robots.arm is no list");
  expect(() => read({ format: "twincell.modbus", version: 2, robots: {} })).toThrow("no file of lines of version 1");
  expect(() => read("{ half")).toThrow(path);
});
