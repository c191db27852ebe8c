import { armScratch, compose, identity, linkPoses, type Pose, type Robot } from "@twincell/core";
import { useFrame } from "@react-three/fiber";
import { useEffect, useMemo, useRef } from "react";
import type { Group } from "three";
import { paintTouching } from "../paint.ts";
import { raycastByTree } from "../pick/raycast.ts";
import { poseMatrix } from "../pose-matrix.ts";
import { linkDrawings } from "./link-geometry.ts";
import { ghostMaterial, linkMaterial } from "./materials.ts";

/** Where the angles come from: written in place, `revision` counts the changes. */
export interface ArmState {
  readonly q_rad: ArrayLike<number>;
  readonly revision: number;
}
interface Props {
  readonly robot: Robot;
  readonly worldFromBase: Pose<"world", "base">;
  readonly live: () => ArmState;
  /**
   * Before the names of its links, so that no two robots have the same. The robot of the cell has none: it can be
   * picked and touched.
   */
  readonly prefix?: string;
  /** Drawn see-through in that colour, without shadow: where the robot will be. */
  readonly ghost?: string | undefined;
}

/** A ghost is nothing to be clicked. */
const noPick = (): void => undefined;

/** An arm as its joint angles say, link by link. Draws, decides nothing. */
export function ArmView({ robot, worldFromBase, live: now, prefix = "", ghost }: Props) {
  const drawings = useMemo(() => linkDrawings(robot), [robot]);
  const material = useMemo(() => (ghost === undefined ? linkMaterial : ghostMaterial(ghost)), [ghost]);
  const links = useRef<(Group | null)[]>([]);
  const seen = useRef(-1);
  const scratch = useMemo(
    () => ({
      arm: armScratch(),
      world: identity<"world", "link">(),
      baseFromLink: Array.from({ length: robot.arm.joints.length + 1 }, () => identity<"base", "link">()),
    }),
    [robot],
  );

  useEffect(() => {
    seen.current = -1;
  }, [robot, worldFromBase]);
  useEffect(
    () => () => {
      for (const drawing of drawings) drawing.geometry.dispose();
    },
    [drawings],
  );
  useEffect(
    () =>
      prefix !== ""
        ? undefined
        : paintTouching(name => links.current[drawings.find(drawing => drawing.name === name)?.link ?? -1] ?? null),
    [drawings, prefix],
  );

  useFrame(() => {
    const live = now();
    if (live.revision === seen.current) return;
    // Another robot, by undo say, is there before React has drawn it: until then the angles are not this arm's.
    if (live.q_rad.length !== robot.arm.joints.length) return;
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
    <group
      key={drawing.name}
      name={prefix + drawing.name}
      matrixAutoUpdate={false}
      userData={prefix === "" ? { thing: { kind: "link", link: drawing.link } } : { station: true }}
      ref={group => {
        links.current[drawing.link] = group;
      }}
    >
      <mesh
        geometry={drawing.geometry}
        material={material}
        castShadow={ghost === undefined}
        receiveShadow={ghost === undefined}
        raycast={ghost === undefined ? raycastByTree : noPick}
      />
    </group>
  ));
}
