import { Tooltip } from "radix-ui";
import { lazy, Suspense, useEffect, useRef } from "react";
import { useStore } from "zustand";
import { Arrange } from "./features/build/Arrange.tsx";
import { MateCard } from "./features/build/MateCard.tsx";
import { MeasureCard } from "./features/build/MeasureCard.tsx";
import { ToolBar } from "./features/build/ToolBar.tsx";
import { Check } from "./features/check/Check.tsx";
import { Coach } from "./features/coach/Coach.tsx";
import { Files } from "./features/files/Files.tsx";
import { ControlsDialog } from "./features/input/ControlsDialog.tsx";
import { GamepadWatch } from "./features/input/GamepadWatch.tsx";
import { Shortcuts } from "./features/input/Shortcuts.tsx";
import { Inspector } from "./features/inspector/Inspector.tsx";
import { LessonCard } from "./features/lesson/LessonCard.tsx";
import { LessonFile } from "./features/lesson/LessonFile.tsx";
import { Notices } from "./features/notices/Notices.tsx";
import { UpdateBar } from "./features/offline/UpdateBar.tsx";
import { Overlay } from "./features/overlay/Overlay.tsx";
import { Physics } from "./features/physics/Physics.tsx";
import { Process } from "./features/process/Process.tsx";
import { Palette } from "./features/palette/Palette.tsx";
import { Pendant } from "./features/pendant/Pendant.tsx";
import { SavedPoses } from "./features/poses/SavedPoses.tsx";
import { Timeline } from "./features/timeline/Timeline.tsx";
import { TopBar } from "./features/topbar/TopBar.tsx";
import { TextSide } from "./features/text/TextSide.tsx";
import { ProgramSwitch } from "./features/tree/ProgramSwitch.tsx";
import { TracePanel } from "./features/trace/TracePanel.tsx";
import { Tree } from "./features/tree/Tree.tsx";
import { SignIn } from "./features/people/SignIn.tsx";
import { Welcome } from "./features/welcome/Welcome.tsx";
import { Sheet } from "./Sheet.tsx";
import { SceneGuard } from "./SceneGuard.tsx";
import { buildStore } from "./stores/build.ts";
import { cellStore } from "./stores/cell.ts";
import { textOf, theProgram } from "./stores/document.ts";
import { lessonStore } from "./stores/lesson.ts";
import { findStep } from "./stores/program.ts";
import { markerViewStore } from "./stores/marker-view.ts";
import { selectionStore, type Thing } from "./stores/selection.ts";
import { textStore } from "./stores/text.ts";
import { traceStore } from "./stores/trace.ts";
import { viewStore } from "./stores/view.ts";
import { Segments } from "./ui/Choice.tsx";
import { PHONE, useMedia } from "./ui/useMedia.ts";
import { words } from "./messages/index.ts";
import "./app.css";

