import { seededRandom } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { bench, HOST, RX90L, shifted, type Cs7Bench } from "../testing/bench.ts";

const farthest = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(b, (q, i) => Math.abs(q - a[i]!)));
const DEG = Math.PI / 180;

/** A terminal: what comes back after a line was typed. */
async function terminal({ scheduler, network }: Cs7Bench) {
  const connected = network.connect({ host: HOST, port: 4001 });
  await scheduler.elapse(0.01);
  const answer = await connected;
  if (answer.kind === "refused") throw new Error(answer.sentence);
  let text = "";
  let over = false;
  answer.stream.onBytes(lent => {
    text += String.fromCharCode(...lent);
  });
  answer.stream.onEnd(() => {
    over = true;
  });
  const send = (bytes: Uint8Array): void => {
    answer.stream.send(bytes);
  };
  return {
    over: () => over,
    close: () => {
      answer.stream.close();
    },
    send,
    heard: () => text,
    async type(line: string, s = 0.02): Promise<string> {
      text = "";
      send(Uint8Array.from(`${line}\r`, sign => sign.charCodeAt(0)));
      await scheduler.elapse(s);
      return text;
    },
  };
}
async function alone(more: Parameters<typeof bench>[0] = {}) {
  const made = await bench(more);
  made.real.disconnect();
  await made.scheduler.elapse(0.1);
  return { ...made, at: await terminal(made) };
}

