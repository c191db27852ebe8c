import type { BindingCause, Explanation, ProvenRepair } from "@twincell/core";
import { useEffect } from "react";
import { useStore } from "zustand";
import { applyRepair, cancelRepairing, explainStep } from "../../runtime/planning/repairing.ts";
import { repairStore, showRepair } from "../../stores/repairs.ts";
import { say, words } from "../../messages/index.ts";
import { useMedia } from "../../ui/useMedia.ts";
import { outcomeWords } from "./outcome.ts";

/** Why a bad step cannot be carried out, and up to three proven changes that would help; `open` looks by itself. */
export function WaysOut({ step, open }: { readonly step: string; readonly open: boolean }) {
  const explanation = useStore(repairStore, state => state.explanations.get(step));
  const verdict = useStore(repairStore, state => state.verdict);
  const mine = useStore(repairStore, ({ searching }) => searching?.kind === "explain" && searching.step === step);
  useEffect(() => {
    const { searching, current } = repairStore.getState();
    if (open && verdict !== null && searching === null && current === null) explainStep(step);
  }, [open, step, verdict]);
  useEffect(
    () => () => {
      if (repairStore.getState().shown?.step === step) showRepair(null);
    },
    [step],
  );
  if (verdict === null) return null;
  if (explanation) return <Explained explanation={explanation} />;
  return (
    <div className="why-repair" aria-busy={mine}>
      {mine ? (
        <>
          <span className="muted" role="status">
            {words.check.explaining}
          </span>
          <button className="btn tight" onClick={cancelRepairing}>
            {words.common.cancel}
          </button>
        </>
      ) : (
        <>
          <span />
          <button className="btn tight" title={words.check.explainTip} onClick={() => explainStep(step)}>
            {words.check.waysOut}
          </button>
        </>
      )}
    </div>
  );
}

function Explained({ explanation }: { readonly explanation: Explanation }) {
  const { cause, finding, repairs, sentence, step, tried } = explanation;
  const shown = useStore(repairStore, state => state.shown);
  const touch = useMedia("(pointer: coarse)");
  const place = sentence.startsWith(finding.sentence) ? sentence.slice(finding.sentence.length).trim() : sentence;
  return (
    <>
      {place !== "" && <p className="why-cause">{say(place)}</p>}
      {repairs.length === 0 && <p className="small">{words.check.noneFound}</p>}
      {repairs.length > 0 && (
        <ol className="ways-out" aria-label={words.check.waysOut} onPointerLeave={unpinned}>
          {repairs.map((repair, index) => (
            <WayOut
              key={repair.sentence}
              step={step}
              cause={cause}
              repair={repair}
              index={index}
              shown={shown?.repair === repair}
            />
          ))}
        </ol>
      )}
      {shown?.step === step && <p className="small dim">{touch ? words.check.ghostTouch : words.check.ghost}</p>}
      {tried.length > 0 && (
        <details className="small" open={repairs.length === 0}>
          <summary>{words.check.tried}</summary>
          <ul className="notes">
            {tried.map(says => (
              <li key={says}>{say(says)}</li>
            ))}
          </ul>
        </details>
      )}
    </>
  );
}

/** What is only pointed at goes with the pointer. */
function unpinned(): void {
  if (repairStore.getState().shown?.pinned === false) showRepair(null);
}

interface WayOutProps {
  readonly step: string;
  readonly cause: BindingCause;
  readonly repair: ProvenRepair;
  readonly index: number;
  readonly shown: boolean;
}
function WayOut({ step, cause, repair, index, shown }: WayOutProps) {
  const pointAt = (): void => {
    if (repairStore.getState().shown?.pinned !== true) showRepair({ step, repair, index, pinned: false });
  };
  const pin = (): void => {
    repairStore.setState({ current: step });
    const pinned = repairStore.getState().shown;
    showRepair(pinned?.repair === repair && pinned.pinned ? null : { step, repair, index, pinned: true });
  };
  return (
    <li className="way-out" data-shown={shown} onPointerEnter={pointAt}>
      <button
        className="way-number"
        data-number={index + 1}
        aria-label={words.check.showRepair(index + 1)}
        aria-pressed={shown}
        onClick={pin}
      >
        {index + 1}
      </button>
      <span className="way-says">
        <b>{say(repair.sentence)}</b>
        <span className="muted small">{outcomeWords(repair.reaches, cause)}</span>
      </span>
      <button
        className={index === 0 ? "btn tight primary" : "btn tight"}
        aria-label={words.check.applyRepair(index + 1)}
        onClick={() => {
          showRepair(null);
          applyRepair(step, repair);
        }}
      >
        {words.common.apply}
      </button>
    </li>
  );
}
