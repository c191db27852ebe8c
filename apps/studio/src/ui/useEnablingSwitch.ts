import { useEffect, useEffectEvent, useRef, useState, type PointerEvent, type RefObject } from "react";
import { isTyping } from "./keys.ts";

/** What an enabling switch gives to the element that is pressed. */
export interface EnablingSwitch {
  readonly enabled: boolean;
  readonly press: {
    readonly onPointerDown: (event: PointerEvent<HTMLElement>) => void;
    readonly onPointerUp: () => void;
    readonly onPointerCancel: () => void;
    readonly onLostPointerCapture: () => void;
  };
}

/**
 * An enabling switch: pressed by pointer, or by Space while the focus is inside `area`, and only as long as it is held.
 * A cancelled touch, a lost focus of the page, a hidden tab and leaving the panel release it.
 */
export function useEnablingSwitch(
  area: RefObject<HTMLElement | null>,
  onChange: (enabled: boolean) => void,
): EnablingSwitch {
  const [enabled, setEnabled] = useState(false);
  const tell = useEffectEvent(onChange);
  // A press and its end may come before the next drawing.
  const held = useRef(false);
  const change = (next: boolean): void => {
    if (next === held.current) return;
    held.current = next;
    setEnabled(next);
    onChange(next);
  };
  // The window's listeners and the end of the panel see the latest state.
  const release = useEffectEvent(() => change(false));
  const key = useEffectEvent((event: KeyboardEvent) => {
    if (event.code !== "Space" || !area.current?.contains(document.activeElement) || isTyping(event.target)) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    change(event.type === "keydown");
  });
  useEffect(() => {
    const hidden = (): void => {
      if (document.visibilityState === "hidden") release();
    };
    const onKey = (event: KeyboardEvent): void => key(event);
    const letGo = (event: KeyboardEvent): void => {
      if (event.code === "Space") release();
    };
    const onBlur = (): void => release();
    window.addEventListener("keydown", onKey, true);
    window.addEventListener("keyup", onKey, true);
    document.addEventListener("keyup", letGo);
    window.addEventListener("blur", onBlur);
    document.addEventListener("visibilitychange", hidden);
    return () => {
      window.removeEventListener("keydown", onKey, true);
      window.removeEventListener("keyup", onKey, true);
      document.removeEventListener("keyup", letGo);
      window.removeEventListener("blur", onBlur);
      document.removeEventListener("visibilitychange", hidden);
    };
  }, []);
  useEffect(
    () => () => {
      if (held.current) tell(false);
    },
    [],
  );
  return {
    enabled,
    press: {
      onPointerDown(event) {
        if (event.button !== 0) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        change(true);
      },
      onPointerUp: () => change(false),
      onPointerCancel: () => change(false),
      onLostPointerCapture: () => change(false),
    },
  };
}
