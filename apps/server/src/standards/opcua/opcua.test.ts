/** The companion model for robots, read by asyncua: `npm run clients` installs it. */
import { robotById } from "@twincell/core";
import { afterEach, expect, test } from "vitest";
import { freePort } from "../../testing/free-port.ts";
import { foreignScript, isMissing, plant, UR, YASKAWA, type Plant, type Script } from "../testing/foreign.ts";

let open: Plant | undefined;
let script: Script | undefined;
afterEach(async () => {
  script?.process.kill("SIGKILL");
  await open?.close();
  open = undefined;
});
const robot = robotById(YASKAWA.model)!;

test.skipIf(isMissing("asyncua"))(
  "asyncua finds a motion device system for each robot with its axes in degrees, cannot write, is told of motion and of an emergency stop by subscription, and no longer finds a robot that was closed",
  async () => {
    const port = await freePort("127.0.0.1");
    open = await plant({ opcua: port }, YASKAWA);
    expect(await open.ask("POST", "/robots", { id: "second", ...UR })).toEqual({ kind: "done" });
    script = foreignScript("opcua_client.py", open.served.standards[0]!.replace("OPC UA: ", ""));
    const found = await script.next();
    const { robots } = (await open.ask("GET", "/robots")) as { readonly robots: readonly { readonly id: string }[] };
    expect(Object.keys(found["systems"] as object).sort()).toEqual(robots.map(({ id }) => id).sort());
    expect((found["systems"] as Record<string, unknown>)["arm"]).toEqual([true, 1002]);
    const { sample } = (await open.ask("GET", "/robots/arm/state")) as {
      readonly sample: { readonly q_rad: number[] };
    };
    (found["positions"] as number[]).forEach((degrees, i) => {
      expect(degrees).toBeCloseTo((sample.q_rad[i]! * 180) / Math.PI, 6);
    });
    expect(found).toMatchObject({
      unit: "°",
      write: "BadNotWritable",
      manufacturer: robot.vendor,
      model: robot.name,
      category: 1,
      override: 100,
      emergency: false,
      trains: 6,
      controls: ["arm"],
      moves: ["Axis_1"],
    });
    await script.next();
    const lease = await open.lease();
    const target = robot.home_rad.map((q, i) => (i === 0 ? q + 0.5 : q));
    await open.ask("POST", "/robots/arm/move", { q_rad: target }, lease);
    await open.ask("POST", "/robots/arm/stop", { emergency: true });
    const told = await script.next();
    expect(told["distinct"] as number).toBeGreaterThan(10);
    await open.ask("DELETE", "/robots/arm", undefined, lease);
    script.say("closed");
    expect(((await script.next())["closed"] as string[]).includes("arm")).toBe(false);
    await script.ended();
  },
  120_000,
);
