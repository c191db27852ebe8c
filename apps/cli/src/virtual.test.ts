import { spawn, spawnSync } from "node:child_process";
import { connect } from "node:net";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import { expect, test } from "vitest";

const root = fileURLToPath(new URL("../../../", import.meta.url));
const MAIN = ["apps/cli/src/main.ts", "virtual"];
const wrong = (...args: string[]): { readonly code: number | null; readonly err: string } => {
  const { status, stderr } = spawnSync(process.execPath, [...MAIN, ...args], { cwd: root, encoding: "utf8" });
  return { code: status, err: stderr };
};
/** The first line that a dashboard says after its banner. */
const asked = (host: string, port: number, question: string): Promise<string> =>
  new Promise((resolve, reject) => {
    const socket = connect({ host, port }, () => {
      socket.write(`${question}\n`);
    });
    const seen: string[] = [];
    socket.on("error", reject);
    createInterface({ input: socket }).on("line", line => {
      if (seen.push(line) === 2) {
        socket.destroy();
        resolve(line);
      }
    });
  });

test("virtual starts a controller that says where it listens, hears words for its pendant, and ends when it is told to", async () => {
  const host = "127.0.0.47";
  const child = spawn(process.execPath, [...MAIN, "ur", "--host", host, "--port-dashboard", "0", "--json"], {
    cwd: root,
    stdio: ["pipe", "pipe", "inherit"],
  });
  try {
    const lines = createInterface({ input: child.stdout })[Symbol.asyncIterator]();
    const said = JSON.parse((await lines.next()).value as string) as {
      brand: string;
      robot: string;
      host: string;
      ports: Record<string, number>;
    };
    expect(said).toMatchObject({
      brand: "ur",
      robot: "ur10e",
      host,
      ports: { primary: 30_001, secondary: 30_002, realTime: 30_003, rtde: 30_004 },
    });
    const dashboard = said.ports["dashboard"]!;
    expect(dashboard).not.toBe(29_999);
    expect(await asked(host, dashboard, "robotmode")).toBe("Robotmode: RUNNING");
    child.stdin.write("manual\nstop\ndance\n");
    expect([(await lines.next()).value, (await lines.next()).value]).toEqual(["manual", "stop"]);
    expect((await lines.next()).value).toContain('no "dance" at the pendant');
    expect(await asked(host, dashboard, "is in remote control")).toBe("false");
    expect(await asked(host, dashboard, "safetymode")).toBe("Safetymode: ROBOT_EMERGENCY_STOP");
    const taken = wrong("ur", "--host", host);
    expect([taken.code, taken.err]).toEqual([2, expect.stringContaining("30001") as string]);
    const ended = new Promise(resolve => {
      child.once("exit", resolve);
    });
    child.kill("SIGTERM");
    expect(await ended).toBe(0);
  } finally {
    child.kill("SIGKILL");
  }
}, 120_000);

test("virtual: wrong use is named", () => {
  for (const [args, words] of [
    [[], "BRAND is missing"],
    [["acme"], 'There is no virtual controller of "acme"'],
    [["ur", "--port-rtde", "99999"], "--port-rtde wants a whole number"],
    [["ur", "--robot", "kuka_lbr_iiwa_14_r820", "--host", "127.0.0.48"], "has 7 joints"],
  ] as const) {
    const { code, err } = wrong(...args);
    expect([code, err]).toEqual([2, expect.stringContaining(words) as string]);
  }
}, 120_000);
