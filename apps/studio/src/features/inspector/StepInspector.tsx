import type { Program, Step } from "@twincell/core";
import { changeStep, deleteSteps, renameStep, stepWords } from "../../stores/program.ts";
import { runCommand } from "../../stores/commands.ts";
import { Segments } from "../../ui/Choice.tsx";
import { NumberField } from "../../ui/NumberField.tsx";
import { words } from "../../messages/index.ts";
import { MessageFields, PalletFields, PayloadFields } from "./BlockFields.tsx";
import { AssignFields, CallFields, ConditionField } from "./ComputeFields.tsx";
import { MoveFields } from "./MoveFields.tsx";
import { StepComments } from "./StepComments.tsx";
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
        {step.type === "move" && <MoveFields program={program} step={step} />}
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
        {step.type === "payload" && <PayloadFields step={step} />}
        {step.type === "message" && <MessageFields step={step} />}
        {step.type === "pallet" && <PalletFields program={program} step={step} />}
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
      <StepComments key={step.id} step={step.id} />
    </section>
  );
}
