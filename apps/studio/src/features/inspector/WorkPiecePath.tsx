import { robotById } from "@twincell/core";
import type { ObjectRecord } from "@twincell/project";
import { useMemo } from "react";
import { useStore } from "zustand";
import { pathLength, pathText, workPiecePath } from "../../runtime/history/workpiece-path.ts";
import { cellStore } from "../../stores/cell.ts";
import { playStore } from "../../stores/play.ts";
import { download } from "../../ui/download.ts";
import { showNumber } from "../../ui/expression.ts";
import { words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";

/** How far the program carries a work piece; its path is drawn while it is selected, and saved as numbers (M-66). */
export function WorkPiecePath({ object }: { object: ObjectRecord }) {
  const robot = useStore(cellStore, state => state.document?.robot);
  const carried = useStore(playStore, state => state.carried);
  const plan = useStore(playStore, state => state.plan);
  const moments = useMemo(() => {
    const model = robot && robotById(robot.id);
    return robot && model && plan ? workPiecePath(carried, object.id, plan, model, robot.worldFromBase) : [];
  }, [carried, object.id, plan, robot]);
  const [first, last] = [moments[0], moments.at(-1)];
  if (!first || !last || moments.length < 2) return null;
  return (
    <>
      <div className="pair">
        <span className="label">{words.parts.path}</span>
        <span className="num">
          {words.parts.pathSays(showNumber(pathLength(moments), "length", 0), fixed(last.t_s - first.t_s, 2))}
        </span>
      </div>
      <button
        className="btn small"
        onClick={() => download(`${object.name}.path.csv`, new Blob([pathText(moments)], { type: "text/csv" }))}
      >
        {words.parts.savePath}
      </button>
    </>
  );
}
