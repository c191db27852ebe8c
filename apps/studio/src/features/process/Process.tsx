import { Check } from "lucide-react";
import { useStore } from "zustand";
import { cellStore } from "../../stores/cell.ts";
import { runCommand } from "../../stores/commands.ts";
import { programOf, textOf } from "../../stores/document.ts";
import { historyStore } from "../../stores/history.ts";
import { playStore } from "../../stores/play.ts";
import { showMode } from "../../stores/view.ts";
import { words } from "../../messages/index.ts";
import { nextStep, PROCESS_STEPS, stepsDone, type ProcessStep } from "./steps.ts";
import "./process.css";

/** What takes a person on in each step. */
const ACTIONS: Readonly<Record<ProcessStep, readonly { readonly label: string; readonly run: () => void }[]>> = {
  objects: [{ label: words.process.bringCad, run: () => runCommand("file.load") }],
  kinematics: [
    { label: words.process.chooseRobot, run: () => runCommand("cell.robot") },
    { label: words.process.makeRobot, run: () => runCommand("build.rig") },
  ],
  interactions: [{ label: words.process.pairs, run: () => runCommand("view.collision") }],
  scenario: [{ label: words.process.teach, run: () => showMode("teach") }],
  run: [{ label: words.process.play, run: () => runCommand("play.toggle") }],
  execute: [
    { label: words.process.execute, run: () => showMode("run") },
    { label: words.process.correct, run: () => showMode("check") },
  ],
};

/** From an empty cell to a robot that runs (row N-01): six steps, what is done, and the way to what is not. */
export function Process() {
  const document = useStore(cellStore, state => state.document);
  const simulated = useStore(playStore, state => state.t_s > 0);
  const judged = useStore(playStore, ({ verdict }) => (verdict === null ? null : verdict.ok ? "clear" : "bad"));
  const runs = useStore(historyStore, state => state.runs.length);
  if (!document) return null;
  const steps = programOf(document)?.steps.length ?? textOf(document)?.files.length ?? 0;
  const done = stepsDone({ document, steps, simulated, judged, runs });
  const next = nextStep(done);
  return (
    <section aria-label={words.process.title}>
      <h2 className="heading">
        <span className="grow">{words.process.title}</span>
        <span className="tag">{words.process.done(done.size, PROCESS_STEPS.length)}</span>
      </h2>
      <ol className="process">
        {PROCESS_STEPS.map((step, i) => {
          const { title, says } = words.process.steps[step];
          return (
            <li key={step} data-done={done.has(step)} aria-current={step === next ? "step" : undefined}>
              <span className="process-number" aria-hidden>
                {done.has(step) ? <Check /> : i + 1}
              </span>
              <div className="stack">
                <b>
                  {title}
                  {done.has(step) && <span className="visually-hidden"> {words.process.isDone}</span>}
                </b>
                {!done.has(step) && <p className="muted small">{says}</p>}
                {step === next && (
                  <div className="process-ways">
                    {ACTIONS[step].map(({ label, run }) => (
                      <button key={label} className="btn small" onClick={run}>
                        {label}
                      </button>
                    ))}
                  </div>
                )}
              </div>
            </li>
          );
        })}
      </ol>
    </section>
  );
}
