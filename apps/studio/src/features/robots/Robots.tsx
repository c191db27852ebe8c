import { LIBRARY, type Robot } from "@twincell/core";
import { useMemo, useState } from "react";
import { useStore } from "zustand";
import { cellStore } from "../../stores/cell.ts";
import { controlStore } from "../../stores/control.ts";
import { closeDialog, dialogStore } from "../../stores/dialogs.ts";
import { changeRobot } from "../../stores/robot.ts";
import { showNumber } from "../../ui/expression.ts";
import { Frame } from "../../ui/Frame.tsx";
import { words } from "../../messages/index.ts";
import { robotPicture } from "./picture.ts";
import "./robots.css";

/** Another robot for the cell: all of the library, searchable. */
export default function Robots() {
  const open = useStore(dialogStore, state => state.open === "robots");
  return open ? <Open /> : null;
}

function Open() {
  const here = useStore(cellStore, state => state.document?.robot.id ?? "");
  const running = useStore(controlStore, state => state.running);
  const [chosen, setChosen] = useState(here);
  const [search, setSearch] = useState("");
  const found = useMemo(() => LIBRARY.filter(robot => matches(robot, search)), [search]);
  const robot = found.find(each => each.id === chosen) ?? found[0];
  const use = (): void => {
    if (!robot || running) return;
    closeDialog();
    changeRobot(robot.id);
  };
  return (
    <Frame
      open
      title={words.robots.title}
      onClose={closeDialog}
      width={900}
      foot={
        <>
          <span className="small muted grow">
            {running ? words.robots.busy : robot?.id === here ? words.robots.already : words.robots.keeps}
          </span>
          <button className="btn primary" disabled={!robot || running || robot.id === here} onClick={use}>
            {robot ? words.robots.use(robot.name) : words.robots.useNone}
          </button>
        </>
      }
    >
      <form
        className="robots"
        onSubmit={event => {
          event.preventDefault();
          use();
        }}
      >
        <div className="robots-list stack">
          <input
            className="palette-input"
            type="search"
            autoFocus
            aria-label={words.robots.search}
            placeholder={words.robots.search}
            value={search}
            onChange={event => setSearch(event.currentTarget.value)}
          />
          {found.length === 0 && <p className="empty">{words.robots.none(search)}</p>}
          <div role="radiogroup" aria-label={words.robots.title} className="robots-cards">
            {found.map(each => (
              <label key={each.id} className="robot-card" data-on={each.id === robot?.id} onDoubleClick={use}>
                <input
                  className="visually-hidden"
                  type="radio"
                  name="robot"
                  value={each.id}
                  checked={each.id === robot?.id}
                  onChange={() => setChosen(each.id)}
                />
                <Picture robot={each} />
                <span className="robot-words">
                  <b>{each.name}</b>
                  <span className="dim small">
                    {words.robots.facts(each.arm.joints.length, each.payload_kg, showNumber(each.reach_m, "length", 0))}
                  </span>
                </span>
                {each.id === here && <span className="tag">{words.robots.here}</span>}
                {each.madeUpGeometry && <span className="tag robot-made-up">{words.robots.madeUp}</span>}
              </label>
            ))}
          </div>
        </div>
        {robot && <Details robot={robot} />}
      </form>
    </Frame>
  );
}

const matches = (robot: Robot, search: string): boolean =>
  search
    .toLowerCase()
    .split(/\s+/)
    .every(part =>
      `${robot.name} ${robot.vendor} ${robot.id} ${words.tree.axes(robot.arm.joints.length)}`
        .toLowerCase()
        .includes(part),
    );

function Details({ robot }: { readonly robot: Robot }) {
  return (
    <section className="robots-details stack" aria-label={robot.name} aria-live="polite">
      <Picture robot={robot} />
      <h3>{robot.name}</h3>
      {robot.madeUpGeometry && (
        <p className="export-proof">
          <i className="mark" data-verdict="warn" aria-hidden />
          {words.robots.madeUpSays}
        </p>
      )}
      <dl className="facts">
        <div>
          <dt>{words.robots.vendor}</dt>
          <dd>{robot.vendor}</dd>
        </div>
        <div>
          <dt>{words.robots.axes}</dt>
          <dd>{robot.arm.joints.length}</dd>
        </div>
        <div>
          <dt>{words.inspector.payload}</dt>
          <dd>{robot.payload_kg} kg</dd>
        </div>
        <div>
          <dt>{words.inspector.reach}</dt>
          <dd>{showNumber(robot.reach_m, "length", 0)} mm</dd>
        </div>
        <div>
          <dt>{words.inspector.repeatability}</dt>
          <dd>±{showNumber(robot.repeatability_m, "length", 3)} mm</dd>
        </div>
        <div>
          <dt>{words.inspector.shapeError}</dt>
          <dd>{showNumber(robot.shapeError_m, "length", 0)} mm</dd>
        </div>
      </dl>
      {robot.assumptions.length > 0 && (
        <>
          <h4 className="dim small">{words.inspector.assumptions}</h4>
          <ul className="notes small">
            {robot.assumptions.map(says => (
              <li key={says}>{says}</li>
            ))}
          </ul>
        </>
      )}
    </section>
  );
}

function Picture({ robot }: { readonly robot: Robot }) {
  const { viewBox, bones, joints, width } = useMemo(() => robotPicture(robot), [robot]);
  return (
    <svg className="robot-picture" viewBox={viewBox} aria-hidden>
      <path
        d={bones}
        fill="none"
        stroke={robot.paint?.casting ?? "#eaa50c"}
        strokeWidth={width}
        strokeLinecap="round"
        strokeLinejoin="round"
      />
      {joints.map(([x, y], i) => (
        <circle key={i} cx={x} cy={y} r={0.34 * width} fill={robot.paint?.dark ?? "var(--bg)"} />
      ))}
    </svg>
  );
}
