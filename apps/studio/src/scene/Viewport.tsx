import { identity, type Pose, robotById } from "@twincell/core";
import { Canvas } from "@react-three/fiber";
import { lazy, Suspense, useEffect, useMemo, useRef, useState } from "react";
import { type Group, type Mesh, NeutralToneMapping, PCFShadowMap, PerspectiveCamera } from "three";
import { useStore } from "zustand";
import { dragFollows } from "../runtime/jog/drag.ts";
import { buildStore } from "../stores/build.ts";
import { cellStore } from "../stores/cell.ts";
import { registerCommands } from "../stores/commands.ts";
import { markerViewStore } from "../stores/marker-view.ts";
import { physicsStore } from "../stores/physics.ts";
import { playStore } from "../stores/play.ts";
import { selectionStore } from "../stores/selection.ts";
import { stationStore } from "../stores/stations.ts";
import { togetherStore } from "../stores/together.ts";
import { traceStore } from "../stores/trace.ts";
import { baseMapStore } from "../stores/base-map.ts";
import { repairStore } from "../stores/repairs.ts";
import { viewStore } from "../stores/view.ts";
import { type CameraWishes, Controls } from "./camera/controls.tsx";
import { ViewCube } from "./camera/view-cube.tsx";
import { FrameMeter } from "./frame-meter.ts";
import { TargetSphere } from "./handle/target-sphere.tsx";
import { Ghost, TcpHandle } from "./handle/tcp-handle.tsx";
import { newInteraction, type PointerLabel } from "./interaction.ts";
import { PartDrop } from "./objects/part-drop.tsx";
import { ObjectView } from "./objects/object-view.tsx";
import { LessonView } from "./path/lesson-view.tsx";
import { PathView } from "./path/path-view.tsx";
import { PastView } from "./robot/past-view.tsx";
import { DemonstrationView } from "./path/demonstration-view.tsx";
import { OverlayView } from "./path/overlay-view.tsx";
import { WorkPieceView } from "./path/workpiece-view.tsx";
import { TcpTrace } from "./path/tcp-trace.tsx";
import { Waypoints } from "./path/waypoints.tsx";
import { EdgeView } from "./pick/edge-view.tsx";
import { Pointer } from "./pick/pointer.tsx";
import { Outline } from "./pick/outline.tsx";
import { Picture } from "./picture-frame.tsx";
import { hiddenPicture } from "./picture.ts";
import { WatchedView } from "./physical/watched-view.tsx";
import { RenderLoop } from "./render-loop.tsx";
import { RobotView } from "./robot/robot-view.tsx";
import { Probe } from "./scene-probe.tsx";
import { RunContext } from "./stage/stage.tsx";
import "./scene.css";
import { readTheme } from "./theme.ts";
import { Thumbnail } from "./thumbnail.tsx";
import { ToolView } from "./tool-view.tsx";
import { WORDS } from "./words.ts";
import { askForHeadset } from "./xr/availability.ts";

/** Everything a headset needs is fetched when one is first asked for. */
const StationViews = lazy(() => import("./robot/station-view.tsx").then(part => ({ default: part.StationViews })));
const EditorPointers = lazy(() =>
  import("./objects/editor-pointers.tsx").then(part => ({ default: part.EditorPointers })),
);
const BaseMapView = lazy(() => import("./base-map-view.tsx").then(part => ({ default: part.BaseMapView })));
const RepairGhost = lazy(() => import("./robot/repair-ghost.tsx").then(part => ({ default: part.RepairGhost })));
const Gizmo = lazy(() => import("./gizmo/gizmo.tsx"));
const Display = lazy(() => import("./gizmo/display.tsx"));
const SurfaceView = lazy(() => import("./gizmo/surface-view.tsx"));
const MeasureView = lazy(() => import("./gizmo/measure-view.tsx"));
const Headset = lazy(() => import("./xr/headset.tsx").then(part => ({ default: part.Headset })));
const MarkerPicture = lazy(() => import("./marker/marker-picture.tsx"));
const MarkerCamera = lazy(() => import("./marker/marker-camera.tsx").then(part => ({ default: part.MarkerCamera })));
const meter = new FrameMeter();
const BARE_FLANGE: Pose<"flange", "tcp"> = identity();