describe("the monitor", () => {
  test("commands are echoed, answered and prompted for, in capitals or not, whole or shortened; errors stand between asterisks", async () => {
    const { at } = await alone();
    expect((await at.type("where")).replaceAll("-0.000", " 0.000")).toBe(
      "where\r\n   X         Y         Z         y         p         r       Hand\r\n     0.000     0.000  1185.000     0.000     0.000     0.000     0.000\r\n   J1        J2        J3        J4        J5        J6     \r\n     0.000   -90.000    90.000     0.000     0.000     0.000\r\n.",
    );
    expect(await at.type("")).toBe("\r\n.");
    expect(await at.type("en po")).toBe("en po\r\n.");
    expect(await at.type("speed 10.00")).toBe("speed 10.00\r\n.");
    expect(await at.type("SPEED 0")).toBe("SPEED 0\r\n*Illegal value*\r\n.");
    expect(await at.type("FLY")).toBe("FLY\r\n*Illegal monitor command*\r\n.");
    expect(await at.type("DO a.b = 12.5")).toBe("DO a.b = 12.5\r\n.");
    expect(await at.type("LISTR a.b,STATE(1),STATE(2)")).toBe(
      "LISTR a.b,STATE(1),STATE(2)\r\na.b = 12.5\r\nSTATE(1) = 7\r\nSTATE(2) = 2\r\n.",
    );
    expect(await at.type("LISTR nothing")).toContain("*Undefined value*");
    expect(await at.type("EXECUTE 1 nothing")).toContain("*Undefined program or variable name*");
    expect(await at.type("SIGNAL 5,-6")).toBe("SIGNAL 5,-6\r\n.");
    expect(await at.type("HERE origin")).toMatch(/Change\? $/);
    expect(await at.type("")).toBe("\r\n.");
  });

  test("a motion of DO keeps the prompt until it has ended; PANIC and ABORT are heard before that", async () => {
    const { scheduler, cs7, at } = await alone();
    await at.type("DO SET #Q=#PPOINT(30,-80,80,0,10,0)");
    expect(await at.type("DO MOVE #Q", 0.3)).toBe("DO MOVE #Q\r\n");
    await scheduler.elapse(5);
    expect(at.heard()).toBe("DO MOVE #Q\r\n.");
    expect(
      farthest(
        cs7.arm.jointAngles(),
        [30, -80, 80, 0, 10, 0].map(value => value * DEG),
      ),
    ).toBeLessThan(1e-9);
    await at.type("DO MOVE #PPOINT(-30,-80,80,0,10,0)", 0.04);
    await at.type("WHERE", 0.04);
    expect(at.heard()).toBe("");
    await at.type("PANIC", 2);
    expect(at.heard()).toMatch(/^PANIC\r\n\*Robot power off\*\r\n\.WHERE/);
    expect([cs7.isPowered, cs7.arm.jointAngle(1) > 0]).toEqual([false, true]);
    expect(await at.type("DO MOVE #Q")).toBe("DO MOVE #Q\r\n*Robot power off*\r\n.");
  });

  test("N-62 a V+ text is loaded from the disk and replayed in a task beside the monitor; ABORT stops it, PROCEED takes it up", async () => {
    const { scheduler, cs7, at } = await alone();
    cs7.pendant.write(
      "JOB.V2",
      ".PROGRAM other()\n.END\n.PROGRAM job()\nMOVE #PPOINT(20,-80,80,0,0,0)\nMOVE #PPOINT(-20,-90,90,0,0,0)\n.END\n",
    );
    expect(await at.type("LOAD nothing")).toContain("*Nonexistent file*");
    expect(await at.type("LOAD job")).toBe("LOAD job\r\n.");
    expect(await at.type("DIR")).toContain(" .PROGRAM job");
    expect(await at.type("EXECUTE 1 job", 0.1)).toBe("EXECUTE 1 job\r\n.");
    expect(await at.type("LISTR STATE(2)")).toContain("STATE(2) = 1");
    expect(await at.type("EXECUTE 1 job")).toContain("*Program task already active*");
    expect(await at.type("ABORT 1", 1)).toContain("Program aborted");
    const rest = cs7.arm.jointAngles();
    await scheduler.elapse(1);
    expect(cs7.arm.jointAngles()).toEqual(rest);
    expect(await at.type("PROCEED 1", 6)).toContain("Program completed\r\n.");
    expect(
      farthest(
        cs7.arm.jointAngles(),
        [-20, -90, 90, 0, 0, 0].map(value => value * DEG),
      ),
    ).toBeLessThan(1e-9);
    cs7.pendant.write("BAD.V2", ".PROGRAM bad()\nJUMP HIGH\n.END\n");
    await at.type("LOAD bad");
    expect(await at.type("EXECUTE bad")).toContain("*Unexpected text* line 2");
  });

  test("high power asks for a hand on its button; after a boot the robot is to be calibrated, and the question is answered", async () => {
    const { scheduler, cs7, at } = await alone({ virtual: { presses_s: null } });
    await at.type("DISABLE POWER", 1);
    expect(await at.type("ENABLE POWER")).toContain("Press HIGH POWER button");
    await scheduler.elapse(1);
    expect(cs7.isPowered).toBe(false);
    cs7.pendant.pressHighPower();
    expect(cs7.isPowered).toBe(true);
    cs7.pendant.setEmergencyStop(true);
    await scheduler.elapse(1);
    expect(await at.type("ENABLE POWER")).toContain("*E-STOP circuit is open*");
    cs7.pendant.setEmergencyStop(false);
    cs7.reboot();
    const again = await bench({});
    again.real.disconnect();
    const fresh = await terminal(again);
    again.cs7.reboot();
    await again.scheduler.elapse(3);
    const booted = await terminal(again);
    expect([fresh.over(), await booted.type("ENABLE POWER", 1)]).toEqual([
      true,
      "ENABLE POWER\r\nPress HIGH POWER button to enable power\r\n.",
    ]);
    expect(await booted.type(`DO MOVE #PPOINT(${RX90L.home_rad.map(q => q / DEG).join(",")})`)).toContain(
      "*Robot not calibrated*",
    );
    expect(await booted.type("CALIBRATE")).toBe("CALIBRATE\r\nAre you sure (Y/N)? ");
    expect(await booted.type("N")).toBe("N\r\n.");
    await booted.type("CALIBRATE");
    await booted.type("Y");
    expect(again.cs7.calibrated).toBe(true);
  });

  test("any bytes: logged once for each connection, cut off, and the next one is served (200 connections)", async () => {
    const made = await alone();
    const random = seededRandom(5);
    for (let i = 0; i < 200; i++) {
      const before = made.log.length;
      const one = await terminal(made);
      for (let k = 0; k < 3 && !one.over(); k++) {
        one.send(Uint8Array.from({ length: 60 }, () => Math.floor(random() * 256)));
        await made.scheduler.elapse(0.01);
      }
      expect(made.log.length - before).toBeLessThanOrEqual(1);
      one.close();
    }
    expect(made.log.length).toBeGreaterThan(150);
    const endless = await terminal(made);
    for (let i = 0; i < 20; i++) endless.send(new Uint8Array(100).fill(65));
    await made.scheduler.elapse(0.1);
    expect(endless.over()).toBe(true);
    const flood = await terminal(made);
    flood.send(new Uint8Array(5000).fill(13));
    await made.scheduler.elapse(0.1);
    expect(flood.over()).toBe(true);
    expect(await (await terminal(made)).type("")).toBe("\r\n.");
    expect(farthest(made.cs7.arm.jointAngles(), shifted(0))).toBe(0);
  });
});
