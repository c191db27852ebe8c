import { useEffect } from "react";
import { escapeRule } from "../../runtime/moving.ts";
import { runCommand } from "../../stores/commands.ts";
import { words } from "../../messages/index.ts";

/**
 * Always at the same place, above every dialog, and on the Pause key, or Esc while something moves. Acts on press, not
 * on release.
 */
export function StopButton() {
  useEffect(() => {
    const escape = escapeRule();
    const listen = (event: KeyboardEvent): void => {
      if (event.repeat) return;
      if (event.key === "Pause") {
        event.preventDefault();
        runCommand("stop");
      }
      if (event.key === "Escape" && escape(event.timeStamp) === "stop") runCommand("stop");
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
