import { useStore } from "zustand";
import { pastRobot } from "../../runtime/history/past-robot.ts";
import { historyStore } from "../../stores/history.ts";
import { viewStore } from "../../stores/view.ts";
import { ArmView } from "./arm-view.tsx";

/** The robot of a recording where it stood then, when it is another than that of the cell. */
export function PastView() {
  const stand = useStore(historyStore, state => state.past);
  const shown = useStore(viewStore, state => state.mode === "history");
  const past = pastRobot();
  return shown && stand && past ? (
    <ArmView
      key={past.robot.id}
      robot={past.robot}
      worldFromBase={stand}
      live={() => pastRobot() ?? past}
      prefix="past/"
    />
  ) : null;
}
