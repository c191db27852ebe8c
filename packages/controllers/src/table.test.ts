import { manualScheduler } from "@twincell/core";
import { readdirSync, readFileSync } from "node:fs";
import { expect, test } from "vitest";
import {
  DRIVER_KINDS,
  createRealController,
  driverTables,
  DRIVERS,
  memoryNetwork,
  robotsOf,
  ROWS,
  unconnected,
} from "./index.ts";

const LINE: Readonly<Record<string, string>> = {
  ur: "digital_out_1",
  kuka: "$OUT[1]",
  yaskawa: "OT#(1)",
  fanuc: "DO[1]",
  abb: "DO1",
  staubli: "valve1",
  "staubli-cs7": "out_1",
};
const here = (path: string): URL => new URL(path, import.meta.url);

test("docs/controllers/README.md says what the drivers declare; after a change run scripts/write-controllers.mjs", () => {
  expect(readFileSync(here("../../../docs/controllers/README.md"), "utf8")).toContain(
    `<!-- tables -->\n\n${driverTables(DRIVERS)}\n\n<!-- end of tables -->`,
  );
});

test.each(DRIVERS.map(driver => [driver.name, driver] as const))(
  "every row of %s is a row, has its reason, and every ✓ of the second table has a test that names it",
  (_, { cannot, folder, own, tests = ".test.ts" }) => {
    for (const { row, because } of cannot) {
      expect([...ROWS, "texts", "signals", "override", "payload", "watch"]).toContain(row);
      expect(because).toMatch(/^[A-Z].*\.$/);
    }
    const files = readdirSync(here(`./${folder}`), { recursive: true, encoding: "utf8" })
      .filter(name => name.endsWith(tests))
      .map(name => here(`./${folder}/${name}`));
    const text = [
      ...files,
      here("./brands.test.ts"),
      here("./table.test.ts"),
      ...(own ? [] : [here(`../../../apps/server/src/${folder}.test.ts`)]),
    ]
      .map(file => readFileSync(file, "utf8"))
      .join("\n");
    const titles = [...text.matchAll(/\btest(?:\.\w+)*(?:\([^"`]*\))?\(\s*["`]([^\n]*)/g)]
      .map(([, title]) => title!)
      .join("\n");
    for (const row of own ?? ROWS.slice(18))
      if (cannot.every(each => each.row !== row)) expect(titles, row).toContain(row);
  },
);

test("T-21 every driver is a face that is handed in, and has what its row of the table says", () => {
  for (const driver of DRIVERS) {
    const adapter = unconnected(driver);
    const lacks = (row: string): boolean => driver.cannot.some(each => each.row === row);
    expect([driver.name, adapter.runText === undefined, adapter.setPayload === undefined]).toEqual([
      driver.name,
      lacks("texts"),
      lacks("payload"),
    ]);
    expect(createRealController({ face: adapter, scheduler: manualScheduler() }).jumpTo).toBeUndefined();
  }
});

test.each(DRIVER_KINDS.map(brand => [brand.id, brand] as const))(
  "signals and override of %s are taken, or refused where its row says so",
  async (id, brand) => {
    const scheduler = manualScheduler();
    const network = memoryNetwork(scheduler);
    const host = "127.0.0.9";
    const robot = robotsOf(brand).find(({ arm }) => arm.joints.length === 6)!;
    const started = await brand.virtual({
      robot,
      scheduler,
      network,
      host,
      interpret: () => ({ kind: "not-understood", faults: [] }),
    });
    if (started.kind === "taken") throw new Error(started.sentence);
    const adapter = brand.face({ robot, scheduler, network, host });
    const real = createRealController({ face: adapter, scheduler });
    const lacks = (row: string): boolean => brand.cannot.some(each => each.row === row);
    const connecting = real.connect();
    await scheduler.elapse(3);
    expect(await connecting).toEqual({ kind: "done" });
    expect(adapter.setSignal(LINE[id]!, true) !== null, "signals").toBe(lacks("signals"));
    expect(real.setSpeed(50).kind, "override").toBe(lacks("override") ? "refused" : "done");
    real.close();
    started.virtual.close();
  },
);
