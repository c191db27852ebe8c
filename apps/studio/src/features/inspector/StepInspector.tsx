import type { MoveStep, Program, Speed, Step } from "@twincell/core";
import { changeMove, changeStep, deleteSteps, renameStep, stepWords } from "../../stores/program.ts";
import { runCommand } from "../../stores/commands.ts";
import { Segments } from "../../ui/Choice.tsx";
import { NumberField } from "../../ui/NumberField.tsx";
import { words } from "../../messages/index.ts";
import { PoseFields } from "./PoseFields.tsx";
import { AssignFields, CallFields, ConditionField } from "./ComputeFields.tsx";
import { CommentFields, RepeatFields, SetFields, WaitForFields } from "./SignalFields.tsx";

export function StepInspector({ program, step, index }: { program: Program; step: Step; index: number }) {
  const group = step.group === undefined ? undefined : program.groups[step.group];
  return (
    <section aria-label={stepWords(step, index)}>
      <h2 className="heading">
        <span className="grow">{stepWords(step, index)}</span>
        {group && <span className="tag">{group.name}</span>}
      </h2>
      <div className="section stack">
        <div className="pair">
          <span className="label">{words.step.name}</span>
          <span className="field text">
            <input
              key={step.name ?? ""}
              aria-label={words.step.name}
              defaultValue={step.name ?? ""}
              placeholder={stepWords(step, index)}
              maxLength={60}
              onBlur={event => {
                if (event.currentTarget.value !== (step.name ?? "")) renameStep(step.id, event.currentTarget.value);
              }}
              onKeyDown={event => {
                if (event.key === "Enter") event.currentTarget.blur();
              }}
            />
          </span>
        </div>
        {step.type === "move" && <MoveFields step={step} />}
        {step.type === "wait" && (
          <div className="pair">
            <span className="label">{words.step.waitTime}</span>
            <NumberField
              label={words.step.waitTime}
              quantity="time"
              value={step.s}
              min={0}
              max={3600}
              onChange={(s, done) =>
                changeStep(
                  step.id,
                  words.undo.wait,
                  before => (before.type === "wait" ? { ...before, s } : before),
                  done ? undefined : `wait ${step.id}`,
                )
              }
            />
          </div>
        )}
        {step.type === "gripper" && (
          <div className="pair">
            <span className="label">{words.step.gripper}</span>
            <Segments
              label={words.step.gripper}
              value={step.closed ? "closed" : "open"}
              options={[
                { value: "open", words: words.step.open2 },
                { value: "closed", words: words.step.closed },
              ]}
              onChange={value =>
                changeStep(step.id, words.undo.gripper, before =>
                  before.type === "gripper" ? { ...before, closed: value === "closed" } : before,
                )
              }
            />
          </div>
        )}
        {step.type === "set" && <SetFields program={program} step={step} />}
        {step.type === "wait-for" && <WaitForFields program={program} step={step} />}
        {step.type === "comment" && <CommentFields step={step} />}
        {step.type === "repeat" && <RepeatFields step={step} />}
        {(step.type === "if" || step.type === "while") && <ConditionField program={program} step={step} />}
        {step.type === "assign" && <AssignFields program={program} step={step} />}
        {step.type === "call" && <CallFields program={program} step={step} />}
        <div className="row-flex">
          <button className="btn grow" onClick={() => runCommand("program.go-to")}>
            {words.tree.goTo}
          </button>
          {step.type === "move" && (
            <button className="btn grow" onClick={() => runCommand("program.touch-up")}>
              {words.jog.touchUp}
            </button>
          )}
          <button className="btn danger" onClick={() => deleteSteps([step.id])}>
            {words.common.remove}
          </button>
        </div>
      </div>
    </section>
  );
}

type SpeedKind = "ratio" | "mps" | "time_s";
const kindOf = (speed: Speed): SpeedKind => ("ratio" in speed ? "ratio" : "mps" in speed ? "mps" : "time_s");
const FRESH: Readonly<Record<SpeedKind, Speed>> = { ratio: { ratio: 0.4 }, mps: { mps: 0.1 }, time_s: { time_s: 2 } };
const pathIs = (value: string): value is MoveStep["path"] =>
  value === "ptp" || value === "lin" || value === "circ" || value === "spline";

function MoveFields({ step }: { step: MoveStep }) {
  const change = (label: string, next: (step: MoveStep) => MoveStep, done = true): boolean =>
    changeMove(step.id, label, next, done ? undefined : `${label} ${step.id}`);
  const kind = kindOf(step.speed);
  const { speed, target } = step;
  const paths =
    step.path === "circ" || step.path === "spline" ? (["ptp", "lin", step.path] as const) : (["ptp", "lin"] as const);
  return (
    <>
      <div className="pair">
        <span className="label">{words.step.pathLabel}</span>
        <Segments
          label={words.step.pathLabel}
          value={step.path}
          options={paths.map(value => ({ value, words: words.step.path[value] }))}
          onChange={value => {
            if (pathIs(value)) change(words.undo.path, before => ({ ...before, path: value }));
          }}
        />
      </div>
      <div className="pair">
        <span className="label">{words.step.kindOfSpeed}</span>
        <Segments
          label={words.step.kindOfSpeed}
          value={kind}
          options={[
            { value: "ratio", words: "%" },
            { value: "mps", words: "mm/s" },
            { value: "time_s", words: "s" },
          ]}
          onChange={value => change(words.undo.speed, before => ({ ...before, speed: FRESH[value] }))}
        />
      </div>
      <div className="pair">
        <span className="label">{words.step.kinds[kind]}</span>
        {"ratio" in speed ? (
          <NumberField
            label={words.step.speed}
            quantity="percent"
            value={speed.ratio}
            min={0.001}
            max={1}
            decimals={1}
            onChange={(ratio, done) => change(words.undo.speed, before => ({ ...before, speed: { ratio } }), done)}
          />
        ) : "mps" in speed ? (
          <NumberField
            label={words.step.speed}
            quantity="speed"
            value={speed.mps}
            min={0.0001}
            max={20}
            decimals={1}
            onChange={(mps, done) => change(words.undo.speed, before => ({ ...before, speed: { mps } }), done)}
          />
        ) : (
          <NumberField
            label={words.step.duration}
            quantity="time"
            value={speed.time_s}
            min={0.001}
            max={3600}
            onChange={(time_s, done) => change(words.undo.speed, before => ({ ...before, speed: { time_s } }), done)}
          />
        )}
      </div>
      <div className="pair">
        <span className="label">{words.step.blend}</span>
        <NumberField
          label={words.step.blend}
          quantity="length"
          value={step.blend_m}
          min={0}
          max={1}
          onChange={(blend_m, done) => change(words.undo.blend, before => ({ ...before, blend_m }), done)}
        />
      </div>
      <h3 className="label">
        {words.step.target}
        {"frame" in target && ` · ${target.frame} · ${target.tool}`}
      </h3>
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
