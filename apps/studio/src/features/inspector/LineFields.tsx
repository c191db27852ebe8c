import type { Condition, Program, SignalLine } from "@twincell/core";
import { useState } from "react";
import { setLine } from "../../stores/structure.ts";
import { Segments } from "../../ui/Choice.tsx";
import { NumberField } from "../../ui/NumberField.tsx";
import { words } from "../../messages/index.ts";
import { NameChoice, Pair, TextField, WholeField } from "./Pieces.tsx";

const ON_OFF = [
  { value: "on", words: words.common.on },
  { value: "off", words: words.common.off },
] as const;
const KINDS = ["digital-in", "digital-out", "analogue-in", "analogue-out"] as const;
/** First addresses of lines that the program gets, by what they are. */
const FIRST_ADDRESS: Readonly<Record<SignalLine["kind"], number>> = {
  "digital-in": 1001,
  "digital-out": 1,
  "analogue-in": 1,
  "analogue-out": 1,
};
const MOST_ADDRESS = 65_535;

/** Which line of the program, or a new one; its kind and address below it. */
export function SignalChoice({
  program,
  end,
  signal,
  onChange,
}: {
  readonly program: Program;
  /** "-in" or "-out": which lines are offered; "" for both. */
  readonly end: "-in" | "-out" | "";
  readonly signal: string;
  readonly onChange: (signal: string, line: SignalLine) => void;
}) {
  const [naming, setNaming] = useState(false);
  const names = Object.entries(program.signals)
    .filter(([, line]) => line.kind.endsWith(end))
    .map(([name]) => name);
  const line = program.signals[signal];
  const make = (name: string): void => {
    const kind = end === "-out" ? "digital-out" : "digital-in";
    const fresh: SignalLine = { kind, address: freeAddress(program, kind) };
    setNaming(false);
    setLine(name, fresh);
    onChange(name, fresh);
  };
  const fault = (typed: string): string | undefined =>
    typed.trim() === "" || Object.hasOwn(program.signals, typed) || Object.hasOwn(program.variables ?? {}, typed)
      ? words.editor.lineTaken
      : undefined;
  return (
    <>
      <NameChoice
        label={words.step.signal}
        value={signal}
        names={names}
        more={words.editor.newLine}
        onChange={name => {
          if (name === "") setNaming(true);
          else onChange(name, program.signals[name] ?? { kind: "digital-in" });
        }}
      />
      {naming && (
        <TextField label={words.editor.newLineName} value="" most={40} fault={fault} autoFocus onTake={make} />
      )}
      {line !== undefined && (
        <>
          <NameChoice
            label={words.editor.lineKind}
            value={line.kind}
            names={KINDS.filter(kind => kind.endsWith(end))}
            shown={kind => words.editor.lineKinds[kind as SignalLine["kind"]]}
            onChange={kind => {
              const next: SignalLine = { ...line, kind: kind as SignalLine["kind"] };
              setLine(signal, next);
              onChange(signal, next);
            }}
          />
          <WholeField
            key={signal}
            label={words.editor.address}
            value={line.address ?? 0}
            least={0}
            most={MOST_ADDRESS}
            onChange={address => {
              setLine(signal, { ...line, address });
            }}
          />
        </>
      )}
    </>
  );
}

function freeAddress({ signals }: Program, kind: SignalLine["kind"]): number {
  const taken = Object.values(signals).flatMap(line => (line.kind === kind ? [line.address ?? 0] : []));
  return taken.length === 0 ? FIRST_ADDRESS[kind] : Math.max(...taken) + 1;
}

/** The condition of one line that is meant when the line becomes another: on, or above 0. */
export const firstCondition = (signal: string, line: SignalLine | undefined): Condition =>
  line?.kind.startsWith("analogue") === true ? { signal, above: 0 } : { signal, is: true };

/** One line and what it must be: on or off, above or below a level. */
export function LineCondition({
  program,
  when,
  label,
  onChange,
}: {
  readonly program: Program;
  readonly when: Condition;
  readonly label: string;
  readonly onChange: (when: Condition, done: boolean) => void;
}) {
  const { signal } = when;
  return (
    <>
      <SignalChoice
        program={program}
        end=""
        signal={signal}
        onChange={(name, line) => {
          if (name !== signal || line.kind.startsWith("analogue") === "is" in when)
            onChange(firstCondition(name, line), true);
        }}
      />
      {"is" in when ? (
        <Pair label={label}>
          <Segments
            label={label}
            value={when.is ? "on" : "off"}
            options={ON_OFF}
            onChange={is => onChange({ signal, is: is === "on" }, true)}
          />
        </Pair>
      ) : (
        <>
          <Pair label={label}>
            <Segments
              label={label}
              value={"above" in when ? "above" : "below"}
              options={[
                { value: "above", words: words.editor.above },
                { value: "below", words: words.editor.below },
              ]}
              onChange={side => onChange(withLevel(signal, side, levelOf(when)), true)}
            />
          </Pair>
          <Pair label={words.editor.level}>
            <NumberField
              label={words.editor.level}
              quantity="plain"
              value={levelOf(when)}
              onChange={(level, done) => onChange(withLevel(signal, "above" in when ? "above" : "below", level), done)}
            />
          </Pair>
        </>
      )}
    </>
  );
}
const levelOf = (when: Condition): number => ("above" in when ? when.above : "below" in when ? when.below : 0);
const withLevel = (signal: string, side: "above" | "below", level: number): Condition =>
  side === "above" ? { signal, above: level } : { signal, below: level };
