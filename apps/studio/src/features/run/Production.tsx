import { Hand, Play, Repeat, RotateCcw, StepForward, X } from "lucide-react";
import { useState } from "react";
import { useStore } from "zustand";
import type { CommandOutcome, Program } from "@twincell/core";
import { runCommand } from "../../stores/commands.ts";
import { cellStore } from "../../stores/cell.ts";
import { programOf } from "../../stores/document.ts";
import { productionStore } from "../../stores/production.ts";
import { findStep, stepWords } from "../../stores/program.ts";
import { askBeforeRun } from "../../runtime/run/ask-before-run.ts";
import {
  holdProduction,
  replaceProduction,
  resumeProduction,
  stepProduction,
  toggleBreakpoint,
} from "../../runtime/robot/station-production.ts";
import { selectionStore } from "../../stores/selection.ts";
import { stationStore, type StationState } from "../../stores/stations.ts";
import { Segments } from "../../ui/Choice.tsx";
import { NumberField } from "../../ui/NumberField.tsx";
import { say, words } from "../../messages/index.ts";

const nameOf = (program: Program | null, id: string): string => {
  const found = program && findStep(program, id);
  return found ? stepWords(found.step, found.index) : id;
};

/** A program of the connected robot cycle after cycle: begun, held, stepped, taken over by hand and handed back. */
export function Production({ id, disabled }: { readonly id: string; readonly disabled: boolean }) {
  const station = useStore(stationStore, ({ stations }) => stations.find(each => each.id === id));
  const [said, setSaid] = useState("");
  const tell = (outcome: Promise<CommandOutcome>): void => {
    setSaid("");
    void outcome.then(ended => setSaid(ended.kind === "done" ? "" : say(ended.why.sentence)));
  };
  if (!station) return null;
  return (
    <fieldset className="signals production" aria-label={words.production.title}>
      <legend className="small dim">{words.production.title}</legend>
      {station.production ? (
        <UnderWay station={station} production={station.production} tell={tell} />
      ) : (
        <Begin disabled={disabled || station.running} />
      )}
      <Breakpoints station={station} tell={tell} />
      <p className="small production-says" role="status">
        {said}
      </p>
    </fieldset>
  );
}

function Begin({ disabled }: { readonly disabled: boolean }) {
  const { cycles, count, isStepping } = useStore(productionStore);
  return (
    <>
      <Segments
        label={words.production.cycles}
        value={cycles}
        options={(["once", "several", "forever"] as const).map(value => ({
          value,
          words: words.production.howOften[value],
        }))}
        onChange={value => productionStore.setState({ cycles: value })}
      />
      {cycles === "several" && (
        <NumberField
          label={words.production.count}
          quantity="plain"
          decimals={0}
          value={count}
          min={1}
          max={1_000_000}
          onChange={value => productionStore.setState({ count: Math.round(value) })}
        />
      )}
      <label className="row-flex small">
        <input
          type="checkbox"
          checked={isStepping}
          onChange={event => productionStore.setState({ isStepping: event.currentTarget.checked })}
        />
        {words.production.stepping}
      </label>
      <div className="run-buttons">
        <button className="btn" disabled={disabled} onClick={() => runCommand("production.begin")}>
          <Repeat />
          {words.production.begin}
        </button>
      </div>
    </>
  );
}

function UnderWay({
  station: { id },
  production: { state, cycle, of, step, next },
  tell,
}: {
  readonly station: StationState;
  readonly production: NonNullable<StationState["production"]>;
  readonly tell: (outcome: Promise<CommandOutcome>) => void;
}) {
  const program = useStore(cellStore, ({ document }) => programOf(document));
  const sent = useStore(productionStore, ({ sent: last }) => last);
  const where = step === "" ? "" : nameOf(program, step);
  return (
    <>
      <p data-testid="production-state">
        {of === null ? words.production.cycle(cycle) : words.production.cycleOf(cycle, of)}{" "}
        {state === "held" ? words.production.held(where) : words.production.runs(where)}
      </p>
      <div className="run-buttons">
        {state === "held" ? (
          <>
            <button className="btn" onClick={() => tell(stepProduction(id))}>
              <StepForward />
              {words.production.step}
            </button>
            <button className="btn primary" onClick={() => tell(resumeProduction(id, "step"))}>
              <Play />
              {words.production.handBack}
            </button>
            <button className="btn" onClick={() => tell(resumeProduction(id, "cycle"))}>
              <RotateCcw />
              {words.production.fromBeginning}
            </button>
          </>
        ) : (
          <button className="btn" onClick={() => tell(holdProduction(id))}>
            <Hand />
            {words.production.takeOver}
          </button>
        )}
      </div>
      {state === "held" && <p className="small muted">{words.production.byHand}</p>}
      {next !== null ? (
        <p className="small">{words.production.next(next)}</p>
      ) : (
        sent !== null &&
        program !== sent && (
          <button className="btn" onClick={() => askBeforeRun(despite => tell(replaceProduction(id, despite)), [id])}>
            <Repeat />
            {words.production.replace}
          </button>
        )
      )}
    </>
  );
}

/** Steps before which it is held: the selected one joins them or leaves them. */
function Breakpoints({
  station: { id },
  tell,
}: {
  readonly station: StationState;
  readonly tell: (outcome: Promise<CommandOutcome>) => void;
}) {
  const program = useStore(cellStore, ({ document }) => programOf(document));
  const breakpoints = useStore(productionStore, state => state.breakpoints);
  const selected = useStore(selectionStore, ({ selected: thing }) => (thing?.kind === "step" ? thing.id : null));
  const own = program?.steps.some(step => step.id === selected) === true ? selected : null;
  return (
    <>
      {breakpoints.length > 0 && (
        <ul className="production-breakpoints" aria-label={words.production.breakpoints}>
          {breakpoints.map(step => (
            <li key={step}>
              <span className="grow">{words.production.before(nameOf(program, step))}</span>
              <button
                className="btn icon tight"
                aria-label={words.production.without(nameOf(program, step))}
                onClick={() => tell(toggleBreakpoint(id, step))}
              >
                <X />
              </button>
            </li>
          ))}
        </ul>
      )}
      {own === null || !breakpoints.includes(own) ? (
        <button
          className="btn"
          disabled={own === null}
          onClick={() => {
            if (own !== null) tell(toggleBreakpoint(id, own));
          }}
        >
          {own === null ? words.production.selectFirst : words.production.holdBefore(nameOf(program, own))}
        </button>
      ) : null}
    </>
  );
}
