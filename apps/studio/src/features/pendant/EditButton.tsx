import { PenLine } from "lucide-react";
import { useEffect, useRef } from "react";
import { useStore } from "zustand";
import { beginEdit, endEdit } from "../../runtime/jog/edit-point.ts";
import { editStore } from "../../stores/edit-point.ts";
import { viewStore } from "../../stores/view.ts";
import { isTyping } from "../../ui/keys.ts";
import { Tip } from "../../ui/Tip.tsx";
import { words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";

const KEY = "KeyX";
/** A press that is shorter is a tap: EDIT stays until the next one, for a hand that needs the pointer to drag [ms]. */
const TAP_MS = 350;

/** EDIT: held by key or finger, or tapped on and off. Leaving the page or the pendant lets go. */
export function EditButton() {
  const edited = useStore(editStore, state => state.edited);
  const pressed_ms = useRef(0);
  const stays = useRef(false);
  useEffect(() => {
    const down = (event: KeyboardEvent): void => {
      if (event.code !== KEY || event.repeat || event.ctrlKey || event.metaKey || event.altKey) return;
      if (isTyping(event.target) || viewStore.getState().mode !== "teach") return;
      beginEdit();
    };
    const up = (event: KeyboardEvent): void => {
      if (event.code === KEY) endEdit();
    };
    const hidden = (): void => {
      if (document.visibilityState === "hidden") endEdit();
    };
    window.addEventListener("keydown", down);
    window.addEventListener("keyup", up);
    window.addEventListener("blur", endEdit);
    document.addEventListener("visibilitychange", hidden);
    return () => {
      window.removeEventListener("keydown", down);
      window.removeEventListener("keyup", up);
      window.removeEventListener("blur", endEdit);
      document.removeEventListener("visibilitychange", hidden);
      endEdit();
    };
  }, []);
  const release = (now_ms: number): void => {
    if (stays.current) return;
    if (now_ms - pressed_ms.current < TAP_MS && editStore.getState().edited !== null) stays.current = true;
    else endEdit();
  };
  const says =
    edited === null
      ? words.edit.hint
      : edited.short_m > 0
        ? words.edit.short(edited.name, fixed(edited.short_m * 1000, 0))
        : words.edit.at(edited.name);
  return (
    <>
      <div className="point-row">
        <span className="point-label">{words.edit.label}</span>
        <Tip words={words.edit.tip} keys="X">
          <button
            className="btn"
            style={{ touchAction: "none" }}
            aria-pressed={edited !== null}
            onPointerDown={event => {
              if (event.button !== 0) return;
              if (editStore.getState().edited !== null) {
                stays.current = false;
                endEdit();
                return;
              }
              stays.current = false;
              pressed_ms.current = event.timeStamp;
              event.currentTarget.setPointerCapture(event.pointerId);
              beginEdit();
            }}
            onPointerUp={event => release(event.timeStamp)}
            onPointerCancel={() => {
              stays.current = false;
              endEdit();
            }}
            onContextMenu={event => event.preventDefault()}
            onKeyDown={event => {
              if (event.key !== "Enter" && event.key !== " ") return;
              event.preventDefault();
              if (event.repeat) return;
              if (editStore.getState().edited === null) beginEdit();
              else endEdit();
            }}
          >
            <PenLine />
            {words.edit.button}
          </button>
        </Tip>
      </div>
      <p className="small dim" role="status">
        {says}
      </p>
    </>
  );
}
