import { seededRandom } from "@twincell/core";
import { selectedProgram, type CellDocument } from "@twincell/project";
import type { CellFolder } from "../cell-folder.ts";
import { answerOf, TOOLS } from "../server.ts";

const FILE = "try.json";
/** Share of the points that are moved, how far along the floor at most, and up [m]. */
const MOVED = 0.2;
const ALONG_M = 0.45;
const UP_M = 0.25;
const MOST_ROUNDS = 12;

interface Judged {
  readonly verdict: {
    readonly ok: boolean;
    readonly steps: readonly { readonly id: string; readonly repair?: { readonly repairs: readonly unknown[] } }[];
  };
}

/**
 * Moves points of the selected program of a cell at random and mends it by following the "repair" fields alone, so
 * often. Says how many of the programs that were bad became good.
 */
export async function followRepairs(
  folder: CellFolder,
  cell: CellDocument,
  tries: number,
  seed: number,
): Promise<{ readonly bad: number; readonly mended: number }> {
  const random = seededRandom(seed);
  const program = selectedProgram(cell)!;
  const ask = async (name: string, asked: object): Promise<object> =>
    (await answerOf(TOOLS.find(each => each.name === name)!, folder, { cell: FILE, ...asked })).answer;
  let bad = 0;
  let mended = 0;
  for (let i = 0; i < tries; i++) {
    const steps = program.steps.map(step => {
      if (step.type !== "move" || !("pose" in step.target) || random() > MOVED) return step;
      const [x, y, z] = step.target.pose.position;
      const away = (): number => ALONG_M * (2 * random() - 1);
      const position: [number, number, number] = [x + away(), y + away(), z + UP_M * random()];
      return { ...step, target: { ...step.target, pose: { ...step.target.pose, position } } };
    });
    await folder.write(FILE, { ...cell, programs: [{ ...program, steps }] });
    for (let round = 0; round < MOST_ROUNDS; round++) {
      let { verdict } = (await ask("check", {})) as Judged;
      if (verdict.ok) {
        if (round > 0) mended++;
        break;
      }
      if (round === 0) bad++;
      // Where the first bad step has no way out by itself, another one may have: then it is its turn again.
      if (!repairable(verdict)) ({ verdict } = (await ask("check", { explain: 20 })) as Judged);
      const step = repairable(verdict);
      if (!step) break;
      await ask("apply_repair", { step: step.id, repair: 0 });
    }
  }
  return { bad, mended };
}

const repairable = ({ steps }: Judged["verdict"]) => steps.find(({ repair }) => (repair?.repairs.length ?? 0) > 0);
