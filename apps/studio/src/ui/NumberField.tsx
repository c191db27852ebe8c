import { useId, useRef, useState, type PointerEvent } from "react";
import { words } from "../messages/index.ts";
import { parseTyped, shownFactor, shownUnit, showNumber, type Quantity } from "./expression.ts";

interface Props {
  readonly label: string;
  /** A short label drawn in the field; dragging it changes the number. */
  readonly mark?: string;
  readonly quantity: Quantity;
  /** Metres, radians, seconds, metres a second, or a ratio. */
  readonly value: number;
  readonly min?: number;
  readonly max?: number;
  readonly decimals?: number;
  readonly disabled?: boolean;
  /** The unit is drawn elsewhere, as in the heading of a column; it still belongs to the name that is read aloud. */
  readonly unitAbove?: boolean;
  /** `done` is false while dragging. */
  readonly onChange: (value: number, done: boolean) => void;
}

/** A number that can be typed with units and arithmetic, stepped with ↑ ↓, and dragged by its label. */
export function NumberField({
  label,
  mark,
  quantity,
  value,
  min = -Infinity,
  max = Infinity,
  decimals,
  disabled = false,
  unitAbove = false,
  onChange,
}: Props) {
  const [typed, setTyped] = useState<string | null>(null);
  const [fault, setFault] = useState<string | null>(null);
  const drag = useRef<{ readonly x: number; readonly from: number; moved: boolean } | null>(null);
  const id = useId();
  const unit = shownUnit(quantity);
  const step = shownFactor(quantity);
  const shown = showNumber(value, quantity, decimals);

  const within = (wanted: number): number | null => {
    if (wanted >= min && wanted <= max) {
      setFault(null);
      return wanted;
    }
    const limit = wanted < min ? min : max;
    setFault(
      wanted < min
        ? words.field.atLeast(label, showNumber(limit, quantity, decimals), unit)
        : words.field.atMost(label, showNumber(limit, quantity, decimals), unit),
    );
    return null;
  };
  const take = (): void => {
    if (typed === null) return;
    if (typed === shown) {
      setTyped(null);
      setFault(null);
      return;
    }
    const answer = parseTyped(typed, quantity, value);
    if (answer.kind === "not-understood") {
      setFault(words.field.notUnderstood(typed, unit === "" ? "25" : `25 ${unit}`));
      return;
    }
    const wanted = within(answer.value);
    if (wanted === null) return;
    setTyped(null);
    onChange(wanted, true);
  };
  const nudge = (by: number): void => {
    const wanted = within(value + by * step);
    if (wanted !== null) {
      setTyped(null);
      onChange(wanted, true);
    }
  };
  const scrub = (event: PointerEvent<HTMLElement>): void => {
    if (!drag.current) return;
    const by = Math.round((event.clientX - drag.current.x) / 2) * (event.shiftKey ? 0.1 : 1);
    if (by === 0 && !drag.current.moved) return;
    drag.current.moved = true;
    onChange(Math.min(max, Math.max(min, drag.current.from + by * step)), false);
  };

  return (
    <div>
      <div className="field" data-fault={fault !== null}>
        {mark !== undefined && (
          <span
            className="tag-x"
            aria-hidden
            onPointerDown={event => {
              if (!disabled) {
                event.currentTarget.setPointerCapture(event.pointerId);
                drag.current = { x: event.clientX, from: value, moved: false };
              }
            }}
            onPointerMove={scrub}
            onPointerUp={() => {
              if (drag.current?.moved) onChange(value, true);
              drag.current = null;
            }}
            onPointerCancel={() => {
              drag.current = null;
            }}
          >
            {mark}
          </span>
        )}
        <input
          aria-label={`${label}, ${unit}`}
          aria-invalid={fault !== null}
          aria-describedby={fault ? id : undefined}
          inputMode="text"
          autoComplete="off"
          spellCheck={false}
          disabled={disabled}
          value={typed ?? shown}
          onFocus={event => event.currentTarget.select()}
          onChange={event => {
            setTyped(event.currentTarget.value);
            setFault(null);
          }}
          onBlur={() => {
            take();
            if (fault) {
              setTyped(null);
              setFault(null);
            }
          }}
          onKeyDown={event => {
            if (event.key === "Enter") {
              take();
              event.currentTarget.select();
            }
            if (event.key === "Escape") {
              event.stopPropagation();
              setTyped(null);
              setFault(null);
              event.currentTarget.blur();
            }
            if (event.key === "ArrowUp" || event.key === "ArrowDown") {
              event.preventDefault();
              nudge((event.key === "ArrowUp" ? 1 : -1) * (event.shiftKey ? 10 : 1));
            }
          }}
        />
        {unit && !unitAbove && (
          <span className="unit" aria-hidden>
            {unit}
          </span>
        )}
      </div>
      {fault && (
        <div className="field-fault" id={id} role="alert">
          {fault}
        </div>
      )}
    </div>
  );
}
