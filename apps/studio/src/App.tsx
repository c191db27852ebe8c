import { Tooltip } from "radix-ui";
import { lazy, Suspense, useEffect } from "react";
import { useStore } from "zustand";
import { Check } from "./features/check/Check.tsx";
import { Coach } from "./features/coach/Coach.tsx";
import { Files } from "./features/files/Files.tsx";
import { ControlsDialog } from "./features/input/ControlsDialog.tsx";
import { GamepadWatch } from "./features/input/GamepadWatch.tsx";
import { Shortcuts } from "./features/input/Shortcuts.tsx";
import { Inspector } from "./features/inspector/Inspector.tsx";
import { Notices } from "./features/notices/Notices.tsx";
import { Overlay } from "./features/overlay/Overlay.tsx";
import { Physics } from "./features/physics/Physics.tsx";
import { Palette } from "./features/palette/Palette.tsx";
import { Pendant } from "./features/pendant/Pendant.tsx";
import { SavedPoses } from "./features/poses/SavedPoses.tsx";
import { Timeline } from "./features/timeline/Timeline.tsx";
import { TopBar } from "./features/topbar/TopBar.tsx";
import { TracePanel } from "./features/trace/TracePanel.tsx";
import { Tree } from "./features/tree/Tree.tsx";
import { Welcome } from "./features/welcome/Welcome.tsx";
import { Sheet } from "./Sheet.tsx";
import { SceneGuard } from "./SceneGuard.tsx";
import { traceStore } from "./stores/trace.ts";
import { viewStore } from "./stores/view.ts";
import { PHONE, useMedia } from "./ui/useMedia.ts";
import { words } from "./words/index.ts";
import "./app.css";

const Viewport = lazy(() => import("./scene/Viewport.tsx").then(scene => ({ default: scene.Viewport })));
const Export = lazy(() => import("./features/export/Export.tsx"));
const CollisionDialog = lazy(() => import("./features/collide/CollisionDialog.tsx"));
const ShapeDialog = lazy(() => import("./features/shapes/ShapeDialog.tsx"));
const Robots = lazy(() => import("./features/robots/Robots.tsx"));
const AddStation = lazy(() => import("./features/stations/AddStation.tsx"));
const Cameras = lazy(() => import("./features/video/Cameras.tsx"));
const VideoPanels = lazy(() => import("./features/video/VideoPanels.tsx"));
const Stations = lazy(() => import("./features/stations/Stations.tsx").then(part => ({ default: part.Stations })));
const Run = lazy(() => import("./features/run/Run.tsx"));
const History = lazy(() => import("./features/history/History.tsx"));
const Rewind = lazy(() => import("./features/history/Rewind.tsx"));

/** The shell: four modes around one scene. Nothing here changes many times a second. */
export function App() {
  const phone = useMedia(PHONE);
  const theme = useStore(viewStore, state => state.theme);
  useEffect(() => {
    document.documentElement.dataset.theme = theme;
  }, [theme]);
  return (
    <Tooltip.Provider delayDuration={500}>
      <div className="app" data-layout={phone ? "phone" : "desk"}>
        <a className="skip-link" href="#program">
          {words.app.skip}
        </a>
        <TopBar key="top" phone={phone} />
        {!phone && (
          <nav key="left" className="panel area-left" aria-label={words.app.region.cell}>
            <Tree />
            <Honest />
          </nav>
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
          <Physics />
          <Suspense>
            <VideoPanels />
          </Suspense>
          {!phone && <Coach />}
          <Welcome />
          <Notices />
          <span className="visually-hidden" id="reorder-hint">
            {words.tree.reorderHint}
          </span>
        </main>
        {phone ? (
          <Sheet key="sheet" />
        ) : (
          <>
            <aside key="right" className="panel area-right" aria-label={words.app.region.side}>
              <div className="scroll">
                <RightSide />
              </div>
            </aside>
            <BottomSide key="bottom" />
          </>
        )}
        <Palette />
        <ControlsDialog />
        <Suspense>
          <Export />
        </Suspense>
        <Suspense>
          <Robots />
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
          <Cameras />
        </Suspense>
        <Files />
        <Shortcuts />
        <GamepadWatch />
      </div>
    </Tooltip.Provider>
  );
}

const Honest = () => (
  <p className="honest" title={words.app.notSafetyHint}>
    {words.app.notSafety}
  </p>
);

function RightSide() {
  const mode = useStore(viewStore, state => state.mode);
  const tracing = useStore(traceStore, state => state.active);
  switch (mode) {
    case "teach":
      return (
        <>
          {tracing && <TracePanel />}
          <Pendant />
          <SavedPoses />
          <Inspector />
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
/** In History the time is that of the open run. */
function BottomSide() {
  const history = useStore(viewStore, state => state.mode === "history");
  return (
    <footer className="area-bottom" aria-label={words.app.region.time}>
      {history ? (
        <Suspense>
          <Rewind />
        </Suspense>
      ) : (
        <Timeline />
      )}
    </footer>
  );
}
