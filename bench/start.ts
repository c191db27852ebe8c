import {
  driverKindById,
  createSharedCell,
  openRobotConnection,
  startSynchronized,
  type VendorConnection,
  type Commander,
} from "@twincell/controllers";
import { emptyProgram, pose, robotById, seededRandom, type Program } from "@twincell/core";
import { dialectById } from "@twincell/languages";
import { prepareJobInWorker, nodeNetwork, nodeScheduler } from "@twincell/server";
import { setTimeout as pause } from "node:timers/promises";
import { figure, settled, type Bench, type Figure } from "./figure.ts";

const OF = [
  ["ur", "ur10e", "127.0.0.61"],
  ["kuka", "kuka_kr6r900sixx", "127.0.0.62"],
  ["yaskawa", "yaskawa_gp8", "127.0.0.63"],
] as const;
const REPEATS = 5;

/**
 * How far apart robots begin that are started together: virtual controllers of three makers on loopback sockets, each
 * with its program as text of its own language, all in this process with its own timers. And what it costs a guard to
 * look at the other robot once a sample.
 */
export const run: Bench = async () => [...(await spread()), ...looks()];

function program(id: string): Program {
  const { home_rad } = robotById(id)!;
  const to = (name: string, by: number) =>
    ({
      id: name,
      type: "move",
      path: "ptp",
      target: { q: home_rad.map((q, k) => (k === 0 ? q + by : q)) },
      speed: { ratio: 0.3 },
      blend_m: 0,
    }) as const;
  return { ...emptyProgram(id, "To and fro"), steps: [to("a", 0.3), to("b", 0)] };
}

async function spread(): Promise<Figure[]> {
  const network = nodeNetwork();
  const programs = prepareJobInWorker();
  const closes: (() => void)[] = [];
  const members: { station: VendorConnection; seat: Commander; program: Program }[] = [];
  try {
    for (const [id, robotId, host] of OF) {
      const brand = driverKindById(id)!;
      const robot = robotById(robotId)!;
      const dialect = dialectById(brand.dialect)!;
      const started = await brand.virtual({
        robot,
        scheduler: nodeScheduler,
        network,
        host,
        interpret: text => dialect.interpret(text, robot),
      });
      if (started.kind === "taken") throw new Error(started.sentence);
      closes.push(() => {
        started.virtual.close();
      });
      const opened = await openRobotConnection({
        id,
        brand,
        robot,
        scheduler: nodeScheduler,
        dialect,
        deadMan: false,
        layOut: programs.layOut,
        at: { network, host, ports: started.virtual.ports },
      });
      if (opened.kind === "refused") throw new Error(opened.why.sentence);
      closes.push(() => {
        opened.station.close();
      });
      const seat = opened.station.commander("bench");
      const connected = await opened.station.connect();
      if (connected.kind !== "done") throw new Error(connected.why.sentence);
      seat.acquireLease();
      members.push({ station: opened.station, seat, program: program(robotId) });
    }
    await pause(500);
    for (const { seat, station } of members) await seat.robot.moveJoints(station.controller.robot.home_rad);
    const spreads_ms: number[] = [];
    // A first round that is not counted: what the compiler has not seen yet keeps the links waiting.
    for (let i = 0; spreads_ms.length < REPEATS && i < 4 * REPEATS; i++) {
      for (const { seat } of members) seat.acknowledge();
      const { outcome } = await startSynchronized(
        members.map(({ station, seat, program: its }) => ({
          station,
          prepare: () => station.prepare(seat, its, true),
        })),
        nodeScheduler,
        ({ spread_s }) => {
          if (i > 0) spreads_ms.push(1000 * spread_s);
        },
      );
      if (outcome.kind !== "done") process.stderr.write(`A round did not count: ${outcome.why.sentence}\n`);
      await pause(300);
    }
    return [
      figure(
        "start/spread",
        "ms",
        spreads_ms,
        "UR, KUKA and Yaskawa on loopback sockets, from the first to the last seen moving; bound 50",
      ),
    ];
  } finally {
    for (const close of closes.reverse()) close();
    programs.close();
  }
}

function looks(): Figure[] {
  const ur = robotById("ur10e")!;
  const kuka = robotById("kuka_kr6r900sixx")!;
  const random = seededRandom(5);
  const figures: Figure[] = [];
  for (const [name, apart_m] of [
    ["guard/other-far", 4],
    ["guard/other-near", 1.2],
  ] as const) {
    const cell = createSharedCell();
    const mine = cell.join({ id: "a", name: "a", robot: ur, worldFromBase: pose() });
    const other = cell.join({
      id: "b",
      name: "b",
      robot: kuka,
      worldFromBase: { ...pose([apart_m, 0, 0]), quaternion: [0, 0, 1, 0] },
    });
    const q = Float64Array.from(ur.home_rad);
    const ahead = Float64Array.from(ur.home_rad);
    const its = Float64Array.from(kuka.home_rad);
    const its2 = Float64Array.from(kuka.home_rad);
    const configurations: number[][] = [];
    its2[0] = its2[0]! + 0.1;
    other.tell(its, its2);
    // Those at which it may go on: a stop is told once, with its exact distance, and is not what is measured.
    for (let tries = 0; configurations.length < 64 && tries < 10_000; tries++) {
      const at = ur.home_rad.map(angle => angle + 1.2 * (random() - 0.5));
      mine.tell(
        at,
        at.map(angle => angle + 0.05),
      );
      if (mine.tooNear() === null) configurations.push(at);
    }
    figures.push(
      figure(
        name,
        "us",
        settled(200, 15, 10, i => {
          const at = configurations[i % configurations.length]!;
          for (let k = 0; k < q.length; k++) {
            q[k] = at[k]!;
            ahead[k] = at[k]! + 0.05;
          }
          mine.tell(q, ahead);
          mine.tooNear();
        }),
        "one look of a guard at one other robot that moves: four pairs of postures",
      ),
    );
  }
  return figures;
}
