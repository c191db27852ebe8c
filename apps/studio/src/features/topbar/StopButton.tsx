import { useEffect } from "react";
import { runCommand } from "../../stores/commands.ts";
import { words } from "../../words/index.ts";

/** Two presses of Esc within this time stop everything. */
const TWICE_MS = 600;

/** Always at the same place, above every dialog, and on the Pause key or Esc twice. Acts on press, not on release. */
export function StopButton() {
  useEffect(() => {
    let last_ms = -Infinity;
    const listen = (event: KeyboardEvent): void => {
      if (event.repeat) return;
      if (event.key === "Pause") {
        event.preventDefault();
        runCommand("stop");
      }
      if (event.key !== "Escape") return;
      if (event.timeStamp - last_ms < TWICE_MS) {
        runCommand("stop");
        last_ms = -Infinity;
      } else last_ms = event.timeStamp;
    };
    window.addEventListener("keydown", listen, true);
    return () => window.removeEventListener("keydown", listen, true);
  }, []);
  return (
    <button
      className="stop"
      title={words.top.stopTip}
      onPointerDown={event => {
        if (event.button === 0) runCommand("stop");
      }}
      onKeyDown={event => {
        if ((event.key === "Enter" || event.key === " ") && !event.repeat) {
          event.preventDefault();
          runCommand("stop");
        }
      }}
      onClick={event => {
        if (event.detail === 0) runCommand("stop");
      }}
    >
      {words.top.stop}
    </button>
  );
}
