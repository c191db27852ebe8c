import type { CommentStep, Program, RepeatStep, SetStep, WaitForStep } from "@twincell/core";
import { changeStep } from "../../stores/program.ts";
import { Segments } from "../../ui/Choice.tsx";
import { words } from "../../messages/index.ts";
import { NumberField } from "../../ui/NumberField.tsx";
import { ConditionField, LimitFields } from "./ComputeFields.tsx";
import { LineCondition, SignalChoice } from "./LineFields.tsx";
import { Pair } from "./Pieces.tsx";

const ON_OFF = [
  { value: "on", words: words.common.on },
  { value: "off", words: words.common.off },
] as const;

/** Which output, what it becomes, and whether it goes back by itself. */
export function SetFields({ program, step }: { program: Program; step: SetStep }) {
  const set = (next: (before: SetStep) => SetStep, done = true): boolean =>
    changeStep(
      step.id,
      words.undo.signal,
      before => (before.type === "set" ? next(before) : before),
      done ? undefined : `set ${step.id}`,
    );
  const { to, pulse_s } = step;
  return (
    <>
      <SignalChoice
        program={program}
        end="-out"
        signal={step.signal}
        onChange={(signal, line) =>
          set(({ pulse_s: pulse, ...before }) => {
            const level = line.kind.startsWith("analogue");
            if (level) return { ...before, signal, to: typeof before.to === "number" ? before.to : 0 };
            const digital = { ...before, signal, to: typeof before.to === "boolean" ? before.to : true };
            return pulse === undefined ? digital : { ...digital, pulse_s: pulse };
          })
        }
      />
      {typeof to === "number" ? (
        <Pair label={words.step.to}>
          <NumberField
            label={words.step.to}
            quantity="plain"
            value={to}
            onChange={(level, done) => set(before => ({ ...before, to: level }), done)}
          />
        </Pair>
      ) : (
        <>
          <Pair label={words.step.to}>
            <Segments
              label={words.step.to}
              value={to ? "on" : "off"}
              options={ON_OFF}
              onChange={level => set(before => ({ ...before, to: level === "on" }))}
            />
          </Pair>
          <Pair label={words.editor.pulse}>
            <Segments
              label={words.editor.pulse}
              value={pulse_s === undefined ? "no" : "yes"}
              options={[
                { value: "no", words: words.editor.pulses.no },
                { value: "yes", words: words.editor.pulses.yes },
              ]}
              onChange={value =>
                set(({ pulse_s: _before, ...rest }) => (value === "no" ? rest : { ...rest, pulse_s: 0.5 }))
              }
            />
          </Pair>
          {pulse_s !== undefined && (
            <Pair label={words.editor.pulseTime}>
              <NumberField
                label={words.editor.pulseTime}
                quantity="time"
                value={pulse_s}
                min={0.001}
                max={3600}
                onChange={(s, done) => set(before => ({ ...before, pulse_s: s }), done)}
              />
            </Pair>
          )}
        </>
      )}
    </>
  );
}

/** Which line, and what it must be; or what is computed. */
export function WaitForFields({ program, step }: { program: Program; step: WaitForStep }) {
  const { when } = step;
  return (
    <>
      {!("expression" in when) && (
        <LineCondition
          program={program}
          when={when}
          label={words.step.until}
          onChange={(next, done) =>
            changeStep(
              step.id,
              words.undo.signal,
              before => (before.type === "wait-for" ? { ...before, when: next } : before),
              done ? undefined : `wait for ${step.id}`,
            )
          }
        />
      )}
      <ConditionField program={program} step={step} />
      <LimitFields step={step} />
    </>
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
