import type { Program, Repair, Verdict } from "@twincell/core";
import { selectedProgram } from "@twincell/project";
import { useEffect, useState } from "react";
import { useStore } from "zustand";
import { cellStore } from "../../stores/cell.ts";
import { runCommand } from "../../stores/commands.ts";
import { programOf } from "../../stores/document.ts";
import { cancelSearch, findDetour } from "../../runtime/planning/planning.ts";
import { lookAt } from "../../runtime/planning/look-at.ts";
import { cancelRepairing } from "../../runtime/planning/repairing.ts";
import { collideStore } from "../../stores/collide.ts";
import { repairStep, findStep, stepsToRepair, stepWords } from "../../stores/program.ts";
import { repairStore } from "../../stores/repairs.ts";
import { previewStep } from "../../stores/seek.ts";
import { say, words } from "../../messages/index.ts";
import { whyCards, type Why } from "../../runtime/planning/why-cards.ts";
import { WaysOut } from "./WaysOut.tsx";

const FIRST = 12;

/** Subject, fact with number, way out. */
export function WhyCards({ verdict }: { verdict: Verdict }) {
  const program = useStore(cellStore, state => programOf(state.document));
  const ours = useStore(cellStore, state => state.document !== null && selectedProgram(state.document) !== undefined);
  const [all, setAll] = useState(false);
  if (!program) return null;
  const cards = whyCards(verdict, program);
  const repairs = stepsToRepair(verdict);
  if (cards.length === 0)
    return (
      <p className="why-fine">
        <i className="mark" data-verdict={verdict.ok ? "ok" : "unknown"} aria-hidden />
        {verdict.ok ? words.check.fine : words.check.notYet}
      </p>
    );
  return (
    <>
      {ours && repairs > 1 && <RepairAll count={repairs} />}
      {(all ? cards : cards.slice(0, FIRST)).map((card, index) => (
        <WhyCard key={card.key} card={card} subject={subjectOf(program, card)} first={index === 0} ours={ours} />
      ))}
      {!all && cards.length > FIRST && (
        <button className="btn quiet" onClick={() => setAll(true)}>
          {words.check.more(cards.length - FIRST)}
        </button>
      )}
    </>
  );
}

/** The group it happens in, or the step itself. */
function subjectOf(program: Program, card: Why): string {
  const found = findStep(program, card.step);
  const point = found ? stepWords(found.step, found.index) : card.step;
  const group = card.group === undefined ? undefined : program.groups[card.group]?.name;
  return group === undefined || point.startsWith(group) ? point : `${group} · ${point}`;
}

/** Everything that can be repaired, with the least changes; with its progress while they are looked for. */
function RepairAll({ count }: { readonly count: number }) {
  const share = useStore(repairStore, ({ searching }) => (searching?.kind === "all" ? searching.share : null));
  if (share === null)
    return (
      <button className="btn" onClick={() => runCommand("check.repair-all")}>
        {words.check.repairAll(count)}
      </button>
    );
  return (
    <div className="why-repair" aria-busy>
      <span className="muted" role="status">
        {words.check.repairing(Math.round(share * 100))}
      </span>
      <button className="btn tight" onClick={cancelRepairing}>
        {words.common.cancel}
      </button>
    </div>
  );
}

interface CardProps {
  readonly card: Why;
  readonly subject: string;
  /** Looks for ways out by itself. */
  readonly first: boolean;
  /** Its steps can be changed: they are not a vendor's text. */
  readonly ours: boolean;
}
function WhyCard({ card, subject, first, ours }: CardProps) {
  const { finding } = card;
  const proven = ours && card.verdict === "bad";
  const look = (): void => {
    lookAt(card.step, finding.at_s);
  };
  const [shown, setShown] = useState<Repair | null>(null);
  useEffect(() => {
    if (!shown) return undefined;
    const leave = (event: KeyboardEvent): void => {
      if (event.key === "Escape") {
        setShown(null);
        previewStep(null);
      }
    };
    window.addEventListener("keydown", leave);
    return () => {
      window.removeEventListener("keydown", leave);
    };
  }, [shown]);
  useEffect(() => () => previewStep(null), []);
  const own = proven || !ours ? [] : card.repairs.filter(each => each.id === card.step);
  return (
    <article className="why" data-tone={card.verdict}>
      <button className="why-fact" onClick={look}>
        <i className="mark" data-verdict={card.verdict} aria-hidden />
        <span>
          <span className="why-subject">{subject}</span>
          <b>{say(finding.sentence)}</b>
          {card.steps.length > 1 && <span className="muted"> {words.check.affected(card.steps.length)}</span>}
        </span>
      </button>
      {own.map(({ id, repair }) => (
        <div className="why-repair" key={repair.sentence}>
          <span className="muted">{say(repair.sentence)}</span>
          {repair.replace && (
            <button
              className="btn tight"
              aria-pressed={shown === repair}
              onClick={() => {
                const next = shown === repair ? null : repair;
                setShown(next);
                previewStep(next?.replace ?? null);
              }}
            >
              {words.common.show}
            </button>
          )}
          <button
            className="btn tight primary"
            onClick={() => {
              previewStep(null);
              repairStep(id, repair);
            }}
          >
            {words.common.apply}
          </button>
        </div>
      ))}
      {proven && <WaysOut step={card.step} open={first} />}
      {ours && card.finding.code === "collision.contact" && <Detour step={card.step} />}
      {shown && <p className="small muted">{words.check.shown}</p>}
    </article>
  );
}

/** One click: a search away from the page, with its progress, and what it finds as one edit. */
function Detour({ step }: { step: string }) {
  const searching = useStore(collideStore, state => state.searching);
  const mine = searching?.kind === "way" && searching.step === step;
  return (
    <div className="why-repair" aria-busy={mine}>
      {mine ? (
        <>
          <span className="muted" role="status">
            {words.collide.searching(Math.round(searching.share * 100))}
          </span>
          <button className="btn tight" onClick={cancelSearch}>
            {words.common.cancel}
          </button>
        </>
      ) : (
        <>
          <span />
          <button className="btn tight" disabled={searching !== null} onClick={() => findDetour(step)}>
            {words.collide.wayRound}
          </button>
        </>
      )}
    </div>
  );
}
