import type { PartMaterial } from "@twincell/core";
import { Color, MeshPhysicalMaterial, MeshStandardMaterial } from "three";

/** Painted castings, dark wrists, small reflections. Shared by all links; red twins are made on first contact. */
export type PartMaterials = Readonly<Record<PartMaterial, MeshStandardMaterial>>;

export function partMaterials(): PartMaterials {
  return {
    casting: new MeshPhysicalMaterial({ color: "#eaa50c", roughness: 0.46, metalness: 0, clearcoat: 0.4, clearcoatRoughness: 0.32, envMapIntensity: 0.9 }),
    dark: new MeshStandardMaterial({ color: "#272c30", roughness: 0.5, metalness: 0.25 }),
    cover: new MeshStandardMaterial({ color: "#3c444a", roughness: 0.55, metalness: 0.15 }),
    metal: new MeshStandardMaterial({ color: "#b9c0c5", roughness: 0.32, metalness: 0.9 }),
    mark: new MeshStandardMaterial({ color: "#f7f9fa", roughness: 0.5, metalness: 0, emissive: new Color("#f7f9fa"), emissiveIntensity: 0.12 }),
  };
}
