/** Lines of a virtual robot and nodes of an OPC UA server that asyncua runs follow each other. */
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterEach, expect, test } from "vitest";
import { freePort } from "../../testing/free-port.ts";
import { foreignScript, isMissing, plant, UR, type Plant, type Script } from "../testing/foreign.ts";
import { readPlcFile } from "./plc-file.ts";

let open: Plant | undefined;
let script: Script | undefined;
afterEach(async () => {
  await open?.close();
  open = undefined;
  script?.process.kill("SIGKILL");
});
const written = (value: unknown): string => {
  const path = join(mkdtempSync(join(tmpdir(), "twincell-plc-")), "plc.json");
  writeFileSync(path, JSON.stringify(value));
  return path;
};
const file = (port: number, index: number) => ({
  format: "twincell.plc",
  version: 1,
  url: `opc.tcp://127.0.0.1:${port}/plc`,
  signals: [
    { node: `ns=${index};s=PartThere`, robot: "arm", line: "digital_in_0", from: "plc" },
    { node: `ns=${index};s=Grip`, robot: "arm", line: "digital_in_0", from: "robot" },
  ],
});

test.skipIf(isMissing("asyncua"))(
  "a node of asyncua's server sets an input of a virtual robot, and a line of the robot sets a node there",
  async () => {
    const port = await freePort("127.0.0.1");
    script = foreignScript("plc_server.py", String(port));
    const { index } = await script.next();
    open = await plant({ plc: written(file(port, Number(index))) }, UR);
    const lineOf = async (): Promise<unknown> => {
      const { sample } = (await open!.ask("GET", "/robots/arm/state")) as {
        readonly sample: { readonly signals?: Readonly<Record<string, unknown>> } | null;
      };
      return sample?.signals?.["digital_in_0"];
    };
    await expect.poll(lineOf).toBe(false);
    script.say({ part: true });
    // The line follows the node, and the other node follows the line.
    expect(await script.next()).toEqual({ grip: true });
    expect(await lineOf()).toBe(true);
    script.say({ part: false });
    expect(await script.next()).toEqual({ grip: false });
  },
  40_000,
);

test("a file of PLC signals is refused with the place of what is wrong, and one of a later release with both versions", () => {
  const good = file(4840, 2);
  expect(readPlcFile(written(good)).signals).toHaveLength(2);
  expect(() => readPlcFile(written({ ...good, version: 2 }))).toThrow(
    "it is of version 2; this release reads version 1",
  );
  expect(() => readPlcFile(written({ ...good, url: "http://plc" }))).toThrow("url");
  expect(() => readPlcFile(written({ ...good, signals: [{ ...good.signals[0], from: "sky" }] }))).toThrow(
    "signals.0.from",
  );
});
