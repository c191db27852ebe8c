import { robotById } from "@twincell/core";
import { useStore } from "zustand";
import { importAsParts, takeRobot } from "../../runtime/mesh-import.ts";
import { closeDialog, dialogStore } from "../../stores/dialogs.ts";
import { shapeStore, type FoundRobot } from "../../stores/shapes.ts";
import { showNumber } from "../../ui/expression.ts";
import { Frame } from "../../ui/Frame.tsx";
import { say, words } from "../../messages/index.ts";
import { Picture } from "./Picture.tsx";
import "./robots.css";

/** A robot was read from a file: what it is, what had to be assumed, and whether it becomes the robot of the cell. */
export default function RobotQuestion() {
  const open = useStore(dialogStore, state => state.open === "own-robot");
  const found = useStore(shapeStore, state => state.robot);
  return open && found ? <Question found={found} /> : null;
}

function Question({ found }: { readonly found: FoundRobot }) {
  const robot = robotById(found.file.id);
  if (!robot) return null;
  const facts = [
    words.own.axes(robot.arm.joints.length),
    robot.family.kind === "general" ? words.own.numerical : words.own.closedForm,
    `${words.inspector.reach} ${showNumber(robot.reach_m, "length", 0)} mm`,
    robot.links === undefined ? words.own.plain : words.own.drawn,
  ];
  return (
    <Frame
      open
      title={words.own.question(found.name)}
      onClose={closeDialog}
      width={640}
      foot={
        <>
          <span className="small muted grow">{words.own.keeps}</span>
          {found.hasParts && (
            <button className="btn" onClick={() => void importAsParts()}>
              {words.own.asParts}
            </button>
          )}
          <button className="btn primary" autoFocus onClick={takeRobot}>
            {words.own.asRobot}
          </button>
        </>
      }
    >
      <div className="robot-question">
        <Picture robot={robot} width={240} height={240} />
        <div className="stack">
          <h3 translate="no">{robot.name}</h3>
          <p>{facts.join(" · ")}</p>
          <h4 className="label">{words.own.notes}</h4>
          {found.notes.length === 0 ? (
            <p className="small muted">{words.own.noNotes}</p>
          ) : (
            <ul className="notes small">
              {found.notes.map(note => (
                <li key={note}>{say(note)}</li>
              ))}
            </ul>
          )}
        </div>
      </div>
    </Frame>
  );
}