const TextPanel = lazy(() => import("./features/text/TextPanel.tsx"));
const Viewport = lazy(() => import("./scene/Viewport.tsx").then(scene => ({ default: scene.Viewport })));
const Together = lazy(() => import("./features/together/Together.tsx"));
const Export = lazy(() => import("./features/export/Export.tsx"));
const CollisionDialog = lazy(() => import("./features/collide/CollisionDialog.tsx"));
const Start = lazy(() => import("./features/start/Start.tsx"));
const DemonstrationDialog = lazy(() => import("./features/demonstration/DemonstrationDialog.tsx"));
const GloveDialog = lazy(() => import("./features/glove/GloveDialog.tsx"));
const Rig = lazy(() => import("./features/build/Rig.tsx").then(part => ({ default: part.Rig })));
const RunQuestion = lazy(() => import("./features/run/RunQuestion.tsx"));
const ShapeDialog = lazy(() => import("./features/shapes/ShapeDialog.tsx"));
const Robots = lazy(() => import("./features/robots/Robots.tsx"));
const RobotQuestion = lazy(() => import("./features/robots/RobotQuestion.tsx"));
const DhTable = lazy(() => import("./features/robots/DhTable.tsx"));
const AddStation = lazy(() => import("./features/stations/AddStation.tsx"));
const People = lazy(() => import("./features/people/People.tsx"));
const Fleet = lazy(() => import("./features/fleet/Fleet.tsx"));
const Cameras = lazy(() => import("./features/video/Cameras.tsx"));
const MarkerPanel = lazy(() => import("./features/marker/MarkerPanel.tsx"));
const DeviceCheck = lazy(() => import("./features/device/DeviceCheck.tsx"));
const RegistrationDialog = lazy(() => import("./features/registration/RegistrationDialog.tsx"));
const VideoPanels = lazy(() => import("./features/video/VideoPanels.tsx"));
const Stations = lazy(() => import("./features/stations/Stations.tsx").then(part => ({ default: part.Stations })));
const Run = lazy(() => import("./features/run/Run.tsx"));
const PartLibrary = lazy(() =>
  import("./features/parts/PartLibrary.tsx").then(part => ({ default: part.PartLibrary })),
);
const History = lazy(() => import("./features/history/History.tsx"));
const Rewind = lazy(() => import("./features/history/Rewind.tsx"));

/** The shell: five modes around one scene. Nothing here changes many times a second. */
export function App() {
  const phone = useMedia(PHONE);
  const theme = useStore(viewStore, state => state.theme);
  const text = useStore(cellStore, state => textOf(state.document));
  const teaching = useStore(viewStore, state => state.mode === "teach");
  const building = useStore(viewStore, state => state.mode === "cell");
  const learning = useStore(lessonStore, state => state.lesson !== null);
  const layout = useStore(textStore, state => state.layout);
  const onMarker = useStore(markerViewStore, state => state.on);
  const side = text !== null && teaching && layout === "side" && !phone;
  useEffect(() => {
    document.documentElement.dataset.theme = theme;
  }, [theme]);
  const sidePanel = useRef<HTMLDivElement>(null);
  // What has just been selected in the cell shows its numbers first, wherever the panel was scrolled to.
  useEffect(
    () =>
      selectionStore.subscribe(({ selected }, before) => {
        if (selected !== before.selected && isShownFirst(selected)) sidePanel.current?.scrollTo({ top: 0 });
      }),
    [],
  );
  return (
    <Tooltip.Provider delayDuration={500}>
      <div className="app" data-layout={phone ? "phone" : "desk"} data-text={side ? "side" : undefined}>
        <a className="skip-link" href="#program">
          {words.app.skip}
        </a>
        <TopBar key="top" phone={phone} />
        {!phone && (
          <nav key="left" className="panel area-left" aria-label={words.app.region.cell}>
            {side ? (
              <TextSide text={text}>
                <ProgramSwitch />
              </TextSide>
            ) : (
              <Tree />
            )}
            <Honest />
          </nav>
        )}
        {side && (
          <section key="text" className="panel area-text" aria-label={words.text.title}>
            <Suspense>
              <TextPanel />
            </Suspense>
          </section>
        )}
        <main key="view" className="area-view" aria-label={words.app.region.view}>
          <SceneGuard>
            <Suspense
              fallback={
                <p className="scene-note" role="status">
                  {words.app.loadingScene}
                </p>
              }
            >
              <Viewport />
            </Suspense>
          </SceneGuard>
          <Overlay phone={phone} />
          {building && !phone && !onMarker && (
            <>
              <ToolBar />
              <MeasureCard />
              <MateCard />
            </>
          )}
          {text !== null && teaching && !phone && (
            <div className="text-switch">
              <Segments
                label={words.text.layout}
                value={layout}
                onChange={value => textStore.setState({ layout: value })}
                options={[
                  { value: "side", words: words.text.side },
                  { value: "3d", words: words.text.view },
                ]}
              />
            </div>
          )}
          <Physics />
          <Suspense>
            <VideoPanels />
            {onMarker && <MarkerPanel />}
          </Suspense>
          {!phone && !building && !learning && <Coach />}
          <LessonCard />
          <Welcome />
          <SignIn />
          <Notices />
          <UpdateBar />
          <span className="visually-hidden" id="reorder-hint">
            {words.tree.reorderHint}
          </span>
        </main>
        {phone ? (
          <Sheet key="sheet" />
        ) : (
          <>
            {!side && (
              <aside key="right" className="panel area-right" aria-label={words.app.region.side}>
                <div className="scroll" ref={sidePanel}>
                  <RightSide />
                </div>
              </aside>
            )}
            <BottomSide key="bottom" />
          </>
        )}
        <Palette />
        <ControlsDialog />
        <Suspense>
          <Export />
        </Suspense>
        <Suspense>
          <Start />
        </Suspense>
        <Suspense>
          <Robots />
          <RobotQuestion />
          <DhTable />
        </Suspense>
        <Suspense>
          <AddStation />
        </Suspense>
        <Suspense>
          <CollisionDialog />
        </Suspense>
        <Suspense>
          <ShapeDialog />
        </Suspense>
        <Suspense>
          <RunQuestion />
        </Suspense>
        <Suspense>
          <DemonstrationDialog />
        </Suspense>
        <Suspense>
          <GloveDialog />
        </Suspense>
        <Suspense>
          <Cameras />
          <People />
          <Together />
          <Fleet />
          <RegistrationDialog />
          <DeviceCheck />
        </Suspense>
        <Files />
        <LessonFile />
        <Shortcuts />
        <GamepadWatch />
      </div>
    </Tooltip.Provider>
  );
}

