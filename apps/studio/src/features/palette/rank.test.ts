import { beforeAll, expect, test } from "vitest";
import { checkCommands } from "../../commands/check.ts";
import { editCommands } from "../../commands/edit.ts";
import { jogCommands } from "../../commands/jog.ts";
import { playCommands } from "../../commands/play.ts";
import { programCommands } from "../../commands/program.ts";
import { viewCommands } from "../../commands/view.ts";
import type { Command } from "../../stores/commands.ts";
import { words } from "../../messages/index.ts";
import { fileCommands } from "../../commands/file.ts";
import { commandScore } from "./rank.ts";

let commands: readonly Command[] = [];
beforeAll(() => {
  commands = [
    ...fileCommands(() => undefined),
    ...checkCommands({ now: () => undefined, cancel: () => undefined, close: () => undefined } as never),
    ...programCommands(),
    ...jogCommands(),
    ...playCommands(),
    ...viewCommands(),
    ...editCommands(),
    { id: "run.start", group: "program", words: words.commands.startRun, run: () => undefined },
  ];
});

function firstHit(query: string): string | undefined {
  const scored = commands.map(command => ({
    id: command.id,
    score: commandScore(query, command.words, command.aliases),
  }));
  const best = Math.max(...scored.map(({ score }) => score));
  return best > 0 ? scored.find(({ score }) => score === best)?.id : undefined;
}

const FIRST_HITS: readonly (readonly [query: string, id: string])[] = [
  ["theme", "view.theme"],
  ["dark", "view.theme"],
  ["light", "view.theme"],
  ["controls", "help.controls"],
  ["gamepad", "help.controls"],
  ["keyboard", "help.shortcuts"],
  ["shortcuts", "help.shortcuts"],
  ["undo", "edit.undo"],
  ["redo", "edit.redo"],
  ["run", "view.run"],
  ["run on", "run.start"],
  ["stop", "stop"],
  ["save", "file.save"],
  ["open", "file.load"],
  ["edge trace example", "file.example"],
  ["conveyor", "file.conveyor"],
  ["new", "file.new"],
  ["cells", "file.cells"],
  ["trash", "file.cells"],
  ["check", "view.check"],
  ["check now", "check.now"],
  ["repair", "check.repair-all"],
  ["teach", "view.teach"],
  ["history", "view.history"],
  ["trace", "trace.toggle"],
  ["edges", "trace.toggle"],
  ["record", "program.record-ptp"],
  ["lin", "program.record-lin"],
  ["ptp", "program.record-ptp"],
  ["touch", "program.touch-up"],
  ["wait", "program.wait"],
  ["wait for", "program.wait-for"],
  ["loop", "program.repeat"],
  ["comment", "program.comment"],
  ["play", "play.toggle"],
  ["pause", "play.toggle"],
  ["physics", "play.physics"],
  ["robot", "cell.robot"],
  ["export", "export.open"],
  ["import", "export.import"],
  ["home", "jog.ready"],
  ["zero", "jog.zero"],
  ["collision", "view.collision"],
  ["mute", "view.mute"],
  ["main or close", "view.camera"],
  ["plots", "view.plots"],
  ["box", "cell.box"],
  ["delete", "program.delete"],
  ["duplicate", "program.duplicate"],
  ["clear", "program.clear"],
  ["headset", "view.headset"],
];

test.each(FIRST_HITS)("the first hit of “%s” is %s", (query, id) => {
  expect(firstHit(query)).toBe(id);
});

test("ids are no match text, and what no title says finds nothing", () => {
  expect(firstHit("xyzzy")).toBeUndefined();
  expect(firstHit("edit.undo")).toBeUndefined();
  expect(firstHit("program record-ptp")).toBeUndefined();
});

test("a whole title goes before a beginning, that before the beginning of a word, that before letters inside one", () => {
  const scores = ["run", "run here", "dry run", "prune"].map(title => commandScore("run", title));
  expect([...scores].sort((a, b) => b - a)).toEqual(scores);
  expect(new Set(scores).size).toBe(4);
});
