import { manualScheduler, type Robot } from "@twincell/core";
import { DRIVER_KINDS, robotsOf } from "./brands.ts";
import type { Ability, Cannot, ControllerAdapter, AdapterOptions } from "./driver/index.ts";
import { memoryNetwork } from "./transport/index.ts";

/** One driver of the table: a brand, or another way to the same controller. */
export interface Driver {
  readonly name: string;
  /** Folder of its code and of its tests. */
  readonly folder: string;
  readonly id: string;
  readonly vendor: string;
  readonly drives?: (robot: Robot) => boolean;
  readonly cannot: readonly Cannot[];
  /**
   * Where it stands on another driver: the rows from T-19 on that tests of its own show; the others are shown through
   * that one.
   */
  readonly own?: readonly string[];
  /** How the names of those tests end. */
  readonly tests?: string;
  face(options: AdapterOptions): ControllerAdapter;
}

export const DRIVERS: readonly Driver[] = DRIVER_KINDS.flatMap((brand): Driver[] => {
  const { name, vendor, drives, cannot, otherWays = [] } = brand;
  const driver: Driver = {
    name,
    id: brand.id,
    folder: brand.id,
    vendor,
    ...(drives ? { drives } : {}),
    cannot,
    face: options => brand.face(options),
  };
  return [
    driver,
    ...otherWays.map(way => ({
      ...driver,
      name: way.name,
      cannot: way.cannot,
      own: way.shows,
      tests: way.tests,
      face: way.face,
    })),
  ];
});

/** T-01 … T-18 are the contract suite's, T-19 … T-27 the tests' of each driver. */
export const ROWS: readonly `T-${number}`[] = Array.from(
  { length: 27 },
  (_, i) => `T-${String(i + 1).padStart(2, "0")}` as `T-${number}`,
);
const ABILITIES: readonly { readonly row: Ability; readonly title: string }[] = [
  { row: "texts", title: "program texts" },
  { row: "signals", title: "signals" },
  { row: "override", title: "override" },
  { row: "payload", title: "load" },
  { row: "watch", title: "watch only" },
];

/** The face of a driver for a robot of its vendor, without a line: what it has and has not. */
export function unconnected(driver: Driver): ControllerAdapter {
  const scheduler = manualScheduler();
  const robot: Robot = robotsOf(driver).find(({ arm }) => arm.joints.length === 6)!;
  return driver.face({ robot, scheduler, network: memoryNetwork(scheduler), host: "127.0.0.1" });
}

/** What each driver declares, as tables in Markdown; what one cannot do stands below with its reason. */
export function driverTables(drivers: readonly Driver[]): string {
  const mark = (driver: Driver, row: string): string =>
    driver.cannot.some(cannot => cannot.row === row)
      ? "–"
      : row === "T-18"
        ? "holds"
        : !driver.own || driver.own.includes(row)
          ? "✓"
          : "(✓)";
  const lines = (rows: readonly (readonly string[])[]): string =>
    rows.map(cells => `| ${cells.join(" | ")} |`).join("\n");
  const table = (first: string, heads: readonly string[], of: (driver: Driver) => readonly string[]): string =>
    lines([
      [first, ...heads],
      ["---", ...heads.map(() => "---")],
      ...drivers.map(driver => [driver.name, ...of(driver)]),
    ]);
  const contract = ROWS.slice(0, 18);
  const wire = ROWS.slice(18);
  return [
    table("driver", contract, driver => contract.map(row => mark({ ...driver, own: contract }, row))),
    "T-18: an override of 0 holds every robot where it is; only virtual robots jump, so that no driver has `jumpTo`.",
    table("driver", wire, driver => wire.map(row => mark(driver, row))),
    "(✓): shown by the tests of the same brand's other driver, whose connection it uses.",
    table("driver", [...ABILITIES.map(({ title }) => title), "watchdog on the robot"], driver => {
      const { watchdog } = unconnected(driver);
      return [
        ...ABILITIES.map(({ row }) => mark({ ...driver, own: [row] }, row)),
        watchdog.kind === "robot" ? `${Math.round(1000 * watchdog.within_s)} ms` : "–",
      ];
    }),
    ...drivers.map(driver => {
      const { watchdog } = unconnected(driver);
      const reasons = [
        ...driver.cannot.map(({ row, because }) => `- ${row}: ${because}`),
        ...(watchdog.kind === "none" ? [`- watchdog: ${watchdog.because.replace(/\.?$/, ".")}`] : []),
      ];
      return `**${driver.name}** cannot\n\n${reasons.length === 0 ? "- nothing of the above is missing" : reasons.join("\n")}`;
    }),
  ].join("\n\n");
}
