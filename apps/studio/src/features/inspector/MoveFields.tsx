import { type MoveStep, type Program, type Speed } from "@twincell/core";
import { useStore } from "zustand";
import { solveStep } from "../../runtime/jog/solve.ts";
import { theLive } from "../../runtime/live.ts";
import { cellStore } from "../../stores/cell.ts";
import { notify } from "../../stores/notices.ts";
import { changeMove } from "../../stores/program.ts";
import { choosePath, countFrom, countsFrom, JOINTS, takeVia } from "../../stores/structure.ts";
import { Segments } from "../../ui/Choice.tsx";
import { NumberField } from "../../ui/NumberField.tsx";
import { showNumber } from "../../ui/expression.ts";
import { Tip } from "../../ui/Tip.tsx";
import { words } from "../../messages/index.ts";
import { firstCondition, LineCondition } from "./LineFields.tsx";
import { NameChoice, Pair } from "./Pieces.tsx";
import { PoseFields } from "./PoseFields.tsx";

type SpeedKind = "ratio" | "mps" | "time_s";
const kindOf = (speed: Speed): SpeedKind => ("ratio" in speed ? "ratio" : "mps" in speed ? "mps" : "time_s");
const FRESH: Readonly<Record<SpeedKind, Speed>> = { ratio: { ratio: 0.4 }, mps: { mps: 0.1 }, time_s: { time_s: 2 } };
const PATHS = ["ptp", "lin", "circ", "spline"] as const;
type Change = (label: string, next: (step: MoveStep) => MoveStep, done?: boolean) => boolean;
const tool = (): string => cellStore.getState().document?.tool ?? "flange";

/** Everything a motion has: its path, how fast, how it ends, and where. */
export function MoveFields({ program, step }: { readonly program: Program; readonly step: MoveStep }) {
  const change: Change = (label, next, done = true) =>
    changeMove(step.id, label, next, done ? undefined : `${label} ${step.id}`);
  return (
    <>
      <Pair label={words.step.pathLabel}>
        <Segments
          label={words.step.pathLabel}
          value={step.path}
          options={PATHS.map(value => ({ value, words: words.step.path[value] }))}
          onChange={path => choosePath(step.id, path, theLive().q_rad, tool())}
        />
      </Pair>
      <SpeedFields step={step} change={change} />
      <BlendFields step={step} change={change} />
      {step.path === "circ" && step.via !== undefined && (
        <Pair label={words.editor.via}>
          <Tip words={words.editor.viaTip}>
            <button className="btn" onClick={() => takeVia(step.id, theLive().q_rad, tool())}>
              {words.editor.takeVia}
            </button>
          </Tip>
        </Pair>
      )}
      <TargetFields program={program} step={step} change={change} />
      <details className="small" open={step.until !== undefined || step.acceleration !== undefined}>
        <summary>{words.common.more}</summary>
        <div className="stack">
          <Pair label={words.editor.acceleration}>
            <NumberField
              label={words.editor.acceleration}
              quantity="percent"
              value={step.acceleration?.ratio ?? 1}
              min={0.01}
              max={1}
              decimals={0}
              onChange={(ratio, done) =>
                change(
                  words.editor.undo.acceleration,
                  ({ acceleration: _before, ...rest }) => (ratio === 1 ? rest : { ...rest, acceleration: { ratio } }),
                  done,
                )
              }
            />
          </Pair>
          <SearchFields program={program} step={step} change={change} />
        </div>
      </details>
    </>
  );
}

function SpeedFields({ step, change }: { readonly step: MoveStep; readonly change: Change }) {
  const { speed } = step;
  const kind = kindOf(speed);
  const set = (next: Speed, done = true): boolean =>
    change(words.undo.speed, before => ({ ...before, speed: next }), done);
  return (
    <>
      <Pair label={words.step.kindOfSpeed}>
        <Segments
          label={words.step.kindOfSpeed}
          value={kind}
          options={[
            { value: "ratio", words: "%" },
            { value: "mps", words: "mm/s" },
            { value: "time_s", words: "s" },
          ]}
          onChange={value => set(FRESH[value])}
        />
      </Pair>
      <Pair label={words.step.kinds[kind]}>
        {"ratio" in speed ? (
          <NumberField
            label={words.step.speed}
            quantity="percent"
            value={speed.ratio}
            min={0.001}
            max={1}
            decimals={1}
            onChange={(ratio, done) => set({ ratio }, done)}
          />
        ) : "mps" in speed ? (
          <NumberField
            label={words.step.speed}
            quantity="speed"
            value={speed.mps}
            min={0.0001}
            max={20}
            decimals={1}
            onChange={(mps, done) => set({ mps }, done)}
          />
        ) : (
          <NumberField
            label={words.step.duration}
            quantity="time"
            value={speed.time_s}
            min={0.001}
            max={3600}
            onChange={(time_s, done) => set({ time_s }, done)}
          />
        )}
      </Pair>
      {step.path !== "ptp" && <BeltSpeeds onChoose={mps => set({ mps })} />}
    </>
  );
}

/** The tool goes as fast as a conveyor of the cell (row M-56). */
function BeltSpeeds({ onChoose }: { readonly onChoose: (mps: number) => void }) {
  const objects = useStore(cellStore, state => state.document?.objects);
  const belts = (objects ?? []).filter(({ belt }) => belt !== undefined && belt.speed_mps !== 0);
  return belts.map(({ id, name, belt }) => {
    const mps = Math.abs(belt?.speed_mps ?? 0);
    return (
      <button key={id} className="btn small" onClick={() => onChoose(mps)}>
        {words.step.asBelt(name, showNumber(mps, "speed", 0))}
      </button>
    );
  });
}

