import type { ReactNode } from "react";
import { useStore } from "zustand";
import { recordMoving } from "../../stores/record.ts";
import { beginEdit, endEdit } from "../../runtime/jog/edit-point.ts";
import { virtualControllers } from "../../runtime/robot/connection-commands.ts";
import { cellStore } from "../../stores/cell.ts";
import { runCommand } from "../../stores/commands.ts";
import { connectionStore } from "../../stores/connection.ts";
import { programOf } from "../../stores/document.ts";
import { editStore } from "../../stores/edit-point.ts";
import {
  headsetStore,
  leaveHeadset,
  nextOf,
  resetPanels,
  scaleCell,
  type ControllerUse,
  type HeadsetTab,
} from "../../stores/headset.ts";
import { notify } from "../../stores/notices.ts";
import { physicsStore } from "../../stores/physics.ts";
import { playStore } from "../../stores/play.ts";
import { repairStore } from "../../stores/repairs.ts";
import { roomStore, toggleRoom } from "../../stores/room.ts";
import { runQuestionStore } from "../../stores/run-question.ts";
import { seenFindings, leaveRunQuestion } from "../../runtime/run/ask-before-run.ts";
import { sound } from "../../stores/sound.ts";
import { stopEverything } from "../../stores/stop.ts";
import { traceStore } from "../../stores/trace.ts";
import { words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";
import { Key, type KeyProps, Row } from "./keys.tsx";

const SAID = words.headset;
const RATIOS = [1, 0.5, 0.2, 0.1] as const;

/** A key of the plate: its letters are 10 mm high, half an arm's length away. */
export const PlateKey = (of: KeyProps) => <Key size={28} height={92} {...of} />;

const press = (command: string) => () => void runCommand(command);
/** What moves the robot waits until the emergency stop is reset. */
const pressMoving = (command: string) => () => {
  if (headsetStore.getState().emergency) {
    sound("limit");
    notify("bad", SAID.emergencyPressed);
  } else runCommand(command);
};
const command = (id: string, says: string, name: string, more: Partial<KeyProps> = {}): ReactNode => (
  <PlateKey id={id} words={says} onPress={press(name)} {...more} />
);
const moving = (id: string, says: string, name: string): ReactNode => (
  <PlateKey id={id} words={says} onPress={pressMoving(name)} />
);

const RECORD = { ptp: "program.record-ptp", lin: "program.record-lin", circ: "program.record-circ" } as const;
function record(): void {
  const { recordAs } = headsetStore.getState();
  if (recordAs === "way") {
    notify("info", SAID.pathTold.way);
    return;
  }
  if (runCommand(RECORD[recordAs])) sound("done");
}
function nextPath(): void {
  const recordAs = nextOf(["ptp", "lin", "circ", "way"] as const, headsetStore.getState().recordAs);
  headsetStore.setState({ recordAs });
  recordMoving(recordAs === "way");
  notify("info", SAID.pathTold[recordAs]);
}

function PathKey() {
  const recordAs = useStore(headsetStore, state => state.recordAs);
  return <PlateKey id="path" words={SAID.path[recordAs]} onPress={nextPath} />;
}
function GripKey() {
  const closed = useStore(
    cellStore,
    ({ document }) => programOf(document)?.steps.findLast(step => step.type === "gripper")?.closed === true,
  );
  return closed
    ? command("grip", SAID.grip.open, "program.gripper-open")
    : command("grip", SAID.grip.close, "program.gripper-close");
}
function Teach() {
  return (
    <>
      <Row>
        <PlateKey id="record" words={SAID.record} strong onPress={record} />
        <PathKey />
      </Row>
      <Row>
        {command("undo", SAID.undo, "edit.undo")}
        <GripKey />
      </Row>
    </>
  );
}

function EditKey() {
  const edited = useStore(editStore, state => state.edited);
  return (
    <PlateKey
      id="edit"
      words={edited ? SAID.editing : SAID.edit}
      strong={edited !== null}
      onPress={() => {
        if (editStore.getState().edited) endEdit();
        else beginEdit();
      }}
    />
  );
}
/** The first press begins to choose edges by pointing; with edges chosen it lays points along them. */
function TraceKey() {
  const { active, chosen } = useStore(traceStore);
  return (
    <PlateKey
      id="trace"
      words={chosen.length > 0 ? SAID.traceMake(chosen.length) : SAID.trace}
      strong={active}
      onPress={() => {
        if (traceStore.getState().chosen.length > 0) {
          runCommand("trace.make");
          return;
        }
        runCommand("trace.toggle");
        if (traceStore.getState().active) notify("info", SAID.wholeEdge);
      }}
    />
  );
}
function TeachAgain() {
  return (
    <>
      <Row>
        {command("touch-up", SAID.touchUp, "program.touch-up")}
        <EditKey />
      </Row>
      <Row>
        <TraceKey />
        {command("delete", SAID.remove, "program.delete")}
      </Row>
    </>
  );
}
function HandKeys() {
  const lock = useStore(headsetStore, state => state.lock);
  const ratio = useStore(headsetStore, state => state.ratio);
  return (
    <>
      <Row>
        <PlateKey
          id="lock"
          words={SAID.lock[lock]}
          strong={lock !== "free"}
          onPress={() => {
            headsetStore.setState({ lock: nextOf(["free", "move", "turn"] as const, lock) });
          }}
        />
        <PlateKey
          id="ratio"
          words={SAID.ratio(Math.round(1 / ratio))}
          strong={ratio !== 1}
          onPress={() => {
            headsetStore.setState({ ratio: nextOf<number>(RATIOS, ratio) });
          }}
        />
      </Row>
      <Row>
        {moving("home", SAID.home, "jog.ready")}
        {moving("zero", SAID.zero, "jog.zero")}
      </Row>
    </>
  );
}

function Check() {
  return (
    <>
      <Row>
        {command("check-now", SAID.checkNow, "check.now", { strong: true })}
        {command("problem-next", SAID.nextProblem, "check.next-problem")}
      </Row>
      <Row>
        {command("explain", SAID.explain, "check.explain")}
        {command("repair-all", SAID.repairAll, "check.repair-all")}
      </Row>
    </>
  );
}
function Repairs() {
  const count = useStore(
    repairStore,
    ({ current, explanations }) => (current === null ? undefined : explanations.get(current))?.repairs.length ?? 0,
  );
  return (
    <>
      <Row>
        {count > 0
          ? command("apply-1", SAID.repair(1), "check.apply-repair-1", { strong: true })
          : command("go-to", SAID.goTo, "program.go-to")}
        {count > 1
          ? command("apply-2", SAID.repair(2), "check.apply-repair-2")
          : command("undo", SAID.undo, "edit.undo")}
      </Row>
      <Row>
        {command("export", SAID.export, "export.save")}
        {count > 2
          ? command("apply-3", SAID.repair(3), "check.apply-repair-3")
          : command("aid", SAID.aid, "jog.aid-next")}
      </Row>
    </>
  );
}

function PlayKey() {
  const playing = useStore(playStore, state => state.playing);
  return playing
    ? command("play", SAID.pause, "play.toggle", { strong: true })
    : moving("play", SAID.play, "play.toggle");
}
/** What the check found red is not begun by one press: the key then asks, in its own words. */
function RunKey() {
  const asks = useStore(runQuestionStore, ({ question }) => question !== null && question.real.length === 0);
  return (
    <PlateKey
      id="run"
      words={asks ? SAID.runDespite : SAID.run}
      {...(asks ? { color: "#ffcf70", ink: "#2a1d05" } : {})}
      onPress={() => {
        const { question } = runQuestionStore.getState();
        if (question && question.kind !== "checking" && question.real.length === 0) {
          leaveRunQuestion();
          question.proceed(seenFindings());
        } else pressMoving("run.start")();
      }}
    />
  );
}
const stop = (): void => {
  if (!runCommand("stop")) stopEverything();
};
function Run() {
  return (
    <>
      <Row>
        <PlayKey />
        <RunKey />
      </Row>
      <Row>
        {command("to-start", SAID.toStart, "play.start")}
        <PlateKey id="stop" words={SAID.stop} color="#ff6157" ink="#2a0705" atOnce onPress={stop} />
      </Row>
    </>
  );
}
function Stepping() {
  return (
    <>
      <Row>
        {command("step-back", SAID.stepBack, "play.back")}
        {command("step-on", SAID.stepOn, "play.step")}
      </Row>
      <Row>
        {command("slower", SAID.slower, "play.slower")}
        {command("faster", SAID.faster, "play.faster")}
      </Row>
    </>
  );
}

function Cell() {
  const { station, view } = useStore(connectionStore);
  useStore(cellStore, state => state.document?.robot.id);
  const [driver] = virtualControllers();
  return (
    <>
      <Row>
        {station !== null
          ? command("connect", SAID.disconnect, "connection.disconnect")
          : command("connect", driver ? SAID.connect(driver.name) : SAID.noController, "connection.connect", {
              strong: driver !== undefined,
            })}
        {view === "clone"
          ? command("view", SAID.live, "connection.live")
          : command("view", SAID.clone, "connection.clone")}
      </Row>
      <Row>
        {moving("send", SAID.send, "connection.send")}
        <PlateKey
          id="reset"
          words={SAID.reset}
          onPress={() => {
            headsetStore.setState({ emergency: false });
            runCommand("run.reset");
          }}
        />
      </Row>
    </>
  );
}
function Person() {
  const { posture, wrist, turning, scale } = useStore(headsetStore);
  return (
    <>
      <Row>
        <PlateKey
          id="posture"
          words={SAID.posture[posture]}
          onPress={() => {
            headsetStore.setState({ posture: nextOf(["standing", "seated", "table"] as const, posture) });
          }}
        />
        <PlateKey
          id="wrist"
          words={SAID.wrist[wrist]}
          onPress={() => {
            headsetStore.setState({ wrist: nextOf(["left", "right", "stand"] as const, wrist) });
          }}
        />
      </Row>
      <Row>
        <PlateKey
          id="turning"
          words={SAID.turning[turning]}
          onPress={() => {
            headsetStore.setState({ turning: nextOf(["snap", "smooth"] as const, turning) });
          }}
        />
        <PlateKey
          id="scale"
          words={SAID.size(scaleWords(scale))}
          strong={scale !== 1}
          onPress={() => {
            const next = nextOf<number>(SCALES, SCALES.find(each => Math.abs(each - scale) < 1e-3) ?? SCALES.at(-1)!);
            scaleCell(next);
            notify("info", SAID.scaled(SAID.size(scaleWords(next))));
          }}
        />
      </Row>
    </>
  );
}
const SCALES = [1, 0.5, 0.2, 0.05, 2] as const;
const scaleWords = (scale: number): string =>
  scale >= 1 ? `${fixed(scale, scale === Math.round(scale) ? 0 : 1)}:1` : `1:${fixed(1 / scale, scale > 0.5 ? 1 : 0)}`;

function History() {
  return (
    <>
      <Row>
        <PlateKey
          id="history"
          words={SAID.timeline}
          strong
          onPress={() => {
            toggleRoom("history");
          }}
        />
        <PlateKey
          id="camera"
          words={SAID.camera}
          onPress={() => {
            toggleRoom("cameras");
          }}
        />
      </Row>
      <Row>
        <PlateKey
          id="back-here"
          words={SAID.backHere}
          onPress={() => {
            headsetStore.setState(({ placedAnew }) => ({ placedAnew: placedAnew + 1, scale: 1 }));
          }}
        />
        <PlateKey id="leave" words={SAID.leave} onPress={leaveHeadset} />
      </Row>
    </>
  );
}

/** Which parts of a controller do what, each chosen by itself (row X-33); and panels back where they stood. */
function ControllerKeys() {
  const use = useStore(headsetStore, state => state.use);
  const change = (part: Partial<ControllerUse>): void => {
    headsetStore.setState({ use: { ...use, ...part } });
  };
  return (
    <>
      <Row>
        <PlateKey
          id="use-take"
          words={SAID.take[use.take]}
          onPress={() => {
            change({ take: nextOf(["grip", "trigger"] as const, use.take) });
          }}
        />
        <PlateKey
          id="use-view"
          words={SAID.viewBy[use.view]}
          onPress={() => {
            change({ view: nextOf(["both", "left", "right"] as const, use.view) });
          }}
        />
      </Row>
      <Row>
        <PlateKey
          id="use-gripper"
          words={SAID.gripperBy[use.gripper]}
          onPress={() => {
            change({ gripper: nextOf(["a", "b", "none"] as const, use.gripper) });
          }}
        />
        <PlateKey id="panels-back" words={SAID.panelsBack} onPress={resetPanels} />
      </Row>
    </>
  );
}

/** Numbers by keypad, and playing with weight and friction. */
function Numbers() {
  const keypad = useStore(roomStore, state => state.keypad);
  return (
    <Row>
      <PlateKey
        id="keypad"
        words={SAID.keypad}
        strong={keypad}
        onPress={() => {
          toggleRoom("keypad");
        }}
      />
      {command("aid-next", SAID.aid, "jog.aid-next")}
    </Row>
  );
}
function Physics() {
  const on = useStore(physicsStore, state => state.on);
  return <Row>{command("physics", SAID.physics, "play.physics", { strong: on })}</Row>;
}

/** What each tab holds: at most four actions a page. */
export const PAGES: Readonly<Record<HeadsetTab, readonly (() => ReactNode)[]>> = {
  teach: [Teach, TeachAgain, HandKeys, Numbers],
  check: [Check, Repairs],
  run: [Run, Stepping, Physics],
  cell: [Cell, Person, ControllerKeys],
  history: [History],
};
