import type { PartMaterial, RobotPaint } from "@twincell/core";
import { type BufferGeometry, Color, Float32BufferAttribute, MeshPhysicalMaterial, MeshStandardMaterial } from "three";

/** How a part of a robot looks; each number 0 … 1. */
export interface Surface {
  /** sRGB, as #rrggbb. */
  readonly color: string;
  readonly roughness: number;
  readonly metalness: number;
  /** Strength of the clear varnish over the paint. */
  readonly clearcoat: number;
  /** Fraction of its colour that it shows without any light. */
  readonly emission: number;
}
/** Painted castings, dark wrists, bare metal, bright marks. */
export type PartSurfaces = Readonly<Record<PartMaterial, Surface>>;

/** Colours of the robots that bring none of their own. */
const PLAIN: RobotPaint = { casting: "#eaa50c", dark: "#272c30", cover: "#3c444a" };

export function partSurfaces({ casting, dark, cover }: RobotPaint = PLAIN): PartSurfaces {
  return {
    casting: { color: casting, roughness: 0.46, metalness: 0, clearcoat: 0.4, emission: 0 },
    dark: { color: dark, roughness: 0.5, metalness: 0.25, clearcoat: 0, emission: 0 },
    cover: { color: cover, roughness: 0.55, metalness: 0.15, clearcoat: 0, emission: 0 },
    metal: { color: "#b9c0c5", roughness: 0.32, metalness: 0.9, clearcoat: 0, emission: 0 },
    mark: { color: "#f7f9fa", roughness: 0.5, metalness: 0, clearcoat: 0, emission: 0.12 },
  };
}

const SURFACE = "surface";

/** Writes a surface into every corner of a geometry, so that parts of several surfaces are one draw call. */
export function giveSurface(geometry: BufferGeometry, surface: Surface): void {
  const corners = geometry.getAttribute("position").count;
  const { r, g, b } = new Color(surface.color);
  const colors = new Float32Array(3 * corners);
  const surfaces = new Float32Array(4 * corners);
  for (let i = 0; i < corners; i++) {
    colors.set([r, g, b], 3 * i);
    surfaces.set([surface.roughness, surface.metalness, surface.clearcoat, surface.emission], 4 * i);
  }
  geometry.setAttribute("color", new Float32BufferAttribute(colors, 3));
  geometry.setAttribute(SURFACE, new Float32BufferAttribute(surfaces, 4));
}

/** The one material of all links of all robots: what differs between parts comes from `giveSurface`. */
export const linkMaterial: MeshPhysicalMaterial = (() => {
  const material = new MeshPhysicalMaterial({ vertexColors: true, clearcoat: 1, clearcoatRoughness: 0.32 });
  material.onBeforeCompile = shader => {
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", `#include <common>\nattribute vec4 ${SURFACE};\nvarying vec4 vSurface;`)
      .replace("#include <begin_vertex>", `#include <begin_vertex>\nvSurface = ${SURFACE};`);
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", "#include <common>\nvarying vec4 vSurface;")
      .replace("#include <roughnessmap_fragment>", "float roughnessFactor = vSurface.x;")
      .replace("#include <metalnessmap_fragment>", "float metalnessFactor = vSurface.y;")
      .replace(
        "#include <lights_physical_fragment>",
        "#include <lights_physical_fragment>\nmaterial.clearcoat = vSurface.z;",
      )
      .replace("#include <emissivemap_fragment>", "totalEmissiveRadiance = vSurface.w * diffuseColor.rgb;");
  };
  material.customProgramCacheKey = () => "twincell link";
  return material;
})();

/** See-through, in the colour of the theme: where a robot will be, which is not where it is. */
export const ghostMaterial = (color: string): MeshStandardMaterial =>
  new MeshStandardMaterial({ color, transparent: true, opacity: 0.32, depthWrite: false, roughness: 0.9 });
