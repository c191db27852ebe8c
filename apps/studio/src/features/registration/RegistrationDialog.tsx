import {
  compose,
  distance,
  inverse,
  registrationBound,
  TIP_NOISE,
  transformPoint,
  watchDrift,
  type RegisteredBase,
  type Vector3,
} from "@twincell/core";
import { Check, Crosshair, Trash2 } from "lucide-react";
import { useMemo } from "react";
import { useStore } from "zustand";
import { theLive } from "../../runtime/live.ts";
import { cellStore } from "../../stores/cell.ts";
import { closeDialog, dialogStore } from "../../stores/dialogs.ts";
import {
  addRegistrationPoint,
  applyRegistration,
  changeRegistrationPoint,
  keptError,
  MAX_POINTS,
  registrationOf,
  registrationStore,
  removeRegistrationPoint,
  type RegistrationPoint,
} from "../../stores/registration.ts";
import { showNumber } from "../../ui/expression.ts";
import { Frame } from "../../ui/Frame.tsx";
import { NumberField } from "../../ui/NumberField.tsx";
import { say, words } from "../../messages/index.ts";
import "./registration.css";

const SAID = words.registration;
const AXES = ["X", "Y", "Z"] as const;
const MIN_TOUCH_M = 0.00001;
const MAX_TOUCH_M = 0.05;

/** Where a real robot stands in the cell: its tip is driven to points whose places are known. */
export default function RegistrationDialog() {
  const open = useStore(dialogStore, state => state.open === "registration");
  return (
    <Frame open={open} title={SAID.title} onClose={closeDialog} width={640}>
      {open && <Body />}
    </Frame>
  );
}

function Body() {
  const state = useStore(registrationStore);
  const answer = useMemo(() => registrationOf(state), [state]);
  const registered = answer.kind === "registered" ? answer : null;
  const bound_m = registered ? largestBound(registered, state.points) : null;
  const kept_m = useStore(cellStore, ({ document }) => document?.errors?.registration_m ?? 0);
  const at_s = (): number => performance.now() / 1000;
  const check = (point: RegistrationPoint): void => {
    const worldFromBase = cellStore.getState().document?.robot.worldFromBase;
    if (!registered || !worldFromBase) return;
    const { position } = compose(inverse(worldFromBase), theLive().worldFromTcp);
    const touch = { base: position, world: point.world, at_s: registered.at_s };
    // What is judged is where the cell has the robot, with what these points can tell.
    const placed = { ...registered, worldFromBase };
    const { sentence } = watchDrift(placed, touch, { ...TIP_NOISE, position_m: state.touch_m });
    registrationStore.setState({ checked: sentence });
  };
  return (
    <div className="stack registration">
      <p className="small">{SAID.says}</p>
      {state.points.length > 0 && (
        <table className="registration-points">
          <thead>
            <tr>
              <th scope="col">{SAID.point}</th>
              {AXES.map(axis => (
                <th scope="col" key={axis}>
                  {SAID.axis(axis)}
                </th>
              ))}
              <th scope="col">{SAID.off}</th>
              <td />
            </tr>
          </thead>
          <tbody>
            {state.points.map((point, i) => (
              <Row key={point.id} point={point} number={i + 1} registered={registered} onCheck={() => check(point)} />
            ))}
          </tbody>
        </table>
      )}
      <div className="row-flex registration-tools">
        <button
          className="btn"
          disabled={state.points.length >= MAX_POINTS}
          onClick={() => addRegistrationPoint(theLive().worldFromTcp, at_s())}
        >
          <Crosshair />
          {SAID.add}
        </button>
        <label className="registration-noise small">
          <span aria-hidden>{SAID.touch}</span>
          <NumberField
            label={SAID.touch}
            quantity="length"
            value={state.touch_m}
            min={MIN_TOUCH_M}
            max={MAX_TOUCH_M}
            decimals={2}
            onChange={touch_m => registrationStore.setState({ touch_m })}
          />
        </label>
      </div>
      <p role="status" className="registration-answer" data-kind={answer.kind}>
        {say(answer.sentence)}
        {bound_m !== null && <b> {SAID.bound(showNumber(keptError(bound_m), "length", 1))}</b>}
      </p>
      {state.checked !== "" && (
        <p role="status" className="small registration-checked">
          {say(state.checked)}
        </p>
      )}
      <p className="small muted">{SAID.kept(showNumber(kept_m, "length", 1))}</p>
      <button
        className="btn primary"
        disabled={!registered}
        onClick={() => {
          if (registered && bound_m !== null) applyRegistration(registered.worldFromBase, bound_m);
        }}
      >
        <Check />
        {SAID.apply}
      </button>
    </div>
  );
}

const ORIGIN: Vector3 = [0, 0, 0];
/** The largest at the base and at the points: between them the robot works. */
const largestBound = (registered: RegisteredBase, points: readonly RegistrationPoint[]): number =>
  Math.max(
    ...[ORIGIN, ...points.map(({ base }) => base)].map(point => registrationBound(registered, point, registered.at_s)),
  );

function Row({
  point,
  number,
  registered,
  onCheck,
}: {
  readonly point: RegistrationPoint;
  readonly number: number;
  readonly registered: RegisteredBase | null;
  readonly onCheck: () => void;
}) {
  const name = SAID.pointOf(number);
  const off = registered
    ? showNumber(distance(point.world, transformPoint(registered.worldFromBase, point.base)), "length", 2)
    : "–";
  return (
    <tr>
      <th scope="row">{number}</th>
      {AXES.map((axis, i) => (
        <td key={axis}>
          <NumberField
            label={`${name}, ${axis}`}
            quantity="length"
            value={point.world[i]!}
            decimals={2}
            unitAbove
            onChange={value_m => changeRegistrationPoint(point.id, i, value_m)}
          />
        </td>
      ))}
      <td className="registration-off">{off}</td>
      <td className="registration-buttons">
        <button className="btn quiet tight" disabled={!registered} title={SAID.againTip} onClick={onCheck}>
          {SAID.again}
        </button>
        <button
          className="btn quiet icon"
          aria-label={SAID.remove(number)}
          onClick={() => removeRegistrationPoint(point.id)}
        >
          <Trash2 />
        </button>
      </td>
    </tr>
  );
}
