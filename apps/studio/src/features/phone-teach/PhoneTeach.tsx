import { CircleDot, Hand, Minus, Plus } from "lucide-react";
import { everyStep } from "@twincell/core";
import { useEffect, useMemo, useRef } from "react";
import { useStore } from "zustand";
import { hold, release } from "../../runtime/jog/pressed-inputs.ts";
import { setEnabled } from "../../runtime/robot/cell-connection.ts";
import { cellStore } from "../../stores/cell.ts";
import { runCommand } from "../../stores/commands.ts";
import { connectionStore } from "../../stores/connection.ts";
import { programOf, robotOf } from "../../stores/document.ts";
import { jogStore, type JogFrame } from "../../stores/jog.ts";
import { notify } from "../../stores/notices.ts";
import { playStore, verdictOf } from "../../stores/play.ts";
import { stepWords } from "../../stores/program.ts";
import { select, selectionStore } from "../../stores/selection.ts";
import { viewStore } from "../../stores/view.ts";
import { Segments } from "../../ui/Choice.tsx";
import { HoldButton } from "../../ui/HoldButton.tsx";
import { useEnablingSwitch } from "../../ui/useEnablingSwitch.ts";
import { words } from "../../messages/index.ts";
import { JogPad, Rocker } from "./JogPad.tsx";
import { phoneTeachStore } from "./state.ts";
import "./phone-teach.css";

const SAID = words.phone;
const FRAMES: readonly JogFrame[] = ["joint", "tool", "world"];
/** A chip that is held this long shows the list [ms]. */
const LONG_MS = 500;

/** Teaching with two thumbs: one holds the enabling switch, the other the pad. Letting go of either is zero at once. */
export function PhoneTeach() {
  const area = useRef<HTMLElement>(null);
  const enabling = useEnablingSwitch(area, enabled => {
    setEnabled(enabled);
    if (!enabled) release("phone");
  });
  useEffect(() => () => release("phone"), []);
  const { frame, blocked } = useStore(jogStore);
  const shown = FRAMES.includes(frame) ? frame : "world";
  return (
    <section className="phone-teach" aria-label={SAID.title} ref={area} data-enabled={enabling.enabled}>
      <Chips />
      <div className="phone-frames">
        <Segments
          className="seg fill"
          label={words.jog.frame}
          value={shown}
          onChange={next => {
            release("phone");
            jogStore.setState({ frame: next, blocked: null });
          }}
          options={FRAMES.map(value => ({ value, words: words.jog.frames[value] }))}
        />
        <MoveOrTurn joint={shown === "joint"} />
      </div>
      {blocked && (
        <p className="pendant-blocked" role="alert">
          {blocked.sentence}
        </p>
      )}
      <div className="phone-jog">
        {shown === "joint" ? <Joints /> : <Pads />}
        <div className="phone-record">
          <button className="btn" onClick={() => runCommand("program.record-ptp")}>
            <CircleDot />
            {words.jog.recordPtp}
          </button>
          <button className="btn" onClick={() => runCommand("program.record-lin")}>
            <CircleDot />
            {words.jog.recordLin}
          </button>
          <GripButton />
        </div>
      </div>
      <button
        type="button"
        className="phone-enable"
        aria-pressed={enabling.enabled}
        aria-label={words.direct.hold}
        onContextMenu={event => event.preventDefault()}
        {...enabling.press}
      >
        <Hand />
        <span>
          <b>{enabling.enabled ? SAID.enabled : words.direct.hold}</b>
          <small>{enabling.enabled ? SAID.letGo : SAID.holdHint}</small>
        </span>
      </button>
    </section>
  );
}

function MoveOrTurn({ joint }: { readonly joint: boolean }) {
  const turn = useStore(phoneTeachStore, state => state.turn);
  return (
    <Segments
      className="seg fill"
      label={SAID.pad}
      value={turn ? "turn" : "move"}
      onChange={next => {
        release("phone");
        phoneTeachStore.setState({ turn: next === "turn" });
      }}
      options={[
        { value: "move", words: SAID.move, disabled: joint },
        { value: "turn", words: SAID.turn, disabled: joint },
      ]}
    />
  );
}

function Pads() {
  const turn = useStore(phoneTeachStore, state => state.turn);
  const first = turn ? 3 : 0;
  return (
    <>
      <JogPad first={first} />
      <Rocker axis={first + 2} />
    </>
  );
}

/** What is held counts only while the enabling switch is. */
function holdEnabled(axis: number, amount: number): void {
  if (!connectionStore.getState().enabled) {
    notify("info", SAID.holdFirst);
    return;
  }
  jogStore.setState({ manner: "hold" });
  hold("phone", axis, amount);
}

function Joints() {
  const count = useStore(cellStore, state => robotOf(state.document)?.arm.joints.length ?? 0);
  return (
    <div className="phone-joints">
      {Array.from({ length: count }, (_, axis) => {
        const name = words.time.joint(axis + 1);
        return (
          <div key={axis}>
            <HoldButton
              className="btn icon"
              label={words.jog.minus(name)}
              onHold={() => holdEnabled(axis, -1)}
              onRelease={() => release("phone", axis)}
            >
              <Minus />
            </HoldButton>
            <span>{name}</span>
            <HoldButton
              className="btn icon"
              label={words.jog.plus(name)}
              onHold={() => holdEnabled(axis, 1)}
              onRelease={() => release("phone", axis)}
            >
              <Plus />
            </HoldButton>
          </div>
        );
      })}
    </div>
  );
}

function GripButton() {
  const closed = useStore(
    cellStore,
    ({ document }) => programOf(document)?.steps.findLast(step => step.type === "gripper")?.closed === true,
  );
  return (
    <button
      className="btn"
      onClick={() => runCommand(closed ? "program.gripper-open" : "program.gripper-close")}
      aria-label={closed ? words.jog.gripperOpen : words.jog.gripperClose}
    >
      <Hand />
      {closed ? SAID.open : SAID.close}
    </button>
  );
}

/** The steps in a row: a tap chooses one and, with the switch held, goes there; held longer it shows the list. */
function Chips() {
  const program = useStore(cellStore, state => programOf(state.document));
  const selected = useStore(selectionStore, state => (state.selected?.kind === "step" ? state.selected.id : null));
  const verdict = useStore(playStore, state => state.verdict);
  const steps = useMemo(() => (program ? [...everyStep(program)] : []), [program]);
  const chosen = useRef<HTMLButtonElement>(null);
  const pressed_ms = useRef(0);
  useEffect(() => {
    chosen.current?.scrollIntoView({ inline: "center", block: "nearest" });
  }, [selected, steps.length]);
  if (steps.length === 0) return <p className="phone-chips muted small">{SAID.noSteps}</p>;
  return (
    <div className="phone-chips" role="list" aria-label={SAID.steps}>
      {steps.map((step, i) => (
        <span role="listitem" key={step.id}>
          <button
            ref={step.id === selected ? chosen : undefined}
            className="btn"
            aria-pressed={step.id === selected}
            onPointerDown={event => {
              pressed_ms.current = event.timeStamp;
            }}
            onContextMenu={event => event.preventDefault()}
            onClick={event => {
              select({ kind: "step", id: step.id });
              if (event.timeStamp - pressed_ms.current > LONG_MS) viewStore.setState({ sheet: "program" });
              else if (connectionStore.getState().enabled) runCommand("program.go-to");
            }}
          >
            <i className="mark" data-verdict={verdictOf(verdict, step.id)} aria-hidden />
            {stepWords(step, i)}
          </button>
        </span>
      ))}
    </div>
  );
}
