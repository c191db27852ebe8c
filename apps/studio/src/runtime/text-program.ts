import { withRobots } from "./hire.ts";
import type { CellDocument, TextProgram } from "@twincell/project";
import { withSelectedText } from "@twincell/project";
import { cellStore } from "../stores/cell.ts";
import { commit, keepExecuted, programOf, robotOf, textOf } from "../stores/document.ts";
import { notify } from "../stores/notices.ts";
import { seekStep } from "../stores/seek.ts";
import { select, selectionStore } from "../stores/selection.ts";
import { placeOf, pointAt, pointsOf, stepAt, stepOfPoint, textStore } from "../stores/text.ts";
import type { TextPoint } from "@twincell/languages";
import { words } from "../messages/index.ts";
import type { FromTextWorker, LinePlace, ToTextWorker } from "../workers/text-messages.ts";
import { interpolateTo } from "./jog/joint-interpolation.ts";
import { theLive } from "./live.ts";
import { solveStep } from "./jog/solve.ts";

/** Who reads texts: a worker of the page, or a double in a test. */
export interface TextReader {
  post(message: ToTextWorker): void;
  listen(hear: (message: FromTextWorker) => void): void;
}
function workerReader(): TextReader {
  const worker = withRobots(new Worker(new URL("../workers/text.worker.ts", import.meta.url), { type: "module" }));
  return {
    post: message => worker.postMessage(message),
    listen: hear => {
      worker.addEventListener("message", ({ data }: MessageEvent<FromTextWorker>) => hear(data));
      worker.addEventListener("error", event =>
        hear({ kind: "trouble", id: -1, sentence: event.message || words.text.trouble }),
      );
    },
  };
}

let reader: TextReader | null = null;
let hire: () => TextReader = workerReader;
let count = 0;
let wanted = 0;
let asked: { readonly text: TextProgram; readonly robot: CellDocument["robot"] } | null = null;
const touching = new Map<number, (message: FromTextWorker) => void>();

function hired(): TextReader {
  if (reader === null) {
    reader = hire();
    reader.listen(hear);
  }
  return reader;
}

function hear(message: FromTextWorker): void {
  const touched = touching.get(message.id);
  if (touched) {
    touching.delete(message.id);
    touched(message);
    return;
  }
  if (message.id !== wanted && message.id !== -1) return;
  if (message.kind === "trouble") textStore.setState({ reading: false, trouble: message.sentence });
  else if (message.kind === "read" && asked) {
    textStore.setState({ reading: false, trouble: null, read: message.read });
    keepExecuted(asked.text, asked.robot, message.read.program);
  }
}

const taskOf = (id: number, text: TextProgram, robot: CellDocument["robot"]) => ({
  id,
  language: text.language,
  main: text.main,
  files: text.files.map(file => ({ name: file.name, text: file.text })),
  robot: robot.id,
  worldFromBase: { position: robot.worldFromBase.position, quaternion: robot.worldFromBase.quaternion },
});

/** Reads the selected text after every change of it, away from the page, and follows the selection both ways. */
export function startTexts(how: () => TextReader = workerReader): () => void {
  hire = how;
  const look = (document: CellDocument | null): void => {
    const text = textOf(document);
    if (!document || !text) {
      asked = null;
      return;
    }
    if (asked?.text === text && asked.robot === document.robot) return;
    if (asked === null || asked.text.name !== text.name)
      textStore.setState({ read: null, cursor: { file: mainIndex(text), line: 1 } });
    asked = { text, robot: document.robot };
    wanted = ++count;
    textStore.setState(({ base }) => ({
      reading: true,
      trouble: null,
      base: Object.hasOwn(base, text.name) ? base : { ...base, [text.name]: text.files.map(file => file.text) },
    }));
    hired().post({ ...taskOf(wanted, text, document.robot), kind: "read", name: text.name });
  };
  look(cellStore.getState().document);
  const stop = cellStore.subscribe(({ document }) => look(document));
  // A step chosen elsewhere, in the time line or among the findings, is a line of the text.
  const follow = selectionStore.subscribe(({ selected }) => {
    if (asked === null || selected?.kind !== "step") return;
    const state = textStore.getState();
    const place = placeOf(state, selected.id);
    if (place && stepAt(state, state.cursor) !== selected.id && !coversCursor(place))
      textStore.setState({ cursor: place });
  });
  return () => {
    stop();
    follow();
  };
}

