import { catalogueRobots, LIBRARY, type Robot } from "@twincell/core";
import { useEffect, useMemo, useState } from "react";
import { useStore } from "zustand";
import { loadCatalogue } from "../../stores/catalogue.ts";
import { cellStore } from "../../stores/cell.ts";
import { controlStore } from "../../stores/control.ts";
import { runCommand } from "../../stores/commands.ts";
import { closeDialog, dialogStore, openDialog } from "../../stores/dialogs.ts";
import { forgetRobotFile, ownRobotStore } from "../../stores/own-robots.ts";
import { changeRobot } from "../../stores/robot.ts";
import { notify } from "../../stores/notices.ts";
import { Chooser } from "../../ui/Choice.tsx";
import { showNumber } from "../../ui/expression.ts";
import { Frame } from "../../ui/Frame.tsx";
import { words } from "../../messages/index.ts";
import { ANY_ROBOT, fittingRobots, makersOf } from "./choose.ts";
import { Details } from "./Details.tsx";
import { Picture } from "./Picture.tsx";
import "./robots.css";

const ANY = "any";
const REACHES_MM = [500, 800, 1000, 1500, 2000, 2500];
const PAYLOADS_KG = [1, 3, 5, 10];

/** Another robot for the cell: all of library and catalogue, by words, maker, reach and payload. */
export default function Robots() {
  const open = useStore(dialogStore, state => state.open === "robots");
  return open ? <Open /> : null;
}

const noneWords = (search: string): string =>
  search.trim() === "" ? words.robots.noneAlike : words.robots.none(search);
const foundWords = (found: number, of: number): string =>
  found === of ? words.robots.foundAll(of) : words.robots.found(found, of);
const payloadWords = (kg: number | undefined): string =>
  kg === undefined ? words.robots.payloadUnknown : words.robots.payload(kg);

function Open() {
  const here = useStore(cellStore, state => state.document?.robot.id ?? "");
  const running = useStore(controlStore, state => state.running);
  const [chosen, setChosen] = useState(here);
  const [wish, setWish] = useState(ANY_ROBOT);
  const [robots, setRobots] = useState(() => [...LIBRARY, ...catalogueRobots()]);
  const own = useStore(ownRobotStore, state => state.robots);
  useEffect(() => {
    loadCatalogue().then(
      () => setRobots([...LIBRARY, ...catalogueRobots()]),
      (fault: unknown) =>
        notify("warn", words.robots.noCatalogue(fault instanceof Error ? fault.message : String(fault))),
    );
  }, []);
  const all = useMemo(() => [...own, ...robots], [own, robots]);
  const makers = useMemo(() => makersOf(all).filter(maker => maker !== ""), [all]);
  const found = useMemo(() => fittingRobots(all, wish), [all, wish]);
  const robot = found.find(each => each.id === chosen) ?? found[0];
  const forget = (gone: Robot): void => {
    forgetRobotFile(gone.id).then(
      () => notify("done", words.own.removed(gone.name)),
      (fault: unknown) => notify("bad", words.cells.failed(fault instanceof Error ? fault.message : String(fault))),
    );
  };
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
            value={wish.search}
            onChange={event => setWish({ ...wish, search: event.currentTarget.value })}
          />
          <div className="robots-wishes">
            <Chooser
              label={words.robots.vendor}
              value={wish.maker === "" ? ANY : wish.maker}
              onChange={maker => setWish({ ...wish, maker: maker === ANY ? "" : maker })}
              options={[
                { value: ANY, words: words.robots.anyMaker },
                ...makers.map(maker => ({ value: maker, words: maker })),
              ]}
            />
            <Chooser
              label={words.inspector.reach}
              value={String(wish.reach_m)}
              onChange={reach => setWish({ ...wish, reach_m: Number(reach) })}
              options={[
                { value: "0", words: words.robots.anyReach },
                ...REACHES_MM.map(mm => ({ value: String(mm / 1000), words: words.robots.reachFrom(mm) })),
              ]}
            />
            <Chooser
              label={words.inspector.payload}
              value={String(wish.payload_kg)}
              onChange={payload => setWish({ ...wish, payload_kg: Number(payload) })}
              options={[
                { value: "0", words: words.robots.anyPayload },
                ...PAYLOADS_KG.map(kg => ({ value: String(kg), words: words.robots.payloadFrom(kg) })),
              ]}
            />
          </div>
          <p className="dim small" role="status">
            {found.length === 0 ? noneWords(wish.search) : foundWords(found.length, all.length)}
          </p>
          <div className="robots-own">
            <button
              type="button"
              className="btn small"
              title={words.own.addHint}
              onClick={() => {
                closeDialog();
                runCommand("file.load");
              }}
            >
              {words.own.add}
            </button>
            <button type="button" className="btn small" onClick={() => openDialog("dh-table")}>
              {words.own.typed}
            </button>
            <span className="dim small">{words.own.addHint}</span>
          </div>
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
                <Picture robot={each} width={56} height={56} />
                <span className="robot-words">
                  <b translate="no">{each.name}</b>
                  <span className="dim small">
                    {words.robots.facts(
                      each.arm.joints.length,
                      payloadWords(each.payload_kg),
                      showNumber(each.reach_m, "length", 0),
                    )}
                  </span>
                </span>
                {each.id === here && <span className="tag">{words.robots.here}</span>}
                {own.includes(each) && <span className="tag">{words.own.tag}</span>}
                {each.unverified && <span className="tag robot-made-up">{words.robots.unverified}</span>}
                {each.madeUpGeometry && <span className="tag robot-made-up">{words.robots.madeUp}</span>}
              </label>
            ))}
          </div>
        </div>
        {robot && <Details robot={robot} onRemove={own.includes(robot) && robot.id !== here ? forget : null} />}
      </form>
    </Frame>
  );
}
