import { useState } from "react";
import { useStore } from "zustand";
import { leaveRunQuestion, linesAssumed, seenFindings } from "../../runtime/run/ask-before-run.ts";
import { cellStore } from "../../stores/cell.ts";
import { dialogStore } from "../../stores/dialogs.ts";
import { programOf } from "../../stores/document.ts";
import { playStore } from "../../stores/play.ts";
import { findStep, stepWords } from "../../stores/program.ts";
import { runQuestionStore } from "../../stores/run-question.ts";
import { seek } from "../../stores/seek.ts";
import { select } from "../../stores/selection.ts";
import { viewStore } from "../../stores/view.ts";
import { Frame } from "../../ui/Frame.tsx";
import { say, words } from "../../messages/index.ts";
import { whyCards, type Why } from "../../runtime/planning/why-cards.ts";
import "./run.css";

/** So many findings are named; the rest is counted. */
const NAMED = 3;

/** What of a vendor's text only the controller knows, line by line. */
function Assumed() {
  const { assumed, files } = linesAssumed();
  return (
    <div className="stack">
      <p>{words.runQuestion.assumed(assumed.length)}</p>
      <ul className="run-findings">
        {assumed.slice(0, NAMED).map(({ file, line, sentence }) => (
          <li key={`${file} ${line} ${sentence}`}>
            <i className="mark" data-verdict="warn" aria-hidden />
            <span>
              <b>{words.runQuestion.line(files[file] ?? "", line)}</b> {say(sentence)}
            </span>
          </li>
        ))}
      </ul>
      {assumed.length > NAMED && <p className="small muted">{words.runQuestion.more(assumed.length - NAMED)}</p>}
      <p className="small muted">{words.runQuestion.guard}</p>
    </div>
  );
}

/** Asked before a program runs whose check is not content, or not done. */
export default function RunQuestion() {
  const question = useStore(runQuestionStore, state => state.question);
  const open = useStore(dialogStore, state => state.open === "run-question") && question !== null;
  const share = useStore(playStore, state => state.checking);
  const verdict = useStore(playStore, state => state.verdict);
  const program = useStore(cellStore, state => programOf(state.document));
  const cards = open && question.kind === "red" && verdict && program ? whyCards(verdict, program) : [];
  const show = (card: Why): void => {
    leaveRunQuestion();
    viewStore.setState({ mode: "check" });
    select({ kind: "step", id: card.step });
    seek(card.finding.at_s);
  };
  const nameOf = (id: string): string => {
    const found = program ? findStep(program, id) : undefined;
    return found ? stepWords(found.step, found.index) : id;
  };
  const [first] = cards;
  const real = question?.real ?? [];
  const [typed, setTyped] = useState("");
  if (!open && typed !== "") setTyped("");
  return (
    <Frame
      open={open}
      title={words.runQuestion.titles[question?.kind ?? "checking"]}
      onClose={leaveRunQuestion}
      width={520}
      foot={
        question?.kind !== "checking" && (
          <>
            <button
              className="btn danger"
              disabled={real.length > 0 && typed.trim() !== words.runQuestion.typed}
              onClick={() => {
                leaveRunQuestion();
                question?.proceed(seenFindings());
              }}
            >
              {words.runQuestion.anyway}
            </button>
            <span className="grow" />
            {first && (
              <button className="btn" onClick={() => show(first)}>
                {words.runQuestion.show}
              </button>
            )}
            <button className="btn primary" onClick={leaveRunQuestion}>
              {words.runQuestion.leave}
            </button>
          </>
        )
      }
    >
      {open && question.kind === "checking" && (
        <p role="status">{words.runQuestion.checking(Math.round(100 * (share ?? 0)))}</p>
      )}
      {open && question.kind === "unchecked" && (
        <p>{question.sentence ? say(question.sentence) : words.runQuestion.unchecked}</p>
      )}
      {open && question.kind === "red" && (
        <div className="stack">
          <p>{cards.length > 0 ? words.runQuestion.red(cards.length) : words.runQuestion.unchecked}</p>
          <ul className="run-findings">
            {cards.slice(0, NAMED).map(card => (
              <li key={card.key}>
                <i className="mark" data-verdict={card.verdict} aria-hidden />
                <span>
                  <b>{nameOf(card.step)}</b> {say(card.finding.sentence)}
                </span>
              </li>
            ))}
          </ul>
          {cards.length > NAMED && <p className="small muted">{words.runQuestion.more(cards.length - NAMED)}</p>}
          <p className="small muted">{words.runQuestion.guard}</p>
        </div>
      )}
      {open && question.kind === "assumed" && <Assumed />}
      {open && question.kind !== "checking" && real.length > 0 && (
        <label className="stack run-typed">
          <span>{words.runQuestion.type(real.join(", "))}</span>
          <span className="field text">
            <input
              aria-label={words.runQuestion.typeHere}
              autoComplete="off"
              spellCheck={false}
              value={typed}
              onChange={event => setTyped(event.currentTarget.value)}
            />
          </span>
        </label>
      )}
    </Frame>
  );
}
