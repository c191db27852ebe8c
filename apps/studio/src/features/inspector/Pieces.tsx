import { useState } from "react";
import { words } from "../../messages/index.ts";

/** A label and its field in one row. */
export const Pair = ({ label, children }: { readonly label: string; readonly children: React.ReactNode }) => (
  <div className="pair">
    <span className="label">{label}</span>
    {children}
  </div>
);

/** One of several names; `shown` says what a person reads for each. */
export function NameChoice({
  label,
  value,
  names,
  shown = name => name,
  more,
  onChange,
}: {
  readonly label: string;
  readonly value: string;
  readonly names: readonly string[];
  readonly shown?: (name: string) => string;
  /** A last entry that is none of the names, chosen as "". */
  readonly more?: string;
  readonly onChange: (name: string) => void;
}) {
  return (
    <Pair label={label}>
      <span className="field">
        <select aria-label={label} value={value} onChange={event => onChange(event.currentTarget.value)}>
          {[...new Set(names.includes(value) ? names : [value, ...names])].map(name => (
            <option key={name} value={name}>
              {shown(name)}
            </option>
          ))}
          {more !== undefined && <option value="">{more}</option>}
        </select>
      </span>
    </Pair>
  );
}

/** A whole number from 1; anything else is refused in a sentence and changes nothing. */
export function WholeField({
  label,
  value,
  most,
  least = 1,
  onChange,
}: {
  readonly label: string;
  readonly value: number;
  readonly most: number;
  readonly least?: number;
  readonly onChange: (value: number) => void;
}) {
  const [typed, setTyped] = useState<string | null>(null);
  const number = Number(typed ?? value);
  const isWrong = !Number.isInteger(number) || number < least || number > most || typed === "";
  const take = (): void => {
    if (typed !== null && !isWrong && number !== value) onChange(number);
    if (!isWrong) setTyped(null);
  };
  return (
    <>
      <Pair label={label}>
        <span className="field" data-fault={isWrong}>
          <input
            inputMode="numeric"
            aria-label={label}
            aria-invalid={isWrong}
            value={typed ?? String(value)}
            onChange={event => setTyped(event.currentTarget.value)}
            onBlur={take}
            onKeyDown={event => {
              if (event.key === "Enter") take();
              if (event.key === "Escape") setTyped(null);
            }}
          />
        </span>
      </Pair>
      {isWrong && (
        <p className="field-fault" role="alert">
          {words.editor.wholeNumber(label, most)}
        </p>
      )}
    </>
  );
}

/** A line of text, taken when it is left or Enter is pressed. */
export function TextField({
  label,
  value,
  most,
  fault,
  autoFocus = false,
  onTake,
}: {
  readonly label: string;
  readonly value: string;
  readonly most: number;
  /** Why a text cannot be taken; undefined when it can. */
  readonly fault?: (typed: string) => string | undefined;
  readonly autoFocus?: boolean;
  readonly onTake: (typed: string) => void;
}) {
  const [typed, setTyped] = useState<string | null>(null);
  const wrong = typed === null ? undefined : fault?.(typed);
  const take = (): void => {
    if (wrong === undefined && typed !== null && typed !== value) onTake(typed);
    if (wrong === undefined) setTyped(null);
  };
  return (
    <>
      <span className="field text">
        <input
          autoFocus={autoFocus}
          aria-label={label}
          aria-invalid={wrong !== undefined}
          value={typed ?? value}
          maxLength={most}
          spellCheck={false}
          onChange={event => setTyped(event.currentTarget.value)}
          onBlur={take}
          onKeyDown={event => {
            if (event.key === "Enter") take();
            if (event.key === "Escape") setTyped(null);
          }}
        />
      </span>
      {wrong !== undefined && (
        <p className="field-fault" role="alert">
          {wrong}
        </p>
      )}
    </>
  );
}
