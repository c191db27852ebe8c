import { flow, type Pose, type Program, type Robot, robotById } from "@twincell/core";
import { selectedProgram, type CellDocument } from "@twincell/project";
import { useLayoutEffect, useMemo, useRef } from "react";
import { type InstancedMesh, Matrix4 } from "three";
import { worldFromTarget } from "../../runtime/planning/target-pose.ts";
import { poseMatrix } from "../pose-matrix.ts";
import { triadGeometry } from "../triad-geometry.ts";

/** More frames than this would hide each other: then only the points are drawn. */
const MOST_FRAMES = 600;

/** Points drawn at most. */
const MAX_POINTS = 20_000;

/** Where the taught points of the program are, in the world. */
export function waypointPoses(document: CellDocument, program: Program, robot: Robot): Pose<"world", "tcp">[] {
  // Every place of a pallet is a point; rounds of a loop are not told apart.
  const points = Array.from(flow(program, { rounds: 1, mostSteps: 0 })).flatMap(happening =>
    happening.kind === "step" ? [happening.step] : [],
  );
  return points.slice(0, MAX_POINTS).flatMap(step => {
    if (step.type !== "move") return [];
    const worldFromTcp = worldFromTarget(document, program, robot, step.target);
    return worldFromTcp ? [worldFromTcp] : [];
  });
}

/** Taught points: a small frame with a white dot each, in two draw calls. */
export function Waypoints({ document }: { readonly document: CellDocument }) {
  const program = selectedProgram(document);
  const robot = robotById(document.robot.id);
  const poses = useMemo(
    () => (program && robot ? waypointPoses(document, program, robot) : []),
    [document, program, robot],
  );
  const triad = useMemo(() => triadGeometry(0.026, 0.0011), []);
  const dots = useRef<InstancedMesh>(null);
  const frames = useRef<InstancedMesh>(null);
  useLayoutEffect(() => {
    const matrix = new Matrix4();
    poses.forEach((pose, i) => {
      poseMatrix(pose, matrix);
      dots.current?.setMatrixAt(i, matrix);
      if (i < MOST_FRAMES) frames.current?.setMatrixAt(i, matrix);
    });
    for (const mesh of [dots.current, frames.current])
      if (mesh) {
        mesh.instanceMatrix.needsUpdate = true;
        mesh.computeBoundingSphere();
      }
  }, [poses]);
  if (poses.length === 0) return null;
  return (
    <>
      <instancedMesh
        key={`dots ${poses.length}`}
        ref={dots}
        args={[undefined, undefined, poses.length]}
        userData={{ unpickable: true }}
      >
        <sphereGeometry args={[0.0062, 14, 10]} />
        <meshBasicMaterial color="#ffffff" toneMapped={false} />
      </instancedMesh>
      {poses.length <= MOST_FRAMES && (
        <instancedMesh
          key={`frames ${poses.length}`}
          ref={frames}
          args={[triad, undefined, poses.length]}
          userData={{ unpickable: true }}
        >
          <meshBasicMaterial vertexColors toneMapped={false} />
        </instancedMesh>
      )}
    </>
  );
}
