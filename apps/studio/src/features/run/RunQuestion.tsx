import { useState } from "react";
import { useStore } from "zustand";
import { checkState, type CheckState } from "../../runtime/run/before-run.ts";
import { cellStore } from "../../stores/cell.ts";
import { programOf } from "../../stores/document.ts";
import { playStore } from "../../stores/play.ts";
import { findStep, stepWords } from "../../stores/program.ts";
import { answerToRun, runQuestionStore, type RunQuestion as Question } from "../../stores/run-question.ts";
import { seek } from "../../stores/seek.ts";
import { select } from "../../stores/selection.ts";
import { showMode } from "../../stores/view.ts";
import { Frame } from "../../ui/Frame.tsx";
import { words } from "../../messages/index.ts";
import "./run.css";

const FIRST = 4;

/** Asks before a program runs whose check is not green. A real robot moves only after the word was typed. */
export default function RunQuestion() {
  const question = useStore(runQuestionStore, state => state.question);
  return question ? <Open question={question} /> : null;
}

const sentenceOf = (state: CheckState): string => {
  switch (state.kind) {
    case "green":
      return words.runQuestion.green;
    case "red":
      return words.runQuestion.red(state.count);
    case "under-way":
      return words.runQuestion.underWay(Math.round(100 * state.share));
    case "not-checked":
      return state.why === "" ? words.runQuestion.notChecked : `${words.runQuestion.notChecked} ${state.why}`;
    case "unjudged":
      return words.runQuestion.unjudged(state.count);
  }
};

function Open({ question: { robots, real, otherModels, otherText = false } }: { readonly question: Question }) {
  const play = useStore(playStore);
  const program = useStore(cellStore, state => programOf(state.document));
  const [typed, setTyped] = useState("");
  const state: CheckState = otherText ? { kind: "not-checked", why: "" } : checkState(play);
  const green = state.kind === "green" && otherModels.length === 0;
  const may = green || !real || typed.trim() === words.runQuestion.word;
  const findings = state.kind === "red" ? state.findings : [];
  const name = (id: string): string => {
    const found = program && findStep(program, id);
    return found ? stepWords(found.step, found.index) : id;
  };
  const show = (): void => {
    answerToRun(false);
    showMode("check");
    const [first] = findings;
    if (!first) return;
    select({ kind: "step", id: first.step });
    seek(first.finding.at_s);
  };
  return (
    <Frame
      open
      title={words.runQuestion.title}
      onClose={() => answerToRun(false)}
      width={520}
      foot={
        <>
          <button className="btn" onClick={() => answerToRun(false)}>
            {words.common.cancel}
          </button>
          <span className="grow" />
          <button className="btn" onClick={show}>
            {words.runQuestion.show}
          </button>
          <button className={green ? "btn primary" : "btn"} disabled={!may} onClick={() => answerToRun(true)}>
            {green ? words.runQuestion.run : words.runQuestion.anyway}
          </button>
        </>
      }
    >
      <div className="stack">
        <p role="status">
          <b>{sentenceOf(state)}</b>
        </p>
        {findings.length > 0 && (
          <ul className="run-findings">
            {findings.slice(0, FIRST).map(({ step, finding }, i) => (
              <li key={i}>
                <i className="mark" data-verdict="bad" aria-hidden />
                <span>
                  <b>{name(step)}</b> {finding.sentence}
                </span>
              </li>
            ))}
            {findings.length > FIRST && <li className="muted">{words.runQuestion.more(findings.length - FIRST)}</li>}
          </ul>
        )}
        {otherModels.length > 0 && <p>{words.runQuestion.otherModels(otherModels.join(", "))}</p>}
        <p className="small muted">
          {words.runQuestion.who(robots.join(", "))} {words.runQuestion.guard}
        </p>
        {real && !green && (
          <label className="stack small">
            {words.runQuestion.typed(words.runQuestion.word)}
            <span className="field text">
              <input
                value={typed}
                spellCheck={false}
                autoComplete="off"
                onChange={event => setTyped(event.currentTarget.value)}
              />
            </span>
          </label>
        )}
      </div>
    </Frame>
  );
}
