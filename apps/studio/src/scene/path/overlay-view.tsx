import { useMemo } from "react";
import { useStore } from "zustand";
import { BufferGeometry, Float32BufferAttribute, Line, LineBasicMaterial } from "three";
import { historyStore } from "../../stores/history.ts";
import { viewStore } from "../../stores/view.ts";
import type { SceneTheme } from "../theme.ts";

/** Two cycles of a recording, one over the other: the first in the colour of runs, the second in that of warnings. */
export function OverlayView({ theme }: { readonly theme: SceneTheme }) {
  const ways = useStore(historyStore, state => state.overlay?.ways);
  const shown = useStore(viewStore, state => state.mode === "history");
  const lines = useMemo(
    () =>
      (ways ?? []).map((way, i) => {
        const geometry = new BufferGeometry().setAttribute("position", new Float32BufferAttribute(way.flat(), 3));
        const line = new Line(
          geometry,
          new LineBasicMaterial({ color: i === 0 ? theme.run : theme.near, toneMapped: false, depthTest: false }),
        );
        line.renderOrder = 5 + i;
        line.userData.unpickable = true;
        line.raycast = () => undefined;
        return line;
      }),
    [ways, theme],
  );
  return shown ? (
    <>
      {lines.map((line, i) => (
        <primitive key={i} object={line} />
      ))}
    </>
  ) : null;
}
