import type { Program, SignalLine } from "@twincell/core";
import { useStore } from "zustand";
import { controlStore } from "../../stores/control.ts";
import { setInput } from "../../stores/inputs.ts";
import { NumberField } from "../../ui/NumberField.tsx";
import { words } from "../../messages/index.ts";

/** The lines of a program: inputs can be switched by hand, outputs show what the controller says. */
export function SignalList({ signals }: { readonly signals: Program["signals"] }) {
  const now = useStore(controlStore, state => state.signals);
  const lines = Object.entries(signals);
  if (lines.length === 0) return null;
  return (
    <fieldset className="signals">
      <legend className="small dim">{words.run.signals}</legend>
      {lines.map(([name, line]) => (
        <Line
          key={name}
          name={name}
          line={line}
          value={now.get(name) ?? (line.kind.startsWith("analogue") ? 0 : false)}
        />
      ))}
    </fieldset>
  );
}

function Line({
  name,
  line,
  value,
}: {
  readonly name: string;
  readonly line: SignalLine;
  readonly value: boolean | number;
}) {
  const label = (
    <span className="grow">
      {name}
      <span className="dim small">
        {" "}
        {words.run.kinds[line.kind]}
        {line.address === undefined ? "" : ` ${line.address}`}
      </span>
    </span>
  );
  switch (line.kind) {
    case "digital-in":
      return (
        <div className="signal">
          {label}
          <button
            className="btn tight"
            role="switch"
            aria-checked={value !== false && value !== 0}
            aria-label={words.run.input(name)}
            onClick={() => setInput(name, value === false || value === 0)}
          >
            {value !== false && value !== 0 ? words.common.on : words.common.off}
          </button>
        </div>
      );
    case "analogue-in":
      return (
        <div className="signal">
          {label}
          <NumberField
            label={words.run.input(name)}
            quantity="plain"
            value={Number(value)}
            onChange={next => setInput(name, next)}
          />
        </div>
      );
    case "digital-out":
      return (
        <div className="signal">
          {label}
          <span className="signal-lamp" data-on={value !== false && value !== 0}>
            {value !== false && value !== 0 ? words.common.on : words.common.off}
          </span>
        </div>
      );
    case "analogue-out":
      return (
        <div className="signal">
          {label}
          <span className="num">{Number(value)}</span>
        </div>
      );
  }
}
