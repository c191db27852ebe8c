import { reachOfConfiguration, workspaceScratch } from "../kinematics/workspace.ts";
import { reachRepairs } from "./repairs.ts";
import { motions, type CheckScene } from "./scene.ts";

/** Row X-08: the maker's declared reach, at every node of the plan, whether the target was a pose or joint angles. */
export function checkWorkspace(scene: CheckScene): void {
  const { workspace } = scene.robot;
  const n = scene.robot.arm.joints.length;
  if (workspace === undefined) return;
  const scratch = workspaceScratch(n);
  const q = new Float64Array(n);
  const limit = workspace.reach_m;
  for (const segment of motions(scene)) {
    let farthest_m = 0;
    let at = 0;
    for (let i = 0; i < segment.times_s.length; i++) {
      for (let j = 0; j < n; j++) q[j] = segment.q_rad[i * n + j]!;
      const distance_m = reachOfConfiguration(scene.robot, workspace, q, scratch);
      if (distance_m > farthest_m) {
        farthest_m = distance_m;
        at = i;
      }
    }
    if (farthest_m <= limit + 1e-9) continue;
    const move = scene.layout.moves.get(segment.step);
    scene.add(segment.step, "bad", {
      code: "reach.beyond-workspace",
      value: farthest_m,
      limit,
      unit: "m",
      at_s: segment.start_s + segment.times_s[at]!,
      sentence: `The wrist would be ${mm(farthest_m)} from axis 2; ${scene.robot.name} is declared to reach ${mm(limit)}.`,
      repairs: move === undefined ? [] : reachRepairs(scene, move),
    });
  }
}

const mm = (length_m: number): string => `${(length_m * 1000).toFixed(0)} mm`;
