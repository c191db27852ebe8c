import { parentPort } from "node:worker_threads";
import {
  addCatalogue,
  checkProgram,
  linkSolids,
  parseProgram,
  planProgram,
  PlanCursor,
  pose,
  robotById,
  withBranches,
  type Program,
  type Robot,
} from "@twincell/core";
import { CATALOGUE } from "@twincell/core/catalogue";
import { dialectById, proveText, runnableFile } from "@twincell/languages";
import { cellGeometry, openDocument, type CellDocument } from "@twincell/project";
import type { JudgeAnswer, JudgeRequest } from "./judge.ts";

addCatalogue(CATALOGUE);
const refused = (code: string, sentence: string, hint: string): JudgeAnswer => ({
  kind: "refused",
  why: { code, sentence, hint },
});

interface Given {
  readonly program: Program;
  readonly robot: Robot;
  readonly cell: CellDocument | undefined;
}
function read({ program: source, model, cell: saved }: JudgeRequest): Given | JudgeAnswer {
  // First: a cell may bring its robot with it.
  const opened =
    saved === undefined ? undefined : openDocument(typeof saved === "string" ? saved : JSON.stringify(saved));
  const parsed = parseProgram(source);
  if (parsed.kind !== "program") {
    const [first] = parsed.faults;
    return refused(
      "program.unreadable",
      `The program cannot be read: ${first?.path ? `${first.path}: ` : ""}${first?.sentence ?? "it is empty."}`,
      "docs/program.schema.json says what a program is.",
    );
  }
  const id = model ?? parsed.program.robot;
  const robot = robotById(id);
  if (!robot)
    return refused("robot.unknown", `There is no robot “${id}” in the library.`, "GET /api/v1/models lists them.");
  for (const step of parsed.program.steps) {
    const q = step.type === "move" && "q" in step.target ? step.target.q : undefined;
    if (q && q.length !== robot.arm.joints.length)
      return refused(
        "program.joints",
        `Step ${step.id} gives ${q.length} angles; ${robot.name} has ${robot.arm.joints.length} joints.`,
        "Give one for each joint.",
      );
  }
  if (opened === undefined) return { program: parsed.program, robot, cell: undefined };
  if (opened.kind === "opened") return { program: parsed.program, robot, cell: opened.document };
  return opened.kind === "too-new"
    ? refused(
        "cell.too-new",
        `The cell is of version ${opened.version}; this release reads versions up to ${opened.newest}.`,
        "Update Twincell.",
      )
    : refused(
        "cell.unreadable",
        opened.why[0] ?? "This is not a saved cell.",
        "docs/cell.schema.json says what a cell is.",
      );
}

/** Samples of a plan that are answered at most. */
const MOST_SAMPLES = 200_000;

function judge(request: JudgeRequest): JudgeAnswer {
  const given = read(request);
  if ("kind" in given) return given;
  const { program, robot, cell } = given;
  const worldFromBase = cell?.robot.worldFromBase ?? pose<"world", "base">();
  if (request.kind === "check") {
    const { verdict } = checkProgram(program, robot, {
      margin_m: request.margin_m,
      ...(cell ? { cell: cellGeometry(cell, linkSolids(robot)) } : {}),
    });
    return { kind: "done", answer: verdict };
  }
  if (request.kind === "plan") {
    const answer = planProgram(program, robot, { worldFromBase });
    const { plan } = answer;
    const count = Math.floor(plan.duration_s / request.period_s + 1e-9);
    if (count > MOST_SAMPLES)
      return refused(
        "plan.too-long",
        `The plan takes ${plan.duration_s.toFixed(1)} s, which is ${count} samples; at most ${MOST_SAMPLES} are answered.`,
        "Ask for a longer period_s.",
      );
    const cursor = new PlanCursor(plan);
    const q = Float64Array.from(robot.home_rad);
    const times = Array.from({ length: count + 1 }, (_, i) => i * request.period_s);
    if (plan.duration_s - times.at(-1)! > 1e-9) times.push(plan.duration_s);
    const step: string[] = [];
    const q_rad = times.map(time_s => {
      step.push(plan.segments.length > 0 ? cursor.at(time_s, q).step : "");
      return Array.from(q);
    });
    const stuck = answer.kind === "planned" ? null : answer.stuck;
    return {
      kind: "done",
      answer: {
        kind: stuck === null ? "planned" : "stuck",
        duration_s: plan.duration_s,
        time_s: times,
        q_rad,
        step,
        stuck,
      },
    };
  }
  const dialect = dialectById(request.language);
  if (!dialect)
    return refused(
      "language.unknown",
      `There is no language “${request.language}”.`,
      "GET /api/v1/languages lists them.",
    );
  const exact = withBranches(program, robot, { where: "needed", worldFromBase });
  const emitted = dialect.emit(exact, robot, worldFromBase);
  if (emitted.kind === "cannot")
    return refused(
      "language.cannot",
      `${emitted.step ? `Step ${emitted.step}: ` : ""}${emitted.sentence}`,
      emitted.hint,
    );
  const runnable = runnableFile(dialect, emitted.files);
  const proof = runnable === undefined ? undefined : proveText(dialect, runnable, exact, robot, worldFromBase);
  if (proof && proof.kind !== "proven")
    return refused("language.unproven", proof.sentence, "The text is not given out; please report this program.");
  return {
    kind: "done",
    answer: {
      files: emitted.files.map(({ name, text }) => ({ name, text })),
      warnings: emitted.warnings,
      proof: proof ? [{ file: proof.file, worst_m: proof.worst_m, worst_rad: proof.worst_rad }] : [],
    },
  };
}

parentPort!.on("message", ({ id, request }: { readonly id: number; readonly request: JudgeRequest }) => {
  let answer: JudgeAnswer;
  try {
    answer = judge(request);
  } catch (problem) {
    answer = refused(
      "judge.failed",
      `The program could not be judged: ${problem instanceof Error ? problem.message : String(problem)}`,
      "Please report this program.",
    );
  }
  parentPort!.postMessage({ id, answer });
});
