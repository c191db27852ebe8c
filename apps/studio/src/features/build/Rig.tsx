import { ArrowLeftRight, Trash2, X } from "lucide-react";
import { useStore } from "zustand";
import { finishRig } from "../../runtime/rig.ts";
import { chooseTool } from "../../stores/build.ts";
import { cellStore } from "../../stores/cell.ts";
import {
  changeAxis,
  changeKind,
  linkOf,
  removeAxis,
  reverseAxis,
  rigName,
  rigObjects,
  rigStore,
  type RigAxis,
  type RigState,
} from "../../stores/rig.ts";
import { Chooser, Segments } from "../../ui/Choice.tsx";
import { showNumber } from "../../ui/expression.ts";
import { NumberField } from "../../ui/NumberField.tsx";
import { words } from "../../messages/index.ts";
import "./build.css";

const MOST_RAD = 20;
const MOST_M = 50;

/** A robot out of picked axes (T-52, N-05): joints in order with limits, links, flange, and what it becomes. */
export function Rig() {
  const state = useStore(rigStore);
  const document = useStore(cellStore, each => each.document);
  const { axes, picking, flange, busy } = state;
  if (!document) return null;
  return (
    <section aria-label={words.rig.title}>
      <h2 className="heading">
        <span className="grow">{words.rig.title}</span>
        <button className="btn quiet icon tight" aria-label={words.rig.close} onClick={() => chooseTool("select")}>
          <X />
        </button>
      </h2>
      <div className="section stack">
        <p className="small" role="status">
          {busy ? words.rig.working : picking === "flange" ? words.rig.pickFlange : words.rig.pickAxes}
        </p>
        <label className="stack">
          <span className="label">{words.rig.name}</span>
          <input
            className="rig-name"
            value={state.name}
            placeholder={rigName(state)}
            maxLength={60}
            onChange={event => rigStore.setState({ name: event.currentTarget.value })}
          />
        </label>
        <h3 className="label">{words.rig.axes}</h3>
        {axes.length === 0 && <p className="dim small">{words.rig.noAxes}</p>}
        <ol className="rig-axes">
          {axes.map((axis, i) => (
            <Axis key={axis.key} axis={axis} number={i + 1} />
          ))}
        </ol>
        {axes.length > 0 && (
          <>
            <Flange flange={flange} picking={picking} />
            <Links state={state} />
            <div className="pair">
              <span className="label">{words.rig.density}</span>
              <NumberField
                label={words.rig.density}
                mark={words.rig.densityMark}
                quantity="plain"
                decimals={0}
                min={1}
                max={25_000}
                value={state.density_kgm3}
                onChange={density_kgm3 => rigStore.setState({ density_kgm3 })}
              />
            </div>
            <button
              className="btn primary"
              title={words.rig.useSays}
              disabled={busy}
              onClick={() => void finishRig("cell")}
            >
              {words.rig.use}
            </button>
            <div className="rig-files">
              <button className="btn" disabled={busy} onClick={() => void finishRig("robot-file")}>
                {words.own.saveFile}
              </button>
              <button
                className="btn"
                title={words.own.saveUrdfSays}
                disabled={busy}
                onClick={() => void finishRig("urdf")}
              >
                {words.own.saveUrdf}
              </button>
            </div>
          </>
        )}
      </div>
    </section>
  );
}

function Axis({ axis, number }: { axis: RigAxis; number: number }) {
  const slides = axis.kind === "prismatic";
  const quantity = slides ? "length" : "angle";
  const most = slides ? MOST_M : MOST_RAD;
  const of = (what: string): string => words.rig.ofJoint(what, number);
  return (
    <li className="rig-axis">
      <div className="row-flex">
        <b className="rig-number">{number}</b>
        <input
          className="rig-name grow"
          aria-label={of(words.rig.name)}
          value={axis.name}
          maxLength={40}
          onChange={event => changeAxis(axis.key, { name: event.currentTarget.value })}
        />
        <span className="dim small num">{words.rig.diameter(showNumber(2 * axis.radius_m, "length", 1))}</span>
        <button
          className="btn quiet icon tight"
          aria-label={words.rig.reverse(number)}
          title={words.rig.reverse(number)}
          onClick={() => reverseAxis(axis.key)}
        >
          <ArrowLeftRight />
        </button>
        <button
          className="btn quiet icon tight"
          aria-label={words.rig.remove(number)}
          title={words.rig.remove(number)}
          onClick={() => removeAxis(axis.key)}
        >
          <Trash2 />
        </button>
      </div>
      <Segments
        label={of(words.rig.kind)}
        value={axis.kind}
        onChange={kind => changeKind(axis.key, kind)}
        options={[
          { value: "revolute", words: words.rig.turns },
          { value: "prismatic", words: words.rig.slides },
        ]}
      />
      <span className="dim small">{slides ? words.rig.unitsOfSlide : words.rig.unitsOfTurn}</span>
      <div className="fields-3">
        <NumberField
          label={of(words.rig.lower)}
          mark="⤓"
          quantity={quantity}
          unitAbove
          decimals={1}
          min={-most}
          max={axis.upper}
          value={axis.lower}
          onChange={lower => changeAxis(axis.key, { lower })}
        />
        <NumberField
          label={of(words.rig.upper)}
          mark="⤒"
          quantity={quantity}
          unitAbove
          decimals={1}
          min={axis.lower}
          max={most}
          value={axis.upper}
          onChange={upper => changeAxis(axis.key, { upper })}
        />
        <NumberField
          label={of(words.rig.speed)}
          mark="v"
          quantity={quantity}
          unitAbove
          decimals={0}
          min={1e-4}
          max={MOST_M}
          value={axis.speed}
          onChange={speed => changeAxis(axis.key, { speed })}
        />
      </div>
    </li>
  );
}

function Flange({ flange, picking }: Pick<RigState, "flange" | "picking">) {
  const mm = (value: number): string => showNumber(value, "length", 1);
  return (
    <>
      <div className="pair">
        <span className="label">{words.rig.flange}</span>
        <button
          className="btn small"
          aria-pressed={picking === "flange"}
          onClick={() => rigStore.setState({ picking: picking === "flange" ? "axis" : "flange" })}
        >
          {words.rig.chooseFlange}
        </button>
      </div>
      <p className="small num dim">
        {flange
          ? words.rig.flangeAt(mm(flange.at_m[0]), mm(flange.at_m[1]), mm(flange.at_m[2]))
          : words.rig.flangeAtLast}
      </p>
    </>
  );
}

/** Which link each part belongs to. */
function Links({ state }: { state: RigState }) {
  const document = useStore(cellStore, each => each.document);
  if (!document) return null;
  const options = [
    { value: "0", words: words.rig.base },
    ...state.axes.map((_, i) => ({ value: String(i + 1), words: words.rig.link(i + 1) })),
    { value: "-1", words: words.rig.notIn },
  ];
  return (
    <>
      <h3 className="label">{words.rig.parts}</h3>
      <ul className="rig-links">
        {rigObjects(document, state).map(({ id, name }) => (
          <li key={id} className="pair">
            <span className="rig-part" title={name}>
              {name}
            </span>
            <Chooser
              label={words.rig.linkOf(name)}
              value={String(linkOf(state, id))}
              options={options}
              onChange={link => rigStore.setState(({ links }) => ({ links: { ...links, [id]: Number(link) } }))}
            />
          </li>
        ))}
      </ul>
    </>
  );
}
