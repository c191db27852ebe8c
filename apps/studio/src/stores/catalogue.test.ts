import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { robotById } from "@twincell/core";
import { saveDocument, tracedCartonCell } from "@twincell/project";
import { expect, test } from "vitest";
import { openSaved } from "./catalogue.ts";
import { cellStore } from "./cell.ts";
import { showDocument, theProgram } from "./document.ts";
import { languagesOf } from "./languages.ts";
import { changeRobot } from "./robot.ts";

const source = fileURLToPath(new URL("..", import.meta.url));

test("the data of the catalogue are no part of what the page loads at its start: only workers import them as they begin", () => {
  const importing = readdirSync(source, { recursive: true, encoding: "utf8" })
    .filter(path => /(?<!test)\.tsx?$/.test(path))
    .filter(path => /^import .*"@twincell\/core\/catalogue"/m.test(readFileSync(join(source, path), "utf8")));
  expect(importing.map(path => path.replaceAll("\\", "/"))).toEqual(["workers/know-robots.ts"]);
});

test("a saved cell with a robot of the catalogue opens once the catalogue was fetched, and not before", async () => {
  expect(robotById("ur5e")).toBeUndefined();
  const text = saveDocument(tracedCartonCell()).replaceAll("staubli_rx90l", "ur5e");
  const opened = await openSaved(text);
  expect(opened.kind).toBe("opened");
  expect(robotById("ur5e")).toMatchObject({ vendor: "Universal Robots" });
});

test("a robot of the catalogue takes the place of the one in the cell, its program taught anew tip by tip; it is exported in its maker's language, and every other says why not", () => {
  showDocument(tracedCartonCell());
  const { steps } = theProgram()!;
  expect(changeRobot("kuka_kr20_r1810_2")).toBe(true);
  expect(cellStore.getState().document!.robot.id).toBe("kuka_kr20_r1810_2");
  expect(theProgram()!.robot).toBe("kuka_kr20_r1810_2");
  expect(theProgram()!.steps).toHaveLength(steps.length);
  const languages = languagesOf(robotById("kuka_kr20_r1810_2")!);
  expect(languages.filter(({ why }) => why === null).map(({ dialect }) => dialect.id)).toEqual(["krl", "l-irl"]);
  for (const { why } of languages) expect(why === null || /\.$/.test(why)).toBe(true);
});
