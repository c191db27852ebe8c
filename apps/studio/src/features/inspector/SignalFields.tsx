import type { CommentStep, Program, RepeatStep, SetStep, WaitForStep } from "@twincell/core";
import { changeStep } from "../../stores/program.ts";
import { Segments } from "../../ui/Choice.tsx";
import { words } from "../../messages/index.ts";
import { ConditionField, LimitFields } from "./ComputeFields.tsx";

const ON_OFF = [
  { value: "on", words: words.common.on },
  { value: "off", words: words.common.off },
] as const;

/** Which output, and what it becomes. */
export function SetFields({ program, step }: { program: Program; step: SetStep }) {
  return (
    <>
      <SignalChoice
        program={program}
        kind="-out"
        signal={step.signal}
        onChange={signal =>
          changeStep(step.id, words.undo.signal, before => (before.type === "set" ? { ...before, signal } : before))
        }
      />
      {typeof step.to === "boolean" && (
        <div className="pair">
          <span className="label">{words.step.to}</span>
          <Segments
            label={words.step.to}
            value={step.to ? "on" : "off"}
            options={ON_OFF}
            onChange={to =>
              changeStep(step.id, words.undo.signal, before =>
                before.type === "set" ? { ...before, to: to === "on" } : before,
              )
            }
          />
        </div>
      )}
    </>
  );
}

/** Which line, and what it must be. */
export function WaitForFields({ program, step }: { program: Program; step: WaitForStep }) {
  const { when } = step;
  if ("expression" in when)
    return (
      <>
        <ConditionField program={program} step={step} />
        <LimitFields step={step} />
      </>
    );
  return (
    <>
      <SignalChoice
        program={program}
        kind=""
        signal={when.signal}
        onChange={signal =>
          changeStep(step.id, words.undo.signal, before =>
            before.type === "wait-for" ? { ...before, when: { ...when, signal } } : before,
          )
        }
      />
      {"is" in when && (
        <div className="pair">
          <span className="label">{words.step.until}</span>
          <Segments
            label={words.step.until}
            value={when.is ? "on" : "off"}
            options={ON_OFF}
            onChange={is =>
              changeStep(step.id, words.undo.signal, before =>
                before.type === "wait-for" ? { ...before, when: { signal: when.signal, is: is === "on" } } : before,
              )
            }
          />
        </div>
      )}
      <ConditionField program={program} step={step} />
      <LimitFields step={step} />
    </>
  );
}

function SignalChoice({
  program,
  kind,
  signal,
  onChange,
}: {
  program: Program;
  kind: string;
  signal: string;
  onChange: (signal: string) => void;
}) {
  const names = Object.entries(program.signals)
    .filter(([, line]) => line.kind.endsWith(kind))
    .map(([name]) => name);
  return (
    <div className="pair">
      <span className="label">{words.step.signal}</span>
      <span className="field">
        <select aria-label={words.step.signal} value={signal} onChange={event => onChange(event.currentTarget.value)}>
          {[...new Set([signal, ...names])].map(name => (
            <option key={name}>{name}</option>
          ))}
        </select>
      </span>
    </div>
  );
}

export function CommentFields({ step }: { step: CommentStep }) {
  const take = (text: string): void => {
    if (text !== step.text)
      changeStep(step.id, words.undo.comment, before => (before.type === "comment" ? { ...before, text } : before));
  };
  return (
    <div className="pair">
      <span className="label">{words.step.text}</span>
      <span className="field text">
        <input
          key={step.text}
          aria-label={words.step.text}
          defaultValue={step.text}
          maxLength={200}
          onBlur={event => take(event.currentTarget.value)}
          onKeyDown={event => {
            if (event.key === "Enter") event.currentTarget.blur();
          }}
        />
      </span>
    </div>
  );
}

/** How often a loop goes round. */
export function RepeatFields({ step }: { step: RepeatStep }) {
  const set = (times: RepeatStep["times"]): void => {
    if (times !== step.times)
      changeStep(step.id, words.undo.times, before => (before.type === "repeat" ? { ...before, times } : before));
  };
  const take = (typed: string): void => {
    const times = Number(typed);
    if (Number.isInteger(times) && times >= 1 && times <= MAX_TIMES) set(times);
  };
  return (
    <>
      <div className="pair">
        <span className="label">{words.step.times}</span>
        <Segments
          label={words.step.times}
          value={step.times === "forever" ? "forever" : "counted"}
          options={[
            { value: "counted", words: words.step.counted },
            { value: "forever", words: words.step.endless },
          ]}
          onChange={value => set(value === "forever" ? "forever" : 2)}
        />
      </div>
      {step.times !== "forever" && (
        <div className="pair">
          <span className="label" />
          <span className="field">
            <input
              key={step.times}
              type="number"
              min={1}
              max={MAX_TIMES}
              aria-label={words.step.times}
              defaultValue={step.times}
              onBlur={event => take(event.currentTarget.value)}
              onKeyDown={event => {
                if (event.key === "Enter") event.currentTarget.blur();
              }}
            />
          </span>
        </div>
      )}
    </>
  );
}
const MAX_TIMES = 1_000_000;
