import { withRobots } from "../hire.ts";
import { cellStore } from "../../stores/cell.ts";
import { programOf } from "../../stores/document.ts";
import { notify } from "../../stores/notices.ts";
import { physicsShows, physicsStore } from "../../stores/physics.ts";
import { playStore } from "../../stores/play.ts";
import { sound } from "../../stores/sound.ts";
import type { FromPhysics, PhysicsFrame, ToPhysics } from "../../workers/physics-messages.ts";
import { onFrame } from "../jog/jog-frames.ts";
import { showJoints } from "../live.ts";
import { leaveRobot, takeRobot } from "../robot/motion-owner.ts";

/** The worker of the page, or a double in a test. Made when physics is first switched on: the engine is 10 MB. */
export interface PhysicsLink {
  post(message: ToPhysics): void;
  listen(hear: (message: FromPhysics) => void): void;
  close(): void;
}

export function workerLink(): PhysicsLink {
  const worker = withRobots(
    new Worker(new URL("../../workers/physics.worker.ts", import.meta.url), { type: "module" }),
  );
  return {
    post: message => {
      worker.postMessage(message);
    },
    listen: hear => {
      worker.addEventListener("message", ({ data }: MessageEvent<FromPhysics>) => {
        hear(data);
      });
      worker.addEventListener("error", event => {
        hear({
          kind: "refused",
          edition: -1,
          sentence: `Physics could not run: ${event.message}.`,
          hint: "Reload the page; nothing is lost.",
        });
      });
    },
    close: () => {
      worker.terminate();
    },
  };
}

const TELL_EVERY_MS = 100;
const MOST_SAID = 40;
let frame: PhysicsFrame | null = null;
let parts: readonly string[] = [];
/** The latest frame; null while physics shows nothing. Replaced whole, never written to. */
export const physicsNow = (): PhysicsFrame | null => frame;
/** Where that object's seven numbers begin in the frame; −1 when it is no part. */
export const partOffset = (id: string): number => 7 * parts.indexOf(id);

let link: PhysicsLink | null = null;
let edition = 0;
let waiting = false;
let owed_s = 0;
let toldAt = 0;
let makeLink = workerLink;

/** Play, hold or begin again. */
export function playOrHold(): void {
  const { status } = physicsStore.getState();
  if (status === "running" || status === "stopped") {
    hold();
    return;
  }
  if (status === "held") {
    go();
    return;
  }
  begin();
}

function begin(): void {
  const { document } = cellStore.getState();
  const program = programOf(document);
  if (!document || !program || program.steps.length === 0) return;
  if (link === null) {
    link = makeLink();
    link.listen(hear);
  }
  edition++;
  waiting = true;
  physicsStore.setState({ status: "loading", said: [], t_s: 0, step: "", tripped: [] });
  link.post({ kind: "start", edition, document, program });
}

function go(): void {
  takeRobot("physics", hold);
  physicsStore.setState({ status: "running" });
}
export function hold(): void {
  leaveRobot("physics");
  const { status } = physicsStore.getState();
  if (status === "running" || status === "stopped") physicsStore.setState({ status: "held" });
}

/** A person lets the robot go on after a stop. */
export function resume(): void {
  link?.post({ kind: "resume", edition });
}

/** Everything stands again where the document has it. */
export function leavePhysics(): void {
  hold();
  edition++;
  frame = null;
  physicsStore.setState({ status: "idle", tripped: [], step: "" });
}

function hear(message: FromPhysics): void {
  if (message.edition !== edition && message.edition !== -1) return;
  waiting = false;
  if (message.kind === "refused") {
    physicsStore.setState({ status: "idle" });
    notify("bad", message.sentence, message.hint);
    return;
  }
  ({ frame } = message);
  showJoints(frame.q_rad);
  if (message.kind === "ready") {
    ({ parts } = message);
    owed_s = 0;
    physicsStore.setState({ assumptions: message.assumptions });
    go();
    return;
  }
  tell(message);
}

function tell({
  state,
  stopped,
  said,
  why,
  frame: { t_s, step, tripped },
}: Extract<FromPhysics, { kind: "frame" }>): void {
  const known = physicsStore.getState();
  const sensors = cellStore.getState().document?.sensors ?? [];
  if (said.some(sentence => sentence.includes("is held."))) sound("grip");
  const status = known.status === "held" ? "held" : state === "running" ? (stopped ? "stopped" : "running") : state;
  const now_ms = performance.now();
  if (status === known.status && said.length === 0 && now_ms - toldAt < TELL_EVERY_MS) return;
  toldAt = now_ms;
  const lit = sensors.filter((_, i) => tripped[i] === 1).map(({ id }) => id);
  physicsStore.setState({
    status,
    t_s,
    step,
    said: [...said].reverse().concat(known.said).slice(0, MOST_SAID),
    ...(lit.join() === known.tripped.join() ? {} : { tripped: lit }),
  });
  if (state !== "running" && status === state) leaveRobot("physics");
  if (state === "done" && known.status !== "done") sound("done");
  if (state === "paused" && known.status !== "paused") notify("bad", why);
}

/** Lets time pass with the frames of the page; a worker that is late makes slow motion, never a queue. */
export function startPhysics(make: () => PhysicsLink = workerLink): () => void {
  makeLink = make;
  const stops = [
    onFrame((_, dt_s) => {
      const { status } = physicsStore.getState();
      if (status !== "running" && status !== "stopped") return;
      owed_s = Math.min(0.1, owed_s + dt_s);
      if (waiting) return;
      waiting = true;
      link?.post({ kind: "advance", edition, dt_s: owed_s, override: playStore.getState().speed });
      owed_s = 0;
    }),
    // What is edited begins anew: the world in the worker is another one.
    cellStore.subscribe((state, before) => {
      if (state.document !== before.document && physicsStore.getState().status !== "idle") leavePhysics();
    }),
    physicsStore.subscribe((state, before) => {
      if (before.on && !state.on && physicsShows(before)) leavePhysics();
    }),
  ];
  return () => {
    for (const stop of stops) stop();
    link?.close();
    link = null;
  };
}
