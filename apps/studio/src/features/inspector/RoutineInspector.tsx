import {
  everyStep,
  readsVariable,
  UNITS,
  variableNameFault,
  type Program,
  type Unit,
  type ValueType,
} from "@twincell/core";
import { Trash2 } from "lucide-react";
import { useState } from "react";
import { deleteParameter, deleteRoutine, nameRoutine, setParameter } from "../../stores/structure.ts";
import { Tip } from "../../ui/Tip.tsx";
import { words } from "../../messages/index.ts";
import { Pair, TextField } from "./Pieces.tsx";

/** Kinds of values as a person chooses them: whole number, yes or no, a number, or one in a unit. */
const TYPES = ["int", "bool", "num", ...UNITS] as const;
const typeNamed = (name: string): ValueType => {
  const unit: Unit | undefined = UNITS.find(each => each === name);
  if (unit !== undefined) return { type: "num", unit };
  return name === "bool" ? { type: "bool" } : name === "num" ? { type: "num" } : { type: "int" };
};
const nameOfType = (type: ValueType): string => (type.type === "num" ? (type.unit ?? "num") : type.type);
const typeWords = (name: string): string =>
  name === "int" || name === "bool" || name === "num" ? words.step.valueKinds[name] : name;

/** The name of a routine and what it is given. */
export function RoutineInspector({ program, name }: { readonly program: Program; readonly name: string }) {
  const [naming, setNaming] = useState(false);
  const own = Object.entries(program.parameters?.[name] ?? {});
  const calls = Array.from(everyStep(program)).filter(step => step.type === "call" && step.routine === name).length;
  const taken = { ...program.signals, ...program.variables, ...program.parameters?.[name] };
  return (
    <section aria-label={words.step.routine(name)}>
      <h2 className="heading">
        <span className="grow">{words.step.routine(name)}</span>
        <span className="tag">{words.editor.called(calls)}</span>
      </h2>
      <div className="section stack">
        <p className="small dim">{words.editor.routineSays}</p>
        <Pair label={words.step.name}>
          <span className="stack">
            <TextField
              key={name}
              label={words.step.name}
              value={name}
              most={40}
              fault={typed => {
                const plain = typed.trim();
                return plain === "" || (plain !== name && Object.hasOwn(program.routines, plain))
                  ? words.editor.nameTaken
                  : undefined;
              }}
              onTake={wanted => nameRoutine(name, wanted)}
            />
          </span>
        </Pair>
        <h3 className="label">{words.editor.parameters}</h3>
        {own.length === 0 && <p className="small dim">{words.editor.noParameters}</p>}
        {own.map(([parameter, type]) => {
          const isRead = readsVariable(program.routines[name] ?? [], parameter);
          return (
            <div className="parameter-row" key={parameter}>
              <span className="num">{parameter}</span>
              <span className="field">
                <select
                  aria-label={`${words.step.kindOfValue}: ${parameter}`}
                  disabled={isRead}
                  value={nameOfType(type)}
                  onChange={event => setParameter(name, parameter, typeNamed(event.currentTarget.value))}
                >
                  {TYPES.map(each => (
                    <option key={each} value={each}>
                      {typeWords(each)}
                    </option>
                  ))}
                </select>
              </span>
              <Tip words={isRead ? words.editor.parameterRead : words.editor.removeParameter(parameter)}>
                <button
                  className="btn quiet icon tight"
                  aria-label={words.editor.removeParameter(parameter)}
                  aria-disabled={isRead}
                  onClick={() => deleteParameter(name, parameter)}
                >
                  <Trash2 />
                </button>
              </Tip>
            </div>
          );
        })}
        {naming ? (
          <TextField
            label={words.editor.newParameterName}
            value=""
            most={24}
            autoFocus
            fault={typed => {
              const why = typed === "" ? undefined : variableNameFault(typed, taken);
              return why === undefined ? undefined : words.step.variableNames[why];
            }}
            onTake={parameter => {
              setNaming(false);
              setParameter(name, parameter, { type: "int" });
            }}
          />
        ) : (
          <button className="btn" onClick={() => setNaming(true)}>
            {words.editor.newParameter}
          </button>
        )}
        <Tip words={calls > 0 ? words.editor.calledStays : words.common.remove}>
          <button className="btn danger" aria-disabled={calls > 0} onClick={() => deleteRoutine(name)}>
            {words.common.remove}
          </button>
        </Tip>
      </div>
    </section>
  );
}
