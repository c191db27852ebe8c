import { useStore } from "zustand";
import { cellStore } from "../../stores/cell.ts";
import { objectOf, programOf } from "../../stores/document.ts";
import { findStep } from "../../stores/program.ts";
import { selectionStore } from "../../stores/selection.ts";
import { words } from "../../messages/index.ts";
import { FrameInspector } from "./FrameInspector.tsx";
import { ObjectInspector } from "./ObjectInspector.tsx";
import { RobotInspector } from "./RobotInspector.tsx";
import { RoutineInspector } from "./RoutineInspector.tsx";
import { StepInspector } from "./StepInspector.tsx";
import { ToolInspector } from "./ToolInspector.tsx";
import "./inspector.css";

/** The numbers of what is selected, each of them editable where it may be changed. */
export function Inspector() {
  const selected = useStore(selectionStore, state => state.selected);
  const document = useStore(cellStore, state => state.document);
  if (!document || !selected) return <p className="empty">{words.inspector.nothing}</p>;
  switch (selected.kind) {
    case "robot":
    case "link":
      return <RobotInspector document={document} />;
    case "tool":
      return <ToolInspector document={document} />;
    case "frame":
      return <FrameInspector document={document} name={selected.name} />;
    case "object": {
      const object = objectOf(document, selected.id);
      return object ? (
        <ObjectInspector key={object.id} object={object} />
      ) : (
        <p className="empty">{words.inspector.nothing}</p>
      );
    }
    case "routine": {
      const program = programOf(document);
      return program && Object.hasOwn(program.routines, selected.name) ? (
        <RoutineInspector key={selected.name} program={program} name={selected.name} />
      ) : (
        <p className="empty">{words.inspector.nothing}</p>
      );
    }
    case "step": {
      const program = programOf(document);
      const found = program ? findStep(program, selected.id) : undefined;
      return found && program ? (
        <StepInspector key={found.step.id} program={program} step={found.step} index={found.index} />
      ) : (
        <p className="empty">{words.inspector.nothing}</p>
      );
    }
  }
}
