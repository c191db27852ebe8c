import { useEffect, useState } from "react";
import { useStore } from "zustand";
import {
  bindButton,
  bindForTarget,
  bindingStore,
  bindKey,
  bindStick,
  PRESSED_ACTIONS,
  PAD_ACTIONS,
  resetBindings,
  STICK_ACTIONS,
  type HeldAction,
  type PadAction,
  type StickAction,
} from "../../stores/bindings.ts";
import { closeDialog, dialogStore } from "../../stores/dialogs.ts";
import { gamepadStore } from "../../stores/gamepad.ts";
import { Chooser } from "../../ui/Choice.tsx";
import { Frame } from "../../ui/Frame.tsx";
import { words } from "../../messages/index.ts";
import { DOWN } from "./gamepad.ts";
import "./controls.css";

type Waiting =
  | { readonly kind: "key"; readonly action: HeldAction }
  | { readonly kind: "button"; readonly action: PadAction };

/** Which key and which button does what; click an entry, press the new one. Shows the pad live. */
export function ControlsDialog() {
  const open = useStore(dialogStore, state => state.open === "controls");
  return (
    <Frame
      open={open}
      title={words.pad.title}
      onClose={closeDialog}
      width={900}
      foot={
        <>
          <button className="btn" onClick={resetBindings}>
            {words.pad.reset}
          </button>
          <button className="btn" onClick={bindForTarget}>
            {words.pad.target}
          </button>
          <span className="small dim">{words.pad.while}</span>
        </>
      }
    >
      {open && <Tables />}
    </Frame>
  );
}

function Tables() {
  const { keyboard, buttons, axes } = useStore(bindingStore);
  const pad = useStore(gamepadStore, state => state.pad);
  const [waiting, setWaiting] = useState<Waiting | null>(null);
  useEffect(() => {
    if (waiting?.kind !== "key") return undefined;
    const listen = (event: KeyboardEvent): void => {
      event.preventDefault();
      event.stopPropagation();
      if (event.key !== "Escape") bindKey(event.code, waiting.action);
      setWaiting(null);
    };
    window.addEventListener("keydown", listen, true);
    return () => window.removeEventListener("keydown", listen, true);
  }, [waiting]);
  const pressedButton = pad?.buttons.findIndex(value => value >= DOWN) ?? -1;
  useEffect(() => {
    if (waiting?.kind !== "button" || pressedButton < 0) return;
    bindButton(pressedButton, waiting.action);
    setWaiting(null);
  }, [waiting, pressedButton]);
  const keyOf = (action: HeldAction): string =>
    Object.entries(keyboard)
      .find(([, bound]) => bound === action)?.[0]
      .replace(/^Key|^Digit/, "") ?? words.pad.unbound;
  const buttonOf = (action: PadAction): string | undefined =>
    Object.entries(buttons).find(([, bound]) => bound === action)?.[0];
  return (
    <div className="controls">
      <section>
        <h3 className="heading">{words.pad.keyboard}</h3>
        {PRESSED_ACTIONS.map(action => (
          <div className="control-line" key={action}>
            <span>{words.pad.actions[action]}</span>
            <button
              className="btn tight"
              aria-pressed={waiting?.kind === "key" && waiting.action === action}
              onClick={() => setWaiting({ kind: "key", action })}
            >
              <span className="visually-hidden">{words.pad.rebind(words.pad.actions[action])}: </span>
              {waiting?.kind === "key" && waiting.action === action ? (
                words.pad.press
              ) : (
                <span className="kbd">{keyOf(action)}</span>
              )}
            </button>
          </div>
        ))}
      </section>
      <section>
        <h3 className="heading">{words.pad.gamepad}</h3>
        <p className="small muted control-pad">{pad ? pad.id : words.pad.none}</p>
        {PAD_ACTIONS.map(action => {
          const button = buttonOf(action);
          const value = button === undefined ? 0 : (pad?.buttons[Number(button)] ?? 0);
          return (
            <div className="control-line" key={action} data-live={value >= DOWN}>
              <span>{words.pad.actions[action]}</span>
              <span className="control-level" aria-hidden>
                <i style={{ width: `${value * 100}%` }} />
              </span>
              <button
                className="btn tight"
                aria-pressed={waiting?.kind === "button" && waiting.action === action}
                onClick={() => setWaiting({ kind: "button", action })}
              >
                <span className="visually-hidden">{words.pad.rebind(words.pad.actions[action])}: </span>
                {waiting?.kind === "button" && waiting.action === action
                  ? words.pad.pressButton
                  : button === undefined
                    ? words.pad.unbound
                    : words.pad.button(Number(button))}
              </button>
            </div>
          );
        })}
        {["0", "1", "2", "3"].map(axis => (
          <div className="control-line" key={axis}>
            <span>{words.pad.stick(Number(axis))}</span>
            <span className="control-level" data-centre aria-hidden>
              <i
                style={{
                  left: `${50 + 50 * Math.min(0, pad?.axes[Number(axis)] ?? 0)}%`,
                  width: `${50 * Math.abs(pad?.axes[Number(axis)] ?? 0)}%`,
                }}
              />
            </span>
            <Chooser<StickAction | "none">
              label={words.pad.rebind(words.pad.stick(Number(axis)))}
              value={axes[axis] ?? "none"}
              onChange={action => {
                if (action !== "none") bindStick(Number(axis), action);
              }}
              options={[
                ...(axes[axis] ? [] : [{ value: "none" as const, words: words.pad.unbound }]),
                ...STICK_ACTIONS.map(value => ({ value, words: words.pad.sticks[value] })),
              ]}
            />
          </div>
        ))}
      </section>
    </div>
  );
}