/** Whether the cursor is on the point that this line goes to: a value in a data list stays where it is looked at. */
function coversCursor(place: LinePlace): boolean {
  const state = textStore.getState();
  const point = pointAt(pointsOf(state), state.cursor);
  return point !== undefined && point === pointAt(pointsOf(state), place);
}

const mainIndex = (text: TextProgram): number =>
  Math.max(
    0,
    text.files.findIndex(file => file.name === text.main),
  );

/** Puts the cursor on a line; where the text moves the robot there, the view shows it at that point. */
export function goToLine(cursor: LinePlace): void {
  textStore.setState({ cursor });
  const state = textStore.getState();
  const point = pointAt(pointsOf(state), cursor);
  const step = stepAt(state, cursor) ?? (point === undefined ? undefined : stepOfPoint(state, point));
  if (step !== undefined) goToStep(step);
}

/** The moment of a step, and the point itself: a blended motion passes by it, the person wants to stand there. */
export function goToStep(id: string): void {
  select({ kind: "step", id });
  seekStep(id);
  const { document } = cellStore.getState();
  const robot = robotOf(document);
  const step = programOf(document)?.steps.find(each => each.id === id);
  if (!robot || step?.type !== "move" || (step.blend_m === 0 && (step.blend_ratio ?? 0) === 0)) return;
  const there = solveStep(step, theLive().q_rad);
  if (there.kind === "reached") interpolateTo(robot, there.q_rad);
}

/** The same by a point: its first motion, or its value where no motion goes to it. */
export function goToPoint(point: TextPoint): void {
  const use = point.uses.find(each => each.whole) ?? point.uses[0];
  goToLine(use ? { file: use.file, line: use.motionLine } : { file: point.value.file, line: point.value.line });
}

/** The point under the cursor. */
export const selectedPoint = (): TextPoint | undefined => {
  const state = textStore.getState();
  return pointAt(pointsOf(state), state.cursor);
};

/**
 * Rewrites the point under the cursor for where the robot stands now: that point alone, as one undo step. Resolves when
 * it is done.
 */
export async function touchUpSelected(): Promise<boolean> {
  const { document } = cellStore.getState();
  const text = textOf(document);
  const state = textStore.getState();
  const point = selectedPoint();
  const program = programOf(document);
  if (!document || !text || !point || !program) {
    notify("info", words.text.noPoint);
    return false;
  }
  const step = stepOfPoint(state, point);
  const move = program.steps.find(each => each.id === step);
  if (move?.type !== "move") {
    notify("info", words.text.notReached(point.name || words.text.thisPoint), words.text.notReachedHint);
    return false;
  }
  const id = ++count;
  const answer = await new Promise<FromTextWorker>(resolve => {
    touching.set(id, resolve);
    hired().post({
      ...taskOf(id, text, document.robot),
      kind: "touch-up",
      point,
      move,
      context: { tools: program.tools, frames: program.frames },
      q_rad: [...theLive().q_rad],
    });
  });
  if (answer.kind !== "touched-up") {
    notify("bad", answer.kind === "trouble" ? answer.sentence : words.text.trouble);
    return false;
  }
  const { touched } = answer;
  if (touched.kind === "refused") {
    notify("bad", touched.sentence, touched.hint);
    return false;
  }
  const called = point.name === "" ? words.text.literal(point.value.line) : point.name;
  if (touched.edits.length === 0) {
    notify("info", words.text.same(called));
    return false;
  }
  const done = commit(words.undo.touchUpText(called), before =>
    textOf(before) !== text
      ? before
      : withSelectedText(before, own => ({
          ...own,
          files: own.files.map((file, i) =>
            touched.files[i]!.text === file.text ? file : { ...file, text: touched.files[i]!.text },
          ),
        })),
  );
  if (done) notify("done", words.text.touched(called, touched.uses));
  return done;
}