/**
 * What was recorded or gripped is selected at once, while the hand stays on the pendant: its numbers are shown below.
 * Everything else has its numbers first.
 */
function isShownFirst(selected: Thing | null): boolean {
  if (selected?.kind !== "step") return selected !== null;
  const program = theProgram();
  const type = program ? findStep(program, selected.id)?.step.type : undefined;
  return type !== undefined && type !== "move" && type !== "gripper";
}

const Honest = () => (
  <p className="honest" title={words.app.notSafetyHint}>
    {words.app.notSafety}
  </p>
);

function RightSide() {
  const mode = useStore(viewStore, state => state.mode);
  const tracing = useStore(traceStore, state => state.active);
  const rigging = useStore(buildStore, state => state.tool === "rig");
  const nothing = useStore(selectionStore, state => state.selected === null);
  const first = useStore(selectionStore, ({ selected }) => isShownFirst(selected));
  switch (mode) {
    case "cell":
      return rigging ? (
        <Suspense>
          <Rig />
        </Suspense>
      ) : (
        <>
          <Inspector />
          {nothing && <Process />}
          <Arrange />
        </>
      );
    case "teach":
      return (
        <>
          {tracing && <TracePanel key="trace" />}
          {first && <Inspector key="inspector" />}
          <Pendant key="pendant" />
          <SavedPoses key="poses" />
          {!first && <Inspector key="inspector" />}
        </>
      );
    case "check":
      return (
        <>
          <Check />
          <Inspector />
        </>
      );
    case "run":
      return (
        <Suspense>
          <Run />
          <Stations />
        </Suspense>
      );
    case "history":
      return (
        <Suspense>
          <History />
        </Suspense>
      );
  }
}
/** In History the time is that of the open run; in Cell the part library takes the place of the time line. */
function BottomSide() {
  const mode = useStore(viewStore, state => state.mode);
  return (
    <footer className="area-bottom" aria-label={mode === "cell" ? words.parts.title : words.app.region.time}>
      {mode === "cell" ? (
        <Suspense fallback={<div className="parts" />}>
          <PartLibrary />
        </Suspense>
      ) : mode === "history" ? (
        <Suspense>
          <Rewind />
        </Suspense>
      ) : (
        <Timeline />
      )}
    </footer>
  );
}