/** By a length, or by a share of the shorter neighbouring path: never both. */
function BlendFields({ step, change }: { readonly step: MoveStep; readonly change: Change }) {
  const isShare = (step.blend_ratio ?? 0) > 0;
  return (
    <>
      <Pair label={words.editor.blendAs}>
        <Segments
          label={words.editor.blendAs}
          value={isShare ? "ratio" : "mm"}
          options={[
            { value: "mm", words: words.editor.blends.mm },
            { value: "ratio", words: words.editor.blends.ratio },
          ]}
          onChange={value =>
            change(words.undo.blend, ({ blend_ratio: _before, ...rest }) =>
              value === "mm" ? rest : { ...rest, blend_m: 0, blend_ratio: 0.5 },
            )
          }
        />
      </Pair>
      <Pair label={words.step.blend}>
        {isShare ? (
          <NumberField
            label={words.step.blend}
            quantity="percent"
            value={step.blend_ratio ?? 0}
            min={0.01}
            max={1}
            decimals={0}
            onChange={(blend_ratio, done) => change(words.undo.blend, before => ({ ...before, blend_ratio }), done)}
          />
        ) : (
          <NumberField
            label={words.step.blend}
            quantity="length"
            value={step.blend_m}
            min={0}
            max={1}
            onChange={(blend_m, done) => change(words.undo.blend, before => ({ ...before, blend_m }), done)}
          />
        )}
      </Pair>
    </>
  );
}

/** A move that ends where it is when a line says so. */
function SearchFields({
  program,
  step,
  change,
}: {
  readonly program: Program;
  readonly step: MoveStep;
  readonly change: Change;
}) {
  const { until } = step;
  const [line] = Object.entries(program.signals).filter(([, { kind }]) => kind.endsWith("-in"));
  return (
    <>
      <Pair label={words.editor.ends}>
        <Segments
          label={words.editor.ends}
          value={until === undefined ? "no" : "signal"}
          options={[
            { value: "no", words: words.editor.endsKinds.no },
            { value: "signal", words: words.editor.endsKinds.signal, disabled: line === undefined },
          ]}
          onChange={value =>
            change(words.editor.undo.search, ({ until: _before, ...rest }) =>
              value === "no" || line === undefined
                ? rest
                : { ...rest, until: { when: firstCondition(...line), missing: "fault" } },
            )
          }
        />
      </Pair>
      {until !== undefined && (
        <>
          <LineCondition
            program={program}
            when={until.when}
            label={words.step.until}
            onChange={(when, done) =>
              change(words.editor.undo.search, before => ({ ...before, until: { ...until, when } }), done)
            }
          />
          <Pair label={words.editor.missing}>
            <Segments
              label={words.editor.missing}
              value={until.missing}
              options={[
                { value: "fault", words: words.editor.missings.fault },
                { value: "continue", words: words.editor.missings.continue },
              ]}
              onChange={missing =>
                change(words.editor.undo.search, before => ({ ...before, until: { ...until, missing } }))
              }
            />
          </Pair>
        </>
      )}
    </>
  );
}

function TargetFields({
  program,
  step,
  change,
}: {
  readonly program: Program;
  readonly step: MoveStep;
  readonly change: Change;
}) {
  const { target } = step;
  const shown = (name: string): string =>
    name === JOINTS
      ? words.editor.asJoints
      : name === "world"
        ? words.editor.world
        : Object.hasOwn(program.pallets, name)
          ? words.editor.placesOf(name)
          : name;
  return (
    <>
      <h3 className="label">
        {words.step.target} · {target.tool ?? "flange"}
      </h3>
      <NameChoice
        label={words.editor.counts}
        value={"q" in target ? JOINTS : target.frame}
        names={[JOINTS, ...countsFrom(program, step.id)]}
        shown={shown}
        onChange={from => {
          const q = (of: MoveStep): Float64Array | undefined => {
            const there = solveStep(of, theLive().q_rad);
            return there.kind === "reached" ? there.q_rad : undefined;
          };
          if (!countFrom(step.id, from, q)) notify("warn", words.editor.notCounted);
        }}
      />
      {"q" in target ? (
        <div className="fields-3">
          {target.q.map((q, i) => (
            <NumberField
              key={i}
              label={words.inspector.joint(i + 1)}
              mark={words.time.joint(i + 1)}
              quantity="angle"
              value={q}
              onChange={(value, done) =>
                change(
                  words.undo.target,
                  before =>
                    "q" in before.target
                      ? { ...before, target: { ...before.target, q: before.target.q.with(i, value) } }
                      : before,
                  done,
                )
              }
            />
          ))}
        </div>
      ) : (
        <PoseFields
          pose={target.pose}
          onChange={(pose, done) =>
            change(
              words.undo.target,
              before =>
                "pose" in before.target
                  ? {
                      ...before,
                      target: { ...before.target, pose: { position: pose.position, quaternion: pose.quaternion } },
                    }
                  : before,
              done,
            )
          }
        />
      )}
      {"branch" in target && target.branch && (
        <p className="small dim">{`${target.branch.shoulder} · ${target.branch.elbow} · ${target.branch.wrist}`}</p>
      )}
    </>
  );
}
