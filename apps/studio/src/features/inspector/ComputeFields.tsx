import {
  callableFrom,
  checkType,
  everyIn,
  initialOf,
  nothingOf,
  parseExpression,
  predicateOf,
  predicateText,
  printExpression,
  routineOf,
  scopeOf,
  variableNameFault,
  type AssignStep,
  type CallStep,
  type Expression,
  type ExpressionScope,
  type IfStep,
  type Predicate,
  type Program,
  type Step,
  type Unit,
  UNITS,
  type ValueType,
  type Variable,
  type WaitForStep,
  type WhileStep,
} from "@twincell/core";
import { useId, useState } from "react";
import { changeStep, firstArguments, removeVariables, setVariable } from "../../stores/program.ts";
import { Segments } from "../../ui/Choice.tsx";
import { NumberField } from "../../ui/NumberField.tsx";
import { words } from "../../messages/index.ts";

const BOOL: ValueType = { type: "bool" };

/** What names mean where the step stands: parameters belong to their routine. */
function scopeAt(program: Program, id: string): ExpressionScope {
  const routine = routineOf(program, id);
  const { signals, variables = {}, parameters = {} } = program;
  return scopeOf({ signals, variables, parameters, routine });
}

/** An expression as text. What is wrong is said at once, with the characters that are meant. */
function ExpressionField({
  label,
  text,
  wanted,
  scope,
  onChange,
}: {
  readonly label: string;
  readonly text: string;
  readonly wanted: ValueType;
  readonly scope: ExpressionScope;
  readonly onChange: (expression: Expression) => void;
}) {
  const [typed, setTyped] = useState<string | null>(null);
  const id = useId();
  const shown = typed ?? text;
  const answer = typed === null ? undefined : parseExpression(typed, wanted, scope);
  const take = (): void => {
    if (answer?.kind !== "expression") return;
    setTyped(null);
    if (typed !== text) onChange(answer.expression);
  };
  return (
    <div className="expression-field">
      <span className="field text">
        <input
          aria-label={label}
          aria-invalid={answer?.kind === "fault"}
          aria-describedby={answer?.kind === "fault" ? id : undefined}
          value={shown}
          maxLength={2000}
          spellCheck={false}
          onChange={event => setTyped(event.currentTarget.value)}
          onBlur={take}
          onKeyDown={event => {
            if (event.key === "Enter") take();
            if (event.key === "Escape") setTyped(null);
          }}
        />
      </span>
      {answer?.kind === "fault" && (
        <p className="field-fault" id={id} role="alert">
          <code className="expression-place" aria-hidden>
            {shown.slice(Math.max(0, answer.at - 12), answer.at)}
            <mark>{shown.slice(answer.at, answer.at + answer.length) || "␣"}</mark>
          </code>{" "}
          {answer.sentence}
        </p>
      )}
    </div>
  );
}

const isDigital = (program: Program) => (signal: string) => program.signals[signal]?.kind.startsWith("digital") ?? true;

/** The condition of a decision, a loop or a wait. */
export function ConditionField({ program, step }: { program: Program; step: IfStep | WhileStep | WaitForStep }) {
  return (
    <div className="stack">
      <span className="label">{words.step.condition}</span>
      <ExpressionField
        key={step.id}
        label={words.step.condition}
        text={predicateText(step.when)}
        wanted={BOOL}
        scope={scopeAt(program, step.id)}
        onChange={expression => {
          const when: Predicate = predicateOf(expression, isDigital(program));
          changeStep(step.id, words.undo.condition, before =>
            before.type === "if" || before.type === "while" || before.type === "wait-for"
              ? { ...before, when }
              : before,
          );
        }}
      />
    </div>
  );
}

