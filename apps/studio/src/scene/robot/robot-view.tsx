import { armScratch, compose, identity, linkPoses, type Pose, type Robot } from "@twincell/core";
import { useFrame } from "@react-three/fiber";
import { useEffect, useMemo, useRef } from "react";
import type { Group } from "three";
import { theLive } from "../../live/live.ts";
import { paintTouching } from "../paint.ts";
import { raycastByTree } from "../pick/raycast.ts";
import { poseMatrix } from "../pose-matrix.ts";
import { linkDrawings } from "./link-geometry.ts";
import { partMaterials } from "./materials.ts";

/** The robot as its joint angles say, link by link. Draws, decides nothing. */
export function RobotView({ robot, worldFromBase }: { readonly robot: Robot; readonly worldFromBase: Pose<"world", "base"> }) {
  const drawings = useMemo(() => linkDrawings(robot), [robot]);
  const materials = useMemo(() => partMaterials(robot.paint), [robot.paint]);
  const links = useRef<(Group | null)[]>([]);
  const seen = useRef(-1);
  const scratch = useMemo(() => ({
    arm: armScratch(), world: identity<"world", "link">(),
    baseFromLink: Array.from({ length: robot.arm.joints.length + 1 }, () => identity<"base", "link">()),
  }), [robot]);

  useEffect(() => { seen.current = -1; }, [robot, worldFromBase]);
  useEffect(() => () => {
    for (const drawing of drawings) for (const piece of drawing.pieces) piece.geometry.dispose();
  }, [drawings]);
  useEffect(() => paintTouching(name => links.current[drawings.findIndex(drawing => drawing.name === name)] ?? null), [drawings]);

  useFrame(() => {
    const live = theLive();
    if (live.revision === seen.current) return;
    seen.current = live.revision;
    linkPoses(robot.arm, live.q_rad, scratch.baseFromLink, scratch.arm);
    for (let i = 0; i < scratch.baseFromLink.length; i++) {
      const group = links.current[i];
      if (!group) continue;
      compose(worldFromBase, scratch.baseFromLink[i]!, scratch.world);
      poseMatrix(scratch.world, group.matrix);
      group.matrixWorldNeedsUpdate = true;
    }
  }, -10);

  return drawings.map(drawing => (
    <group key={drawing.name} name={drawing.name} matrixAutoUpdate={false} userData={{ thing: { kind: "link", link: drawing.link } }}
      ref={group => { links.current[drawing.link] = group; }}>
      {drawing.pieces.map(piece => <mesh key={piece.material} geometry={piece.geometry} material={materials[piece.material]} castShadow receiveShadow raycast={raycastByTree} />)}
    </group>
  ));
}
