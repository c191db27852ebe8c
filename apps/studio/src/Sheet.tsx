import { Tabs } from "radix-ui";
import { lazy, Suspense } from "react";
import { useStore } from "zustand";
import { Check } from "./features/check/Check.tsx";
import { Inspector } from "./features/inspector/Inspector.tsx";
import { PhoneTeach } from "./features/phone-teach/PhoneTeach.tsx";
import { Pendant } from "./features/pendant/Pendant.tsx";
import { SavedPoses } from "./features/poses/SavedPoses.tsx";
import { TextSide } from "./features/text/TextSide.tsx";
import { ProgramSwitch } from "./features/tree/ProgramSwitch.tsx";
import { Timeline } from "./features/timeline/Timeline.tsx";
import { TracePanel } from "./features/trace/TracePanel.tsx";
import { Tree } from "./features/tree/Tree.tsx";
import { cellStore } from "./stores/cell.ts";
import { textOf } from "./stores/document.ts";
import { traceStore } from "./stores/trace.ts";
import { showMode, viewStore, type SheetTab, type StudioMode } from "./stores/view.ts";
import { Segments } from "./ui/Choice.tsx";
import { useMedia } from "./ui/useMedia.ts";
import { words } from "./messages/index.ts";

const Stations = lazy(() => import("./features/stations/Stations.tsx").then(part => ({ default: part.Stations })));
const TextPanel = lazy(() => import("./features/text/TextPanel.tsx"));
const Run = lazy(() => import("./features/run/Run.tsx"));
const History = lazy(() => import("./features/history/History.tsx"));
const Rewind = lazy(() => import("./features/history/Rewind.tsx"));
const TABS: readonly SheetTab[] = ["jog", "program", "why", "run"];
const MODE: Readonly<Record<SheetTab, StudioMode>> = { jog: "teach", program: "teach", why: "check", run: "run" };
const isTab = (value: string): value is SheetTab => TABS.some(tab => tab === value);

/** The phone's bottom sheet: jog, program, why, run. */
export function Sheet() {
  const tab = useStore(viewStore, state => state.sheet);
  const tracing = useStore(traceStore, state => state.active);
  const mode = useStore(viewStore, state => state.mode);
  const text = useStore(cellStore, state => textOf(state.document));
  const touch = useMedia("(pointer: coarse)");
  return (
    <Tabs.Root
      className="area-sheet"
      value={tab}
      onValueChange={value => {
        if (isTab(value)) {
          viewStore.setState({ sheet: value });
          showMode(MODE[value]);
        }
      }}
    >
      <Tabs.List className="sheet-tabs" aria-label={words.sheet.label}>
        {TABS.map(each => (
          <Tabs.Trigger key={each} className="sheet-tab" value={each}>
            {words.sheet[each]}
          </Tabs.Trigger>
        ))}
      </Tabs.List>
      <Tabs.Content value="jog" className="scroll sheet-body" tabIndex={-1}>
        {tracing && <TracePanel />}
        {touch && !text && <PhoneTeach />}
        <Pendant />
        <SavedPoses />
      </Tabs.Content>
      <Tabs.Content value="program" className="sheet-body sheet-program" tabIndex={-1}>
        {text ? (
          <div className="text-sheet">
            <TextSide text={text}>
              <ProgramSwitch />
            </TextSide>
            <Suspense>
              <TextPanel />
            </Suspense>
          </div>
        ) : (
          <>
            <Tree />
            <div className="scroll">
              <Inspector />
            </div>
          </>
        )}
      </Tabs.Content>
      <Tabs.Content value="why" className="scroll sheet-body" tabIndex={-1}>
        <Check />
        <Timeline />
      </Tabs.Content>
      <Tabs.Content value="run" className="scroll sheet-body" tabIndex={-1}>
        <Suspense>
          <Segments
            label={words.mode.label}
            value={mode === "history" ? "history" : "run"}
            onChange={showMode}
            options={[
              { value: "run", words: words.mode.run },
              { value: "history", words: words.mode.history },
            ]}
            className="seg fill sheet-seg"
          />
          {mode === "history" ? (
            <>
              <Rewind />
              <History />
            </>
          ) : (
            <>
              <Run />
              <Stations />
              <Timeline />
            </>
          )}
        </Suspense>
      </Tabs.Content>
    </Tabs.Root>
  );
}
