import { manualScheduler, robotById } from "@twincell/core";
import { expect, test } from "vitest";
import { driverKindById } from "../brands.ts";
import { createRealController } from "../driver/index.ts";
import { memoryNetwork } from "../transport/index.ts";

test("the brand's driver and virtual controller find each other, two pairs on one machine; pendant and restart", async () => {
  const scheduler = manualScheduler();
  const network = memoryNetwork(scheduler);
  const brand = driverKindById("abb")!;
  const robot = robotById("abb_irb120")!;
  const pair = async (host: string) => {
    const started = await brand.virtual({
      robot,
      scheduler,
      network,
      host,
      interpret: () => ({ kind: "not-understood", faults: [] }),
    });
    if (started.kind === "taken") throw new Error(started.sentence);
    const { virtual } = started;
    const real = createRealController({
      face: brand.face({ robot, scheduler, network, host, ports: virtual.ports }),
      scheduler,
    });
    void real.connect();
    return { virtual, real };
  };
  const one = await pair("127.0.0.1");
  const two = await pair("127.0.0.2");
  await scheduler.elapse(0.2);
  const moving = [one.real.moveJoint(1, 0.4), two.real.moveJoint(1, -0.4)];
  await scheduler.elapse(3);
  expect(await Promise.all(moving)).toEqual([{ kind: "done" }, { kind: "done" }]);
  expect(one.virtual.jointAngles()[0]).toBeCloseTo(0.4, 4);
  expect(two.virtual.jointAngles()[0]).toBeCloseTo(-0.4, 4);
  one.virtual.pendant.emergencyStop(true);
  one.virtual.pendant.setInput("in_1", true);
  await scheduler.elapse(0.2);
  expect((await one.real.moveJoint(1, 0)).kind).toBe("refused");
  one.virtual.pendant.emergencyStop(false);
  one.virtual.reboot();
  await scheduler.elapse(8);
  one.virtual.pendant.setMode("remote");
  await scheduler.elapse(0.2);
  const again = one.real.moveJoint(1, 0);
  await scheduler.elapse(3);
  expect(await again).toEqual({ kind: "done" });
  one.virtual.close();
  two.virtual.close();
});
