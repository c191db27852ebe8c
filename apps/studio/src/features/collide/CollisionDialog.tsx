import { brakingDistance_m, COLLISION_BEHAVIOURS, hardBrakingTime_s, type Robot } from "@twincell/core";
import { useStore } from "zustand";
import { learnMatrix } from "../../runtime/planning/planning.ts";
import { cellStore } from "../../stores/cell.ts";
import { chooseBehaviour, collideStore } from "../../stores/collide.ts";
import { closeDialog, dialogStore } from "../../stores/dialogs.ts";
import { commit, robotOf } from "../../stores/document.ts";
import { showNumber } from "../../ui/expression.ts";
import { Frame } from "../../ui/Frame.tsx";
import { NumberField } from "../../ui/NumberField.tsx";
import { words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";
import { PairTable } from "./PairTable.tsx";
import "./collide.css";

/** What the hand guard keeps from the cell [m]. */
const KEPT_M = 0.002;

/**
 * What happens where something would touch, what that rests on, and which parts of the robot are checked against which.
 */
export default function CollisionDialog() {
  const open = useStore(dialogStore, state => state.open === "collision");
  const robot = useStore(cellStore, state => robotOf(state.document));
  return (
    <Frame open={open} title={words.collide.title} onClose={closeDialog} width={720}>
      {open && robot && <Body robot={robot} />}
    </Frame>
  );
}

/** What of the cell is not known better, as it was measured (row T-64): counted in every distance. */
function Errors() {
  const errors = useStore(cellStore, state => state.document?.errors);
  const shape_m = useStore(cellStore, state => robotOf(state.document)?.shapeError_m ?? 0);
  const set = (which: "registration_m" | "twin_m", value_m: number): void => {
    commit(words.undo.errors, document => ({ ...document, errors: { ...document.errors, [which]: value_m } }), which);
  };
  const total_m = shape_m + (errors?.registration_m ?? 0) + (errors?.twin_m ?? 0);
  return (
    <fieldset className="collide-errors">
      <legend className="label">{words.collide.errors}</legend>
      {(["registration_m", "twin_m"] as const).map(which => (
        <div key={which} className="stack labelled">
          <span className="small muted" aria-hidden>
            {words.collide.errorNames[which]}
          </span>
          <NumberField
            label={words.collide.errorNames[which]}
            quantity="length"
            value={errors?.[which] ?? 0}
            min={0}
            max={0.5}
            decimals={1}
            onChange={value_m => set(which, value_m)}
          />
        </div>
      ))}
      <p className="small muted">{words.collide.errorsSum(showNumber(total_m, "length", 1))}</p>
    </fieldset>
  );
}

function Body({ robot }: { robot: Robot }) {
  const behaviour = useStore(collideStore, state => state.behaviour);
  const learning = useStore(collideStore, state => state.searching?.kind === "learn");
  const pairs = useStore(cellStore, state => state.document?.pairs);
  const tool = useStore(cellStore, state => state.document?.tool);
  const known = pairs?.robot === robot.id ? pairs : undefined;
  const mm = (length_m: number): string => showNumber(length_m, "length", 0);
  const braking_s = hardBrakingTime_s(robot);
  const facts = [
    [words.collide.kept, words.collide.keptSays(mm(KEPT_M))],
    [words.collide.shapeError, words.collide.keptSays(mm(robot.shapeError_m))],
    [
      words.collide.braking,
      words.collide.brakingSays(fixed(braking_s, 2), mm(brakingDistance_m(robot, robot.maxTcpSpeed_mps))),
    ],
  ] as const;
  return (
    <div className="stack collide">
      <fieldset className="collide-choice">
        <legend className="label">{words.collide.behaviour}</legend>
        {COLLISION_BEHAVIOURS.map(value => (
          <label key={value} className="collide-option" data-on={value === behaviour}>
            <input
              type="radio"
              name="collision-behaviour"
              value={value}
              checked={value === behaviour}
              onChange={() => chooseBehaviour(value)}
            />
            <span>
              <b>{words.collide.behaviours[value]}</b>
              <span className="small muted">{words.collide.says[value]}</span>
            </span>
          </label>
        ))}
      </fieldset>
      <dl className="facts">
        {facts.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
      <Errors />
      <p className="small muted">{words.collide.precision}</p>
      <section aria-label={words.collide.matrix} aria-busy={learning}>
        <div className="collide-head">
          <h3 className="label">{words.collide.matrix}</h3>
          <button className="btn tight" disabled={learning} onClick={learnMatrix}>
            {learning ? words.collide.learning : known ? words.collide.learn : words.collide.learnFirst}
          </button>
        </div>
        {known ? (
          <PairTable pairs={known} stale={known.tool !== tool} />
        ) : (
          <p className="small muted">{words.collide.matrixNone}</p>
        )}
      </section>
    </div>
  );
}
