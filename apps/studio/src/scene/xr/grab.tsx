import { useFrame } from "@react-three/fiber";
import { type RefObject, useEffect, useMemo } from "react";
import { type Group, Matrix4 } from "three";
import { tick } from "../../runtime/jog/jog-frames.ts";
import type { Interaction } from "../interaction.ts";
import { Grabber, type KeyAim } from "./grabber.ts";
import { GripperButton } from "./gripper-button.ts";

/**
 * The hands of a headset, once a frame: the only part of the window's heartbeat that goes on while a headset is worn.
 * What takes the tool and what closes the gripper are read apart, each with its own choice of button (row X-33).
 */
export function Grab({
  interaction,
  keys,
  origin,
  world,
  letGo,
}: {
  readonly interaction: Interaction;
  readonly keys: KeyAim;
  readonly origin: RefObject<Group | null>;
  readonly world: RefObject<Group | null>;
  /** Filled here: lets go of everything and says whether the tool was held. */
  readonly letGo: RefObject<(() => boolean) | null>;
}) {
  const work = useMemo(
    () => ({
      grabber: null as Grabber | null,
      gripper: new GripperButton(),
      sceneFromRoom: new Matrix4(),
      worldFromScene: new Matrix4(),
    }),
    [],
  );
  useEffect(() => {
    const grabber = (work.grabber = new Grabber(interaction, keys));
    letGo.current = () => grabber.letGo();
    return () => {
      letGo.current = null;
      grabber.close();
      work.grabber = null;
    };
  }, [work, interaction, keys, letGo]);
  // Rays of the headset's pointers need not look through every mesh of the cell: nothing in it listens to them.
  useEffect(() => {
    const group = world.current;
    if (!group) return;
    group.intersectChildren = false;
    return () => {
      group.intersectChildren = true;
    };
  }, [world]);

  useFrame(({ gl }, _dt, frame: XRFrame | undefined) => {
    const space = gl.xr.getReferenceSpace();
    const session = gl.xr.getSession();
    if (!frame || !space || !session || !origin.current || !world.current) return;
    tick(performance.now());
    work.sceneFromRoom.copy(origin.current.matrixWorld);
    work.worldFromScene.copy(world.current.matrixWorld).invert();
    work.grabber?.read(session, frame, space, work);
    work.gripper.read(session.inputSources);
  }, -30);
  return null;
}
