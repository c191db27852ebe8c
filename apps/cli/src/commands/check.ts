import {
  checkProgram,
  keptSentence,
  linkSolids,
  robotById,
  readCertificate,
  verifyProgram,
  writeCertificate,
  type ProgramCertificateVerdict,
  type Verdict,
} from "@twincell/core";
import { cellGeometry } from "@twincell/project";
import { executeText, NOT_GIVEN } from "@twincell/languages";
import { given, type Given } from "../io/arguments.ts";
import { explained, MOST_EXPLAINED, repairSearch } from "../io/explained.ts";
import { inputsFrom } from "../io/moments.ts";
import { projectFault, textProject } from "../io/text-project.ts";
import { writeOne } from "../io/output.ts";
import { readText } from "../io/files.ts";
import { readCell, readProgram } from "../io/program.ts";
import { programRobot, ROBOT_HELP, ROBOT_OPTIONS, type RobotToRun } from "../io/robot.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const checkCommand: Command = {
  name: "check",
  summary: "judge a program: reach, limits, speed, torques, branches, collision",
  usage: `twincell check PROGRAM|FILE… [--as-text [--dialect D] [--leave-out-missing]] [--robot R] [--cell CELL] [--margin M]
                [--junit FILE] [--certificate FILE | --verify FILE] [--json]

Writes VERDICT {"ok","steps":[{"id","verdict","findings":[…]}],"torque":…,…} and ends with 1 when any step is bad.
Where torques are known, which joint is asked most goes to stderr as well; where they are not, "torque" says why.

  --as-text       FILE is a vendor's program text, several of one program, a folder or ZIP of them, or a cell whose
                  selected program is a text: it is executed as its controller would and judged; each step says its
                  "file" and "line"; inputs: --inputs
  --leave-out-missing  with --as-text: a called program that is in none of the files does nothing; the verdict is then not
                  ok and names the call. Without it such a text is refused, with file, line and name
  --robot R       the robot to judge it on; the one the program names when absent
  --cell CELL     the saved cell to keep clear of; without it collisions are not looked at
  --margin M      distance to keep from everything, in metres (default 0)
  --json          each bad step also has "repair": {"cause","sentence","out","repairs":[…],"tried":[…]}: why, and up to three
                  changes with which the whole program was checked again, the smallest first: "kind", "amount" [rad, m],
                  "replace", "alsoReplace", "insertBefore" (steps), "moveFrame", "moveBase" [m], and what it "reaches"
  --junit FILE    the same as a JUnit report, one test case per step
  --certificate FILE  writes what proves the program clear of contact: for every motion and pair of solids, stretches
                  of time and the distance that is proven for them; wants --cell
  --verify FILE   does not judge, but proves such a file again by another method, for this program in this cell; ends
                  with 1 when it does not hold

${ROBOT_HELP}`,
  async run(args) {
    const options = given(args, {
      ...ROBOT_OPTIONS,
      cell: { type: "string" },
      margin: { type: "string" },
      junit: { type: "string" },
      certificate: { type: "string" },
      verify: { type: "string" },
      "as-text": { type: "boolean" },
      dialect: { type: "string" },
      inputs: { type: "string" },
      "leave-out-missing": { type: "boolean" },
      json: { type: "boolean" },
    });
    const [path] = options.positionals;
    const cellPath = options.text("cell");
    const margin_m = options.number("margin") ?? 0;
    const junit = options.text("junit");
    const certificatePath = options.text("certificate");
    const verifyPath = options.text("verify");
    if (path === undefined) throw new UseFault("PROGRAM is missing.", "Give the path of a program file.");
    if (margin_m < 0) throw new UseFault(`--margin wants 0 or more, not ${margin_m}.`);
    const chosen = await programRobot(options);
    if (options.flag("as-text")) return checkText(options, chosen, margin_m);
    const { program, robot, solids } = await readProgram(path, chosen);
    const document = cellPath === undefined ? undefined : await readCell(cellPath);
    const cell = document && cellGeometry(document, solids());
    if ((certificatePath ?? verifyPath) !== undefined && cell === undefined)
      throw new UseFault("A certificate is about a cell.", "Name it with --cell.");
    if (verifyPath !== undefined && cell !== undefined) {
      const read = readCertificate(await readText(verifyPath));
      if (read.kind === "not-a-certificate") throw new UseFault(`${verifyPath}: ${read.sentence}`);
      const { plan } = checkProgram(program, robot, { worldFromBase: cell.worldFromBase });
      const answer = verifyProgram(read.certificate, program, plan, robot, cell);
      process.stdout.write(`${JSON.stringify(answer)}\n`);
      process.stderr.write(`${verified(answer)}\n`);
      return answer.kind === "confirmed" ? 0 : 1;
    }
    const checked = checkProgram(program, robot, {
      margin_m,
      certify: certificatePath !== undefined,
      ...(cell ? { cell } : {}),
    });
    const { verdict, certificate } = checked;
    if (certificatePath !== undefined && certificate !== undefined)
      await writeOne(certificatePath, writeCertificate(certificate));
    if (junit !== undefined) await writeOne(junit, junitReport(program.name, verdict));
    if (options.flag("json")) {
      const search = repairSearch(program, robot, { margin_m, ...(cell ? { cell } : {}) }, checked, document);
      const answer = explained(checked, search);
      if (answer.leftOut > 0)
        process.stderr.write(
          `twincell: ${MOST_EXPLAINED} of ${MOST_EXPLAINED + answer.leftOut} bad steps are explained.\n`,
        );
      process.stdout.write(`${JSON.stringify(answer.verdict)}\n`);
    } else process.stdout.write(`${JSON.stringify(verdict)}\n`);
    if (cell?.placeErrors) process.stderr.write(`${keptSentence(cell, margin_m)}\n`);
    if (verdict.torque.kind === "known") process.stderr.write(`${verdict.torque.sentence}\n`);
    return verdict.ok ? 0 : 1;
  },
};

