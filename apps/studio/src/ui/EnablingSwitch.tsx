import { Hand } from "lucide-react";
import { words } from "../messages/index.ts";
import type { EnablingSwitch as Switch } from "./useEnablingSwitch.ts";
import "./enabling-switch.css";

/** The enabling switch of a panel: outlined when released, filled while held. */
export function EnablingSwitch({ of: { enabled, press }, disabled }: { of: Switch; disabled: boolean }) {
  return (
    <button
      type="button"
      className="enabling-switch"
      aria-label={words.direct.hold}
      aria-pressed={enabled}
      disabled={disabled}
      style={{ touchAction: "none" }}
      onContextMenu={event => event.preventDefault()}
      {...press}
    >
      <Hand />
      <b>{enabled ? words.direct.enabled : words.direct.hold}</b>
      <span className="small">{enabled ? words.direct.letGo : words.direct.holdHint}</span>
    </button>
  );
}