/** The cell as it is now. Draws what stores and live state say; decides nothing. */
export function Viewport() {
  const document = useStore(cellStore, state => state.document);
  const mode = useStore(viewStore, state => state.mode);
  const baseMap = useStore(baseMapStore, state => state.on && state.field !== null);
  const together = useStore(togetherStore, state => state.editors.some(({ presence }) => presence?.pointer_m));
  const repairShown = useStore(repairStore, state => state.shown !== null);
  const inHeadset = useStore(viewStore, state => state.inHeadset);
  const onMarker = useStore(markerViewStore, state => state.on);
  const bare = useStore(markerViewStore, ({ on, objects }) => on && !objects);
  const markerSeen = useStore(markerViewStore, state => state.seen);
  const wish = useStore(viewStore, state => state.headsetWish);
  const physics = useStore(physicsStore, ({ status }) => status === "running" || status === "stopped");
  const playing = useStore(playStore, state => state.playing) || physics;
  const tracing = useStore(traceStore, state => state.active);
  const stations = useStore(stationStore, state => state.stations.length);
  const otherwise = useStore(buildStore, state => state.display !== "smooth" || state.section_m !== null);
  const measuring = useStore(buildStore, state => state.tool === "measure");
  const surfaces = useStore(buildStore, state => state.tool === "mate" || state.tool === "rig");
  const anything = useStore(selectionStore, state => state.selected !== null);
  const theme = useStore(viewStore, state => state.theme);
  // A headset shows a bright room, whatever the page looks like.
  const shade = inHeadset ? "light" : theme;
  const colours = useMemo(() => readTheme(shade), [shade]);
  const [pictured, setPictured] = useState(true);
  const picture = useMemo(hiddenPicture, []);
  const close = useMemo(() => new PerspectiveCamera(40, 1.4, 0.02, 60), []);
  const interaction = useMemo(newInteraction, []);
  const wishes = useMemo<CameraWishes>(() => ({ fit: () => undefined, look: () => undefined }), []);
  const label = useMemo<PointerLabel>(() => ({ element: null }), []);
  const targets = useRef<readonly Mesh[]>([]);
  const world = useRef<Group>(null);
  const cube = useRef<HTMLDivElement>(null);
  const robot = document ? robotById(document.robot.id) : undefined;
  const tool = document?.tools.find(each => each.name === document.tool);
  const worldFromBase = document?.robot.worldFromBase;
  useEffect(() => {
    if (robot && worldFromBase) dragFollows(robot, worldFromBase, tool?.flangeFromTcp ?? BARE_FLANGE);
  }, [robot, worldFromBase, tool]);
  useEffect(
    () => registerCommands([{ id: "view.fit", group: "view", words: WORDS.fit, keys: ["F"], run: () => wishes.fit() }]),
    [wishes],
  );
  useEffect(() => {
    void askForHeadset();
  }, []);

  return (
    <div className="viewport">
      {onMarker && (
        <Suspense fallback={null}>
          <MarkerPicture />
        </Suspense>
      )}
      <div
        className="canvas"
        style={{ position: "absolute", inset: 0 }}
        data-faint={onMarker && !markerSeen}
        role="img"
        aria-label={WORDS.viewport}
      >
        <Canvas
          frameloop="demand"
          dpr={[1, 2]}
          shadows={{ type: PCFShadowMap }}
          gl={{ antialias: true, toneMapping: NeutralToneMapping, toneMappingExposure: 0.95 }}
          camera={{ fov: 32, near: 0.05, far: 60, position: [3.6, 2.3, 2.1] }}
          onCreated={({ gl }) => {
            // Asking for a shader's errors waits until it is compiled: a pause at the first sight of each material.
            gl.debug.checkShaderErrors = import.meta.env.DEV;
          }}
        >
          <RenderLoop meter={meter} picture={picture} cube={cube} close={close} />
          <Probe meter={meter} close={close} />
          <Thumbnail />
          {onMarker && (
            <Suspense fallback={null}>
              <MarkerCamera />
            </Suspense>
          )}
          {document && <Controls wishes={wishes} world={world} document={document} interaction={interaction} />}
          <group rotation-x={-Math.PI / 2} ref={world}>
            {document && <RunContext theme={colours} document={document} sky={!inHeadset} room={!onMarker} />}
            {document && robot && <RobotView robot={robot} worldFromBase={document.robot.worldFromBase} />}
            {stations > 0 && (
              <Suspense fallback={null}>
                <StationViews />
              </Suspense>
            )}
            {document && tool && <ToolView tool={tool} worldFromBase={document.robot.worldFromBase} />}
            {document && robot && repairShown && (
              <Suspense fallback={null}>
                <RepairGhost document={document} robot={robot} tool={tool} />
              </Suspense>
            )}
            {together && (
              <Suspense fallback={null}>
                <EditorPointers />
              </Suspense>
            )}
            {baseMap && (
              <Suspense fallback={null}>
                <BaseMapView />
              </Suspense>
            )}
            {(bare ? undefined : document)?.objects.map(object => (
              <ObjectView key={object.id} object={object} theme={colours} glass={inHeadset} />
            ))}
            {document && <WatchedView document={document} theme={colours} />}
            <PathView theme={colours} />
            {document && <Waypoints document={document} />}
            {document && <WorkPieceView document={document} theme={colours} />}
            <TcpTrace theme={colours} />
            <PastView />
            <OverlayView theme={colours} />
            <DemonstrationView theme={colours} />
            <LessonView theme={colours} />
            <EdgeView theme={colours} />
            <TcpHandle
              interaction={interaction}
              shown={robot !== undefined && mode === "teach" && !playing && !tracing}
              theme={colours}
              targets={targets}
            />
            <TargetSphere theme={colours} />
            <Ghost interaction={interaction} tool={tool} theme={colours} />
            {document && mode === "cell" && anything && !inHeadset && (
              <Suspense fallback={null}>
                <Gizmo world={world} document={document} interaction={interaction} label={label} />
              </Suspense>
            )}
            {document && mode === "cell" && surfaces && (
              <Suspense fallback={null}>
                <SurfaceView document={document} theme={colours} />
              </Suspense>
            )}
            {mode === "cell" && measuring && (
              <Suspense fallback={null}>
                <MeasureView />
              </Suspense>
            )}
            {mode === "cell" && otherwise && (
              <Suspense fallback={null}>
                <Display world={world} />
              </Suspense>
            )}
            <Outline world={world} theme={colours} />
          </group>
          {document && wish > 0 && (
            <Suspense fallback={null}>
              <Headset wish={wish} document={document} interaction={interaction} world={world} />
            </Suspense>
          )}
          {document && mode === "cell" && <PartDrop world={world} />}
          {document && (
            <Pointer
              interaction={interaction}
              label={label}
              world={world}
              handle={targets}
              document={document}
              meter={meter}
            />
          )}
        </Canvas>
      </div>
      {!onMarker && <ViewCube cube={cube} wishes={wishes} />}
      {pictured && robot && !inHeadset && !onMarker && mode !== "cell" && (
        <Picture picture={picture} onHide={() => setPictured(false)} />
      )}
      <div
        className="pointer-label"
        hidden
        ref={element => {
          label.element = element;
        }}
      />
    </div>
  );
}
