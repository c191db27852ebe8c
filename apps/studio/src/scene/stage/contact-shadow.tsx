import { useMemo } from "react";
import { ShaderMaterial, Vector2 } from "three";

/** The soft dark rim under a thing that stands on something: half sizes and corner radius in metres. */
export function ContactShadow({
  halfX_m,
  halfY_m,
  round_m,
  at,
  strength,
  reach_m = 0.09,
  turn_rad = 0,
}: {
  readonly halfX_m: number;
  readonly halfY_m: number;
  readonly round_m: number;
  readonly at: readonly [number, number, number];
  readonly strength: number;
  readonly reach_m?: number;
  readonly turn_rad?: number;
}) {
  const material = useMemo(
    () =>
      new ShaderMaterial({
        transparent: true,
        depthWrite: false,
        polygonOffset: true,
        polygonOffsetFactor: -2,
        polygonOffsetUnits: -2,
        uniforms: {
          halfSize: { value: new Vector2(halfX_m, halfY_m) },
          roundness: { value: round_m },
          reach: { value: reach_m },
          strength: { value: strength },
        },
        vertexShader:
          "varying vec2 vAt; void main() { vAt = position.xy; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",
        fragmentShader: `varying vec2 vAt; uniform vec2 halfSize; uniform float roundness, reach, strength;
      void main() {
        vec2 q = abs(vAt) - halfSize + roundness;
        float d = length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - roundness;
        float k = 1.0 - smoothstep(-0.25 * reach, reach, d);
        gl_FragColor = vec4(0.0, 0.0, 0.0, k * k * strength);
      }`,
      }),
    [halfX_m, halfY_m, round_m, reach_m, strength],
  );
  return (
    <mesh
      position={[at[0], at[1], at[2] + 0.0006]}
      rotation-z={turn_rad}
      material={material}
      renderOrder={-1}
      userData={{ unpickable: true, unpainted: true }}
    >
      <planeGeometry args={[2 * (halfX_m + reach_m), 2 * (halfY_m + reach_m)]} />
    </mesh>
  );
}
