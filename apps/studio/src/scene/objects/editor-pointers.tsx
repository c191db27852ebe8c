import { Html } from "@react-three/drei";
import { useStore } from "zustand";
import { colourOf, togetherStore } from "../../stores/together.ts";

/** As large as a finger tip, seen through what stands before it. */
const RADIUS_M = 0.012;

/** Where the others point, each with the name. */
export function EditorPointers() {
  const editors = useStore(togetherStore, state => state.editors);
  return editors.map(editor => {
    const at_m = editor.presence?.pointer_m;
    if (!at_m) return null;
    const colour = colourOf(editor);
    return (
      <group key={editor.connection} position={[...at_m]}>
        <mesh renderOrder={20}>
          <sphereGeometry args={[RADIUS_M, 16, 12]} />
          <meshBasicMaterial color={colour} depthTest={false} transparent />
        </mesh>
        <Html className="editor-pointer" style={{ background: colour }} zIndexRange={[5, 0]}>
          {editor.who}
        </Html>
      </group>
    );
  });
}
