import { OrbitControls } from "@react-three/drei";

export function Controls() {
  return <OrbitControls makeDefault target={[0.5, 0.82, -0.05]} />;
}
