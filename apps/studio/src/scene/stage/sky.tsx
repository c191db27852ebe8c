import { useMemo } from "react";
import { BackSide, ShaderMaterial } from "three";
import type { SceneTheme } from "../theme.ts";

/** The backdrop: a large dome, so that it stays where it is when a person in a headset turns. */
export function Sky({ theme }: { readonly theme: SceneTheme }) {
  const material = useMemo(
    () =>
      new ShaderMaterial({
        side: BackSide,
        depthWrite: false,
        toneMapped: false,
        uniforms: { above: { value: theme.top }, below: { value: theme.bottom } },
        vertexShader:
          "varying vec3 vWay; void main() { vWay = position; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); gl_Position.z = gl_Position.w * 0.9999; }",
        fragmentShader: `varying vec3 vWay; uniform vec3 above; uniform vec3 below;
      void main() { float up = normalize(vWay).z; gl_FragColor = vec4(mix(below, above, smoothstep(-0.55, 0.5, up)), 1.0);
      #include <colorspace_fragment>
      }`,
      }),
    [theme],
  );
  return (
    <mesh material={material} renderOrder={-10} userData={{ unpickable: true }}>
      <sphereGeometry args={[30, 32, 24]} />
    </mesh>
  );
}
