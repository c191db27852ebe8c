import type { PartMaterial, RobotPaint } from "@twincell/core";
import { Color, MeshPhysicalMaterial, MeshStandardMaterial } from "three";

/** Painted castings, dark wrists, small reflections. Shared by all links; red twins are made on first contact. */
export type PartMaterials = Readonly<Record<PartMaterial, MeshStandardMaterial>>;

/** Colours of the robots that bring none of their own. */
const PLAIN: RobotPaint = { casting: "#eaa50c", dark: "#272c30", cover: "#3c444a" };

export function partMaterials({ casting, dark, cover }: RobotPaint = PLAIN): PartMaterials {
  return {
    casting: new MeshPhysicalMaterial({
      color: casting,
      roughness: 0.46,
      metalness: 0,
      clearcoat: 0.4,
      clearcoatRoughness: 0.32,
      envMapIntensity: 0.9,
    }),
    dark: new MeshStandardMaterial({ color: dark, roughness: 0.5, metalness: 0.25 }),
    cover: new MeshStandardMaterial({ color: cover, roughness: 0.55, metalness: 0.15 }),
    metal: new MeshStandardMaterial({ color: "#b9c0c5", roughness: 0.32, metalness: 0.9 }),
    mark: new MeshStandardMaterial({
      color: "#f7f9fa",
      roughness: 0.5,
      metalness: 0,
      emissive: new Color("#f7f9fa"),
      emissiveIntensity: 0.12,
    }),
  };
}

/** See-through, in the colour of the theme: where a robot will be, which is not where it is. */
export function ghostMaterials(color: string): PartMaterials {
  const ghost = new MeshStandardMaterial({
    color,
    transparent: true,
    opacity: 0.32,
    depthWrite: false,
    roughness: 0.9,
  });
  return { casting: ghost, dark: ghost, cover: ghost, metal: ghost, mark: ghost };
}