/** A vendor's text, executed and judged: the verdict of a taught program, each step with its file and line. */
async function checkText(options: Given, chosen: RobotToRun | undefined, margin_m: number): Promise<number> {
  const project = await textProject(options.positionals, options.text("dialect"));
  const cellPath = options.text("cell");
  const cell = cellPath === undefined ? project.cell : await readCell(cellPath);
  const robot = chosen?.robot ?? (cell && robotById(cell.robot.id));
  if (!robot) throw new UseFault("--robot is missing.", "A vendor's text does not say which robot it is for.");
  const worldFromBase = cell?.robot.worldFromBase;
  const executed = executeText(project.dialect, project.joined.text, project.placeOf(1).path, robot, worldFromBase, {
    inputs: inputsFrom(options.text("inputs")),
    ...(options.flag("leave-out-missing") ? { missingPrograms: "leave-out" as const } : {}),
  });
  if (executed.kind === "not-understood") throw projectFault(project, executed.faults);
  for (const { line, sentence } of executed.notExecuted) {
    const place = project.placeOf(line);
    process.stderr.write(`twincell: ${place.path}, line ${place.line}: ${sentence}\n`);
  }
  if (executed.cut !== undefined) process.stderr.write(`twincell: ${executed.cut}\n`);
  const solids = chosen?.solids ?? (() => linkSolids(robot));
  const { verdict } = checkProgram(executed.program, robot, {
    margin_m,
    ...(cell ? { cell: cellGeometry(cell, solids()) } : {}),
  });
  const steps = verdict.steps.map(step => {
    const { path, line } = project.placeOf(executed.lines.get(step.id) ?? 1);
    return { ...step, file: path, line };
  });
  const junit = options.text("junit");
  if (junit !== undefined) await writeOne(junit, junitReport(executed.program.name, verdict));
  const assumed = executed.notExecuted
    .filter(({ expected }) => expected === NOT_GIVEN)
    .map(({ line, sentence }) => {
      const place = project.placeOf(line);
      return { file: place.path, line: place.line, sentence };
    });
  const ok = verdict.ok && assumed.length === 0;
  process.stdout.write(`${JSON.stringify({ ...verdict, ok, steps, assumed })}\n`);
  if (assumed.length > 0)
    process.stderr.write(
      "twincell: The verdict is not ok: what the lines above do only the controller knows. Give the files that hold it.\n",
    );
  for (const { verdict: says, file, line, findings } of steps)
    if (says === "bad")
      for (const { sentence } of findings) process.stderr.write(`twincell: ${file}, line ${line}: ${sentence}\n`);
  return ok ? 0 : 1;
}

function verified(answer: ProgramCertificateVerdict): string {
  switch (answer.kind) {
    case "confirmed":
      return `All ${answer.segments} motions${answer.corners > 0 ? ` and the ${answer.corners} corners passed without a stop` : ""} are proven clear a second time, in ${answer.looks} looks.`;
    case "missing":
      return answer.of === "corner"
        ? `The corner at the end of step ${answer.step}, at ${answer.start_s.toFixed(2)} s, has no certificate: it is not clear, or the arm does not reach all of it.`
        : `The motion of step ${answer.step} at ${answer.start_s.toFixed(2)} s has no certificate.`;
    case "refuted":
      return `The certificate does not hold for step ${answer.step}: ${answer.a} and ${answer.b} at ${answer.at_s.toFixed(2)} s (${answer.reason}).`;
  }
}

const escaped = (text: string): string => text.replace(/[<>&"']/g, char => `&#${char.charCodeAt(0)};`);

/** One test case per step; a bad step is a failure, one nobody evaluated is skipped. */
function junitReport(name: string, verdict: Verdict): string {
  const cases = verdict.steps.map(({ id, verdict: says, findings }) => {
    const sentences = escaped(findings.map(finding => finding.sentence).join(" "));
    const inside =
      says === "bad"
        ? `<failure message="${sentences}"/>`
        : says === "unknown"
          ? "<skipped/>"
          : findings.length
            ? `<system-out>${sentences}</system-out>`
            : "";
    return `  <testcase classname="${escaped(name)}" name="${escaped(id)}">${inside}</testcase>`;
  });
  const bad = verdict.steps.filter(step => step.verdict === "bad").length;
  const unknown = verdict.steps.filter(step => step.verdict === "unknown").length;
  return `<?xml version="1.0" encoding="UTF-8"?>\n<testsuite name="${escaped(name)}" tests="${cases.length}" failures="${bad}" skipped="${unknown}">\n${cases.join("\n")}\n</testsuite>\n`;
}