/** How long a wait may last, and what is done then. */
export function LimitFields({ step }: { step: WaitForStep }) {
  const change = (next: (before: WaitForStep) => WaitForStep, done = true): boolean =>
    changeStep(
      step.id,
      words.undo.limit,
      before => (before.type === "wait-for" ? next(before) : before),
      done ? undefined : `limit ${step.id}`,
    );
  const { timeout_s } = step;
  return (
    <>
      <div className="pair">
        <span className="label">{words.step.limit}</span>
        <Segments
          label={words.step.limit}
          value={timeout_s === undefined ? "none" : "limited"}
          options={[
            { value: "none", words: words.step.noLimit },
            { value: "limited", words: words.step.limited },
          ]}
          onChange={value =>
            change(({ timeout_s: _limit, late: _late, ...rest }) =>
              value === "none" ? rest : { ...rest, timeout_s: 5 },
            )
          }
        />
      </div>
      {timeout_s !== undefined && (
        <>
          <div className="pair">
            <span className="label" />
            <NumberField
              label={words.step.limit}
              quantity="time"
              value={timeout_s}
              min={0.02}
              max={3600}
              onChange={(s, done) => change(before => ({ ...before, timeout_s: s }), done)}
            />
          </div>
          <div className="pair">
            <span className="label">{words.step.whenLate}</span>
            <Segments
              label={words.step.whenLate}
              value={step.late === undefined ? "stop" : "steps"}
              options={[
                { value: "stop", words: words.step.stops },
                { value: "steps", words: words.step.goesOn },
              ]}
              onChange={value =>
                change(({ late, ...rest }) => (value === "stop" ? rest : { ...rest, late: late ?? [] }))
              }
            />
          </div>
        </>
      )}
    </>
  );
}

/** A variable, and what it becomes. */
export function AssignFields({ program, step }: { program: Program; step: AssignStep }) {
  const [naming, setNaming] = useState<string | null>(null);
  const { variables = {} } = program;
  const variable = variables[step.variable];
  const choose = (name: string): void => {
    const type = program.variables?.[name] ?? { type: "int" };
    changeStep(step.id, words.undo.variable, before =>
      before.type === "assign" ? { ...before, variable: name, to: fitting(before.to, type, program, step) } : before,
    );
  };
  const taken = { ...program.signals, ...variables };
  const unused = Object.keys(variables).filter(name => usesOf(program, name) === 0);
  const wrong = naming === null || naming === "" ? undefined : variableNameFault(naming, taken);
  const make = (): void => {
    if (naming !== null && naming !== "" && wrong === undefined) {
      setVariable(naming, { type: "int" });
      choose(naming);
    }
    setNaming(null);
  };
  return (
    <>
      <div className="pair">
        <span className="label">{words.step.variable}</span>
        <span className="field">
          <select
            aria-label={words.step.variable}
            value={step.variable}
            onChange={event => (event.currentTarget.value === "" ? setNaming("") : choose(event.currentTarget.value))}
          >
            {[...new Set([step.variable, ...Object.keys(variables)])].map(name => (
              <option key={name}>{name}</option>
            ))}
            <option value="">{words.step.newVariable}</option>
          </select>
        </span>
      </div>
      {naming !== null && (
        <div className="stack">
          <span className="field text">
            <input
              autoFocus
              aria-label={words.step.newVariableName}
              aria-invalid={wrong !== undefined}
              value={naming}
              maxLength={24}
              onChange={event => setNaming(event.currentTarget.value)}
              onBlur={make}
              onKeyDown={event => {
                if (event.key === "Enter") make();
                if (event.key === "Escape") setNaming(null);
              }}
            />
          </span>
          {wrong !== undefined && (
            <p className="field-fault" role="alert">
              {words.step.variableNames[wrong]}
            </p>
          )}
        </div>
      )}
      <div className="stack">
        <span className="label">{words.step.value}</span>
        <ExpressionField
          key={`${step.id} ${step.variable}`}
          label={words.step.value}
          text={printExpression(step.to)}
          wanted={variable ?? { type: "int" }}
          scope={scopeAt(program, step.id)}
          onChange={to =>
            changeStep(step.id, words.undo.value, before => (before.type === "assign" ? { ...before, to } : before))
          }
        />
      </div>
      {variable !== undefined && <VariableFields program={program} name={step.variable} variable={variable} />}
      {unused.length > 0 && (
        <button className="btn" title={unused.join(", ")} onClick={() => removeVariables(unused)}>
          {words.step.removeUnused(unused.length)}
        </button>
      )}
    </>
  );
}

/** What was assigned, where it fits the variable; else its first value. */
function fitting(to: Expression, type: ValueType, program: Program, step: Step): Expression {
  return checkType(to, type, scopeAt(program, step.id)).kind === "typed" ? to : nothingOf(type);
}

