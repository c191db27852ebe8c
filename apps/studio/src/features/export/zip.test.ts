import { emptyProgram, robotById } from "@twincell/core";
import { krl } from "@twincell/languages";
import { strFromU8, unzipSync } from "fflate";
import { expect, test } from "vitest";
import { manifestOf } from "./manifest.ts";
import { zipped } from "./zip.ts";

test("L-57 an export is one archive: every file as it stands, with the manifest; the same program gives the same bytes", () => {
  const robot = robotById("kuka_kr6_2")!;
  const program = {
    ...emptyProgram(robot.id, "Stack"),
    steps: [
      {
        id: "a",
        type: "move" as const,
        path: "ptp" as const,
        target: { q: [...robot.home_rad] },
        speed: { ratio: 0.5 },
        blend_m: 0,
      },
    ],
  };
  const emitted = krl.emit(program, robot);
  if (emitted.kind === "cannot") throw new Error(emitted.sentence);
  const files = [...emitted.files, { name: "manifest.json", text: manifestOf(program, "krl", emitted.files, null) }];
  const archive = zipped(files);
  expect(
    Object.fromEntries(Object.entries(unzipSync(archive)).map(([name, bytes]) => [name, strFromU8(bytes)])),
  ).toEqual(Object.fromEntries(files.map(({ name, text }) => [name, text])));
  expect(JSON.parse(strFromU8(unzipSync(archive)["manifest.json"]!))).toMatchObject({
    format: "twincell.export",
    files: [{ name: "STACK.src" }, { name: "STACK.dat" }],
  });
  expect(zipped(files)).toEqual(archive);
});
