import { useFrame } from "@react-three/fiber";
import { useMemo } from "react";
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Line, LineBasicMaterial } from "three";
import { theLive } from "../../runtime/live.ts";
import type { SceneTheme } from "../theme.ts";

const KEPT = 3000;
const LEAST_STEP_M = 0.0015;
/** A farther step is not a motion but a jump: the line begins anew. */
const JUMP_M = 0.12;

/** The way the TCP really took, as a thin line; the oldest points go first. */
export function TcpTrace({ theme }: { readonly theme: SceneTheme }) {
  const trace = useMemo(() => {
    const geometry = new BufferGeometry();
    const position = new BufferAttribute(new Float32Array(3 * KEPT), 3).setUsage(DynamicDrawUsage);
    geometry.setAttribute("position", position);
    geometry.setDrawRange(0, 0);
    const line = new Line(geometry, new LineBasicMaterial({ transparent: true, opacity: 0.7, toneMapped: false }));
    line.frustumCulled = false;
    line.userData.unpickable = true;
    line.raycast = () => undefined;
    return { line, geometry, position, count: 0, revision: -1 };
  }, []);
  useMemo(() => {
    trace.line.material.color = theme.accent;
  }, [trace, theme]);

  useFrame(() => {
    const {
      worldFromTcp: { position: at },
      revision,
    } = theLive();
    if (revision === trace.revision) return;
    trace.revision = revision;
    const values = trace.position.array;
    const last = 3 * (trace.count - 1);
    if (trace.count > 0) {
      const step = Math.hypot(at[0] - values[last]!, at[1] - values[last + 1]!, at[2] - values[last + 2]!);
      if (step < LEAST_STEP_M) return;
      if (step > JUMP_M) trace.count = 0;
    }
    if (trace.count === KEPT) {
      values.copyWithin(0, 3 * (KEPT / 2));
      trace.count = KEPT / 2;
    }
    values[3 * trace.count] = at[0];
    values[3 * trace.count + 1] = at[1];
    values[3 * trace.count + 2] = at[2];
    trace.count++;
    trace.position.needsUpdate = true;
    trace.geometry.setDrawRange(0, trace.count);
  }, -8);
  return <primitive object={trace.line} />;
}