/** Kind, unit and first value of a variable. They can be changed while nothing else uses it in another way. */
function VariableFields({
  program,
  name,
  variable,
}: {
  readonly program: Program;
  readonly name: string;
  readonly variable: Variable;
}) {
  const isUsed = usesOf(program, name) > 1;
  const first = initialOf(variable);
  return (
    <>
      <div className="pair">
        <span className="label">{words.step.kindOfValue}</span>
        <span className="field">
          <select
            aria-label={words.step.kindOfValue}
            disabled={isUsed}
            value={variable.type}
            onChange={event => setVariable(name, { type: event.currentTarget.value as Variable["type"] })}
          >
            {(["bool", "int", "num"] as const).map(type => (
              <option key={type} value={type}>
                {words.step.valueKinds[type]}
              </option>
            ))}
          </select>
        </span>
      </div>
      {variable.type === "num" && (
        <div className="pair">
          <span className="label">{words.step.unit}</span>
          <span className="field">
            <select
              aria-label={words.step.unit}
              disabled={isUsed}
              value={variable.unit ?? ""}
              onChange={event => {
                const unit = UNITS.find(each => each === event.currentTarget.value);
                setVariable(name, unit === undefined ? { type: "num" } : { type: "num", unit });
              }}
            >
              {(["", ...UNITS] as const).map(unit => (
                <option key={unit} value={unit}>
                  {unit === "" ? words.step.noUnit : unit}
                </option>
              ))}
            </select>
          </span>
        </div>
      )}
      {variable.type === "bool" ? (
        <div className="pair">
          <span className="label">{words.step.firstValue}</span>
          <Segments
            label={words.step.firstValue}
            value={first === true ? "yes" : "no"}
            options={[
              { value: "no", words: words.step.no },
              { value: "yes", words: words.step.yes },
            ]}
            onChange={value => setVariable(name, { ...variable, initial: value === "yes" })}
          />
        </div>
      ) : (
        <div className="stack">
          <span className="label">{words.step.firstValue}</span>
          <ExpressionField
            key={`${name} ${variable.type}`}
            label={words.step.firstValue}
            text={printExpression(literal(Number(first), variable))}
            wanted={variable}
            scope={NO_NAMES}
            onChange={value => {
              const number = typeof value === "object" && "value" in value ? value.value : value;
              if (typeof number === "number") setVariable(name, { ...variable, initial: number });
            }}
          />
        </div>
      )}
    </>
  );
}

const NO_NAMES: ExpressionScope = { variable: () => undefined, signal: () => undefined };
const literal = (value: number, type: ValueType): Expression => {
  const unit: Unit | undefined = type.type === "num" ? type.unit : undefined;
  return unit === undefined ? value : { value, unit };
};

/** How many steps name the variable. */
function usesOf(program: Program, name: string): number {
  const mark = `"${name}"`;
  let uses = 0;
  for (const steps of [program.steps, ...Object.values(program.routines)])
    for (const step of everyIn(steps)) {
      const { type } = step;
      if (type !== "assign" && type !== "if" && type !== "while" && type !== "wait-for" && type !== "call") continue;
      const own = type === "assign" ? { ...step } : type === "call" ? step.arguments : step.when;
      if (JSON.stringify(own ?? {}).includes(mark)) uses++;
    }
  return uses;
}

/** Which routine, and what it is given. */
export function CallFields({ program, step }: { program: Program; step: CallStep }) {
  const wanted = Object.entries(program.parameters?.[step.routine] ?? {});
  return (
    <>
      <div className="pair">
        <span className="label">{words.step.routineLabel}</span>
        <span className="field">
          <select
            aria-label={words.step.routineLabel}
            value={step.routine}
            onChange={event => {
              const routine = event.currentTarget.value;
              changeStep(step.id, words.undo.call, before => {
                if (before.type !== "call") return before;
                const { arguments: _given, ...rest } = before;
                return { ...rest, routine, ...firstArguments(program, routine) };
              });
            }}
          >
            {[...new Set([step.routine, ...callableFrom(program, routineOf(program, step.id))])].map(name => (
              <option key={name}>{name}</option>
            ))}
          </select>
        </span>
      </div>
      {wanted.map(([name, type]) => (
        <div className="stack" key={name}>
          <span className="label">{name}</span>
          <ExpressionField
            key={`${step.id} ${step.routine} ${name}`}
            label={words.step.argument(name)}
            text={printExpression(step.arguments?.[name] ?? nothingOf(type))}
            wanted={type}
            scope={scopeAt(program, step.id)}
            onChange={value =>
              changeStep(step.id, words.undo.call, before =>
                before.type === "call" ? { ...before, arguments: { ...before.arguments, [name]: value } } : before,
              )
            }
          />
        </div>
      ))}
    </>
  );
}
