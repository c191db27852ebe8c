import { useStore } from "zustand";
import { jogStore, JOG_STEPS_M, LARGEST_DRAG, SMALLEST_DRAG, type JogState } from "../../stores/jog.ts";
import { followTargetStore, showFollowTarget } from "../../stores/follow-target.ts";
import { Chooser, Segments } from "../../ui/Choice.tsx";
import { showNumber } from "../../ui/expression.ts";
import { Slide } from "../../ui/Slide.tsx";
import { say, words } from "../../messages/index.ts";

/** A step in mm has its step in degrees beside it. */
const stepDegrees = (step_m: number): number => Math.min(10, Math.max(0.01, step_m * 200));
const shown = (step_m: number): string =>
  words.jog.stepOf(showNumber(step_m, "length", step_m < 0.001 ? 1 : 0), String(stepDegrees(step_m)));

/** Moving while held, or in steps; how fast, or how far. */
export function JogMode() {
  const manner = useStore(jogStore, state => state.manner);
  const step = useStore(jogStore, state => state.step_m);
  const speed = useStore(jogStore, state => state.speed);
  const steps = JOG_STEPS_M.map(step_m => ({ value: String(step_m), words: shown(step_m) }));
  return (
    <div className="manner">
      <Segments<JogState["manner"]>
        label={words.jog.manner}
        value={manner}
        onChange={next => jogStore.setState({ manner: next })}
        options={[
          { value: "hold", words: words.jog.hold },
          { value: "steps", words: words.jog.steps },
        ]}
      />
      {manner === "steps" ? (
        <Chooser
          label={words.jog.step}
          value={String(step)}
          options={steps}
          onChange={raw =>
            jogStore.setState({ step_m: Number(raw), step_rad: (stepDegrees(Number(raw)) * Math.PI) / 180 })
          }
        />
      ) : (
        <div className="manner-speed">
          <Slide
            label={words.jog.speed}
            value={speed}
            min={0.02}
            says={words.jog.speedOf(Math.round(speed * 100))}
            onChange={next => jogStore.setState({ speed: next })}
          />
          <span className="num small">{Math.round(speed * 100)} %</span>
        </div>
      )}
    </div>
  );
}

const LOCKS = ["x", "y", "z", "turn"] as const;
/** How the ring at the tool follows the hand: a share of its way, and what it leaves alone. */
export function DragManner() {
  const share = useStore(jogStore, state => state.dragScale);
  const locks = useStore(jogStore, state => state.locks);
  return (
    <div className="point-row drag-manner" role="group" aria-label={words.jog.drag}>
      <span className="point-label">{words.jog.drag}</span>
      <Chooser
        label={words.jog.dragScale}
        value={String(share)}
        options={DRAG_SCALES.map(each => ({ value: String(each), words: words.jog.dragShare(each) }))}
        onChange={raw => jogStore.setState({ dragScale: Number(raw) })}
      />
      {LOCKS.map(lock => (
        <button
          key={lock}
          className="btn tight"
          aria-pressed={locks[lock]}
          aria-label={words.jog.lock(words.jog.lockNames[lock])}
          title={words.jog.lock(words.jog.lockNames[lock])}
          onClick={() => jogStore.setState({ locks: { ...locks, [lock]: !locks[lock] } })}
        >
          {words.jog.lockNames[lock]}
        </button>
      ))}
    </div>
  );
}

/** The target sphere: the jog keys move it, the arm follows, and how far the tool is from it is said. */
export function TargetManner() {
  const { on, kind, off_m, joint, why } = useStore(followTargetStore);
  const jointFrame = useStore(jogStore, state => state.frame === "joint");
  const off = showNumber(off_m, "length", 1);
  const status = {
    "on-target": words.jog.targetThere,
    behind: words.jog.targetBehind(off, joint ?? 0),
    "out-of-reach": words.jog.targetOut(off),
  }[kind];
  return (
    <>
      <div className="point-row">
        <span className="point-label">{words.jog.target}</span>
        <button className="btn" aria-pressed={on} title={words.jog.targetTip} onClick={() => showFollowTarget(!on)}>
          {words.jog.targetFollow}
        </button>
      </div>
      {on && (
        <p className="small target-status" role="status" data-verdict={jointFrame ? "ok" : VERDICTS[kind]}>
          {jointFrame ? words.jog.targetJoints : why === null ? status : `${status} ${say(why)}`}
        </p>
      )}
    </>
  );
}
const VERDICTS = { "on-target": "ok", behind: "warn", "out-of-reach": "bad" } as const;

const DRAG_SCALES = [SMALLEST_DRAG, 0.2, 0.5, 1, LARGEST_DRAG] as const;
