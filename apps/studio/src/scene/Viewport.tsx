import { robotById } from "@twincell/core";
import { Canvas } from "@react-three/fiber";
import { useMemo } from "react";
import { NeutralToneMapping, PCFShadowMap } from "three";
import { useStore } from "zustand";
import { cellStore } from "../stores/cell.ts";
import { viewStore } from "../stores/view.ts";
import { Controls } from "./camera/controls.tsx";
import { FrameMeter } from "./frame-meter.ts";
import { ObjectView } from "./objects/object-view.tsx";
import { hiddenPicture } from "./picture.ts";
import { RenderLoop } from "./render-loop.tsx";
import { RobotView } from "./robot/robot-view.tsx";
import { Stage } from "./stage/stage.tsx";
import { readTheme } from "./theme.ts";
import { ToolView } from "./tool-view.tsx";

const meter = new FrameMeter();

/** The cell as it is now. Draws what stores and live state say; decides nothing. */
export function Viewport() {
  const document = useStore(cellStore, state => state.document);
  const theme = useStore(viewStore, state => state.theme);
  const colours = useMemo(() => readTheme(theme), [theme]);
  const picture = useMemo(hiddenPicture, []);
  const robot = document && robotById(document.robot.id);
  const tool = document?.tools.find(each => each.name === document.tool);
  return (
    <Canvas frameloop="demand" dpr={[1, 2]} shadows={{ type: PCFShadowMap }} gl={{ antialias: true, toneMapping: NeutralToneMapping, toneMappingExposure: 0.95 }}
      camera={{ fov: 32, near: 0.05, far: 60, position: [3.2, 1.75, 2.05] }}>
      <RenderLoop meter={meter} picture={picture} />
      <Controls />
      <group rotation-x={-Math.PI / 2}>
        {document && <Stage theme={colours} document={document} />}
        {document && robot && <RobotView robot={robot} worldFromBase={document.robot.worldFromBase} />}
        {document && tool && <ToolView tool={tool} worldFromBase={document.robot.worldFromBase} />}
        {document?.objects.map(object => <ObjectView key={object.id} object={object} />)}
      </group>
    </Canvas>
  );
}
