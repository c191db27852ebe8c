import type { CellDocument } from "@twincell/project";
import { robotById } from "@twincell/core";
import { useEffect, useMemo } from "react";
import { useThree } from "@react-three/fiber";
import { BufferGeometry, Float32BufferAttribute, Line, LineBasicMaterial, Points, PointsMaterial } from "three";
import { useStore } from "zustand";
import { workPiecePath } from "../../runtime/history/workpiece-path.ts";
import { playStore } from "../../stores/play.ts";
import { selectionStore } from "../../stores/selection.ts";
import type { SceneTheme } from "../theme.ts";

/** The complete path of the work piece that is selected, with a dot where it begins and where it ends (row M-66). */
export function WorkPieceView({ document, theme }: { readonly document: CellDocument; readonly theme: SceneTheme }) {
  const id = useStore(selectionStore, ({ selected }) => (selected?.kind === "object" ? selected.id : null));
  const carried = useStore(playStore, state => state.carried);
  const plan = useStore(playStore, state => state.plan);
  const invalidate = useThree(state => state.invalidate);
  const { robot } = document;
  const moments = useMemo(() => {
    const model = robotById(robot.id);
    return id !== null && plan && model ? workPiecePath(carried, id, plan, model, robot.worldFromBase) : [];
  }, [id, carried, plan, robot]);
  const drawn = useMemo(() => {
    const of = (places: readonly number[]): BufferGeometry =>
      new BufferGeometry().setAttribute("position", new Float32BufferAttribute(places, 3));
    const ends = [moments[0], moments.at(-1)].flatMap(moment => moment?.at_m ?? []);
    const line = new Line(
      of(moments.flatMap(({ at_m }) => at_m)),
      new LineBasicMaterial({ color: theme.text, toneMapped: false, depthTest: false, transparent: true }),
    );
    const dots = new Points(
      of(ends),
      new PointsMaterial({ color: theme.text, size: 8, sizeAttenuation: false, depthTest: false, transparent: true }),
    );
    line.name = "work piece path";
    for (const each of [line, dots]) {
      each.renderOrder = 6;
      each.userData.unpickable = true;
      each.raycast = () => undefined;
    }
    return [line, dots] as const;
  }, [moments, theme]);
  useEffect(() => {
    invalidate();
    return () => {
      for (const { geometry, material } of drawn) {
        geometry.dispose();
        material.dispose();
      }
    };
  }, [drawn, invalidate]);
  if (moments.length < 2) return null;
  return drawn.map(each => <primitive key={each.uuid} object={each} />);
}
