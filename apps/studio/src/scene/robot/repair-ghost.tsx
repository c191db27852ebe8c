import { compose, flangePose, identity, armScratch, shiftedPose, type Robot, type Vector3 } from "@twincell/core";
import { objectsOfFrame, type CellDocument, type ObjectRecord, type ToolRecord } from "@twincell/project";
import { useEffect, useMemo } from "react";
import { Matrix4, type MeshStandardMaterial } from "three";
import { useStore } from "zustand";
import { repairStore, type ShownRepair } from "../../stores/repairs.ts";
import { shapeGeometry } from "../objects/shape-geometry.ts";
import { poseMatrix } from "../pose-matrix.ts";
import { ArmView } from "./arm-view.tsx";
import { ghostMaterial } from "./materials.ts";

/** In the colours of the numbers on the card. */
const COLOURS = ["#6ea8fe", "#57c785", "#3fb8b3"] as const;

interface Props {
  readonly document: CellDocument;
  readonly robot: Robot;
  readonly tool: ToolRecord | undefined;
}

/** A way out that is being looked at: the robot at the end of the step, and what would be moved, see-through. */
export function RepairGhost(props: Props) {
  const shown = useStore(repairStore, state => state.shown);
  return shown && <Ghost key={`${shown.step} ${shown.index}`} {...props} shown={shown} />;
}

function Ghost({ document, robot, tool, shown }: Props & { readonly shown: ShownRepair }) {
  const { moveBase, moveFrame, reaches } = shown.repair;
  const colour = COLOURS[shown.index] ?? COLOURS[0];
  const material = useMemo(() => ghostMaterial(colour), [colour]);
  useEffect(() => () => material.dispose(), [material]);
  const { worldFromBase: stood } = document.robot;
  const worldFromBase = moveBase === undefined ? stood : shiftedPose(stood, moveBase.by_m);
  const moved = moveFrame === undefined ? [] : objectsOfFrame(document, moveFrame.frame);
  const { q_rad } = reaches;
  const stand = useMemo(() => ({ q_rad: q_rad ?? [], revision: 1 }), [q_rad]);
  return (
    <>
      {q_rad && (
        <ArmView robot={robot} worldFromBase={worldFromBase} live={() => stand} prefix="repair/" ghost={colour} />
      )}
      {q_rad && tool?.shape && (
        <GhostTool robot={robot} q_rad={q_rad} tool={tool} worldFromBase={worldFromBase} material={material} />
      )}
      {moveFrame &&
        document.objects
          .filter(({ id }) => moved.includes(id))
          .map(object => <GhostObject key={object.id} object={object} by_m={moveFrame.by_m} material={material} />)}
    </>
  );
}

interface ToolProps {
  readonly robot: Robot;
  readonly q_rad: readonly number[];
  readonly tool: ToolRecord;
  readonly worldFromBase: CellDocument["robot"]["worldFromBase"];
  readonly material: MeshStandardMaterial;
}
function GhostTool({ robot, q_rad, tool, worldFromBase, material }: ToolProps) {
  const geometry = useMemo(() => (tool.shape ? shapeGeometry(tool.shape) : null), [tool]);
  useEffect(() => () => geometry?.dispose(), [geometry]);
  const matrix = useMemo(() => {
    const flange = flangePose(robot.arm, q_rad, identity<"base", "flange">(), armScratch());
    return poseMatrix(compose(worldFromBase, flange), new Matrix4());
  }, [robot, q_rad, worldFromBase]);
  return (
    geometry && (
      <mesh
        name="repair/tool"
        geometry={geometry}
        material={material}
        matrix={matrix}
        matrixAutoUpdate={false}
        raycast={noPick}
      />
    )
  );
}

interface ObjectProps {
  readonly object: ObjectRecord;
  readonly by_m: Vector3;
  readonly material: MeshStandardMaterial;
}
function GhostObject({ object, by_m, material }: ObjectProps) {
  const geometry = useMemo(() => shapeGeometry(object.shape), [object.shape]);
  useEffect(() => () => geometry.dispose(), [geometry]);
  const matrix = useMemo(
    () => poseMatrix(shiftedPose(object.worldFromObject, by_m), new Matrix4()),
    [object.worldFromObject, by_m],
  );
  return (
    <mesh
      name={`repair/${object.id}`}
      geometry={geometry}
      material={material}
      matrix={matrix}
      matrixAutoUpdate={false}
      raycast={noPick}
    />
  );
}

/** A ghost is nothing to be clicked. */
const noPick = (): void => undefined;
