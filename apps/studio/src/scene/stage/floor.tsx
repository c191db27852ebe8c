import { useMemo } from "react";
import { MeshLambertMaterial } from "three";
import type { SceneTheme } from "../theme.ts";

const RADIUS_M = 11;

/**
 * Large surfaces are shaded the cheap way: they fill the picture, and on a phone or without a graphics card every pixel
 * counts. The floor with its grid (0.25 m fine, 1 m bold), one draw call, fading into the distance.
 */
export function Floor({ theme }: { readonly theme: SceneTheme }) {
  const material = useMemo(() => floorMaterial(theme), [theme]);
  return (
    <mesh receiveShadow material={material} userData={{ unpickable: true }}>
      <circleGeometry args={[RADIUS_M, 96]} />
    </mesh>
  );
}

function floorMaterial(theme: SceneTheme): MeshLambertMaterial {
  const material = new MeshLambertMaterial({
    color: theme.floor.clone().multiplyScalar(theme.dark ? 1.75 : 1),
    transparent: true,
  });
  material.onBeforeCompile = shader => {
    shader.uniforms.gridColor = { value: theme.grid };
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nvarying vec2 vFloor;")
      .replace("#include <begin_vertex>", "#include <begin_vertex>\nvFloor = position.xy;");
    shader.fragmentShader = shader.fragmentShader
      .replace(
        "#include <common>",
        `#include <common>
        varying vec2 vFloor; uniform vec3 gridColor;
        float gridLine(float pitch, float width) {
          vec2 at = vFloor / pitch, soft = fwidth(at), near = abs(fract(at - 0.5) - 0.5);
          vec2 line = 1.0 - smoothstep(soft * width, soft * (width + 1.0), near);
          return max(line.x * (1.0 - smoothstep(0.15, 0.5, soft.x)), line.y * (1.0 - smoothstep(0.15, 0.5, soft.y)));
        }`,
      )
      .replace(
        "#include <color_fragment>",
        `#include <color_fragment>
        float far = length(vFloor);
        float grid = max(gridLine(0.25, 0.0) * 0.34, gridLine(1.0, 0.25) * 0.72) * (1.0 - smoothstep(2.0, 7.5, far));
        diffuseColor.rgb = mix(diffuseColor.rgb, gridColor, grid);
        diffuseColor.a *= 1.0 - smoothstep(4.0, ${RADIUS_M.toFixed(1)}, far);`,
      );
  };
  return material;
}
