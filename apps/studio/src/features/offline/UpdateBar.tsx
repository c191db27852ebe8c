import { useState } from "react";
import { useStore } from "zustand";
import { connectionStore } from "../../stores/connection.ts";
import { controlStore } from "../../stores/control.ts";
import { offlineStore } from "../../stores/offline.ts";
import { viewStore } from "../../stores/view.ts";
import { words } from "../../messages/index.ts";
import "./update-bar.css";

/** A newer version waits: taken when the person says so, and never while a robot is connected or runs. */
export function UpdateBar() {
  const update = useStore(offlineStore, state => state.update);
  const connected = useStore(connectionStore, state => state.station !== null);
  const running = useStore(controlStore, state => state.running);
  const inHeadset = useStore(viewStore, state => state.inHeadset);
  const [later, setLater] = useState<unknown>(null);
  if (update === null || later === update || connected || running || inHeadset) return null;
  return (
    <div className="update-bar" role="status">
      <p>{words.offline.ready}</p>
      <button className="btn primary" onClick={update}>
        {words.offline.take}
      </button>
      <button className="btn quiet" onClick={() => setLater(() => update)}>
        {words.offline.later}
      </button>
    </div>
  );
}
