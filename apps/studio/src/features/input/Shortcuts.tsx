import { useEffect } from "react";
import { hold, release, releaseAll } from "../../runtime/jog/pressed-inputs.ts";
import { axisOf, bindingStore } from "../../stores/bindings.ts";
import { commandStore, runCommand } from "../../stores/commands.ts";
import { dialogStore } from "../../stores/dialogs.ts";
import { viewStore } from "../../stores/view.ts";
import { isKeys, isTyping } from "../../ui/keys.ts";

/**
 * Keys of the page: commands by their combination, and held keys that jog. Losing focus or hiding the tab releases all.
 */
export function Shortcuts() {
  useEffect(() => {
    const down = (event: KeyboardEvent): void => {
      if (event.defaultPrevented || isTyping(event.target)) return;
      const inDialog = dialogStore.getState().open !== null;
      if (
        !event.ctrlKey &&
        !event.metaKey &&
        !event.altKey &&
        !event.shiftKey &&
        !inDialog &&
        viewStore.getState().mode === "teach"
      ) {
        const action = bindingStore.getState().keyboard[event.code];
        if (action) {
          event.preventDefault();
          const { axis, sign } = axisOf(action);
          if (!event.repeat) hold("keyboard", axis, sign);
          return;
        }
      }
      const onControl =
        event.target instanceof HTMLElement &&
        event.target.closest("button, a, [role='slider'], [role='menu'], [role='listbox'], summary") !== null;
      const meant = Array.from(commandStore.getState().commands.values(), command => ({
        command,
        keys: command.keys?.find(keys => isKeys(event, keys) && (!event.repeat || keys.includes("Mod"))),
      })).filter(({ keys }) => keys !== undefined);
      // The same key does one thing in one mode and another elsewhere: what can be done now is what is meant.
      const { command, keys } = meant.find(each => each.command.can?.() !== false) ?? meant[0] ?? {};
      if (command === undefined || keys === undefined) return;
      if (inDialog && !keys.includes("Mod")) return;
      if (onControl && (keys === "Space" || keys.startsWith("Arrow"))) return;
      event.preventDefault();
      runCommand(command.id);
    };
    const up = (event: KeyboardEvent): void => {
      const action = bindingStore.getState().keyboard[event.code];
      if (action) release("keyboard", axisOf(action).axis);
    };
    const hidden = (): void => {
      if (document.visibilityState === "hidden") releaseAll();
    };
    window.addEventListener("keydown", down);
    window.addEventListener("keyup", up);
    window.addEventListener("blur", releaseAll);
    window.addEventListener("pointercancel", releaseAll);
    document.addEventListener("visibilitychange", hidden);
    return () => {
      window.removeEventListener("keydown", down);
      window.removeEventListener("keyup", up);
      window.removeEventListener("blur", releaseAll);
      window.removeEventListener("pointercancel", releaseAll);
      document.removeEventListener("visibilitychange", hidden);
    };
  }, []);
  return null;
}
