import { Axis3d, Combine, Magnet, MousePointer2, Move3d, Rotate3d, Ruler, Scale3d, Workflow } from "lucide-react";
import type { ReactNode } from "react";
import { useStore } from "zustand";
import { buildStore, chooseTool, type BuildState, type BuildTool } from "../../stores/build.ts";
import { runCommand } from "../../stores/commands.ts";
import { Chooser } from "../../ui/Choice.tsx";
import { showNumber } from "../../ui/expression.ts";
import { Tip } from "../../ui/Tip.tsx";
import { words } from "../../messages/index.ts";
import "./build.css";

const TOOLS: readonly { readonly tool: BuildTool; readonly glyph: ReactNode; readonly keys?: string }[] = [
  { tool: "select", glyph: <MousePointer2 /> },
  { tool: "move", glyph: <Move3d />, keys: "W" },
  { tool: "turn", glyph: <Rotate3d />, keys: "E" },
  { tool: "scale", glyph: <Scale3d />, keys: "R" },
  { tool: "measure", glyph: <Ruler />, keys: "M" },
  { tool: "mate", glyph: <Combine />, keys: "J" },
  { tool: "rig", glyph: <Workflow /> },
];
const GRIDS_M = [0, 0.001, 0.005, 0.01, 0.05, 0.1] as const;
const DISPLAYS: readonly BuildState["display"][] = ["smooth", "flat", "wire", "points"];
const NO_SECTION = "none";
const SECTIONS_M = [0.25, 0.5, 0.75, 1, 1.5, 2] as const;
const gridWords = (grid_m: number): string =>
  grid_m === 0 ? words.build.noGrid : `${showNumber(grid_m, "length", 0)} mm`;

/** One bar over the view: with what objects are moved, and onto what they snap. */
export function ToolBar() {
  const { tool, snap, grid_m, space, display, section_m } = useStore(buildStore);
  return (
    <div className="build-bar float" role="toolbar" aria-label={words.build.bar}>
      {TOOLS.map(each => (
        <Tip
          key={each.tool}
          words={words.build.tools[each.tool]}
          {...(each.keys === undefined ? {} : { keys: each.keys })}
        >
          <button
            className="btn quiet icon"
            aria-label={words.build.tools[each.tool]}
            aria-pressed={tool === each.tool}
            onClick={() => chooseTool(each.tool)}
          >
            {each.glyph}
          </button>
        </Tip>
      ))}
      <i className="build-line" aria-hidden />
      <Tip words={words.build.snapTip} keys="S">
        <button
          className="btn quiet icon"
          aria-label={words.build.snap}
          aria-pressed={snap}
          onClick={() => runCommand("build.snap")}
        >
          <Magnet />
        </button>
      </Tip>
      <Chooser
        label={words.build.grid}
        value={String(grid_m)}
        options={GRIDS_M.map(each => ({ value: String(each), words: gridWords(each) }))}
        onChange={value => buildStore.setState({ grid_m: Number(value) })}
      />
      <Tip words={space === "world" ? words.build.world : words.build.local} keys="L">
        <button
          className="btn quiet icon"
          aria-label={words.build.local}
          aria-pressed={space === "local"}
          onClick={() => runCommand("build.space")}
        >
          <Axis3d />
        </button>
      </Tip>
      <Chooser<BuildState["display"]>
        label={words.build.display}
        value={display}
        options={DISPLAYS.map(value => ({ value, words: words.build.displays[value] }))}
        onChange={value => buildStore.setState({ display: value })}
      />
      <Chooser
        label={words.build.section}
        value={String(section_m ?? NO_SECTION)}
        options={[
          { value: NO_SECTION, words: words.build.noSection },
          ...SECTIONS_M.map(at_m => ({
            value: String(at_m),
            words: words.build.sectionAt(showNumber(at_m, "length", 0)),
          })),
        ]}
        onChange={value => buildStore.setState({ section_m: value === NO_SECTION ? null : Number(value) })}
      />
    </div>
  );
}
