import { selectedProgram } from "@twincell/project";
import { useStore } from "zustand";
import { cellStore } from "../../stores/cell.ts";
import { runCommand } from "../../stores/commands.ts";
import { programOf, robotOf } from "../../stores/document.ts";
import { playStore } from "../../stores/play.ts";
import { stationStore } from "../../stores/stations.ts";
import { say, words } from "../../messages/index.ts";
import { BaseMap } from "./BaseMap.tsx";
import { JointColumn } from "./JointColumn.tsx";
import { figures } from "./figures.ts";
import { WhyCards } from "./WhyCards.tsx";
import "./check.css";

/** Check mode: the joints at this moment, why something cannot be, and the figures of the whole program. */
export function Check() {
  const { verdict, checking, trouble: problem, plan, withOthers } = useStore(playStore);
  const others = useStore(stationStore, state => state.stations.length);
  const robot = useStore(cellStore, state => robotOf(state.document));
  const ours = useStore(cellStore, ({ document }) => document !== null && selectedProgram(document) !== undefined);
  const steps = useStore(cellStore, state => programOf(state.document)?.steps.length ?? 0);
  return (
    <>
      {robot && (
        <section aria-label={words.check.joint}>
          <h2 className="heading">
            <span className="grow">{words.check.joint}</span>
          </h2>
          <div className="section">
            <JointColumn robot={robot} />
          </div>
        </section>
      )}
      <section aria-label={words.check.why} aria-busy={checking !== null}>
        <h2 className="heading">
          <span className="grow">{words.check.why}</span>
          {checking !== null ? (
            <span className="row-flex">
              <span className="dim small">{words.check.percent(Math.round(checking * 100))}</span>
              <button className="btn quiet tight" onClick={() => runCommand("check.cancel")}>
                {words.common.cancel}
              </button>
            </span>
          ) : (
            steps > 0 && (
              <button className="btn quiet tight" onClick={() => runCommand("check.now")}>
                {words.check.again}
              </button>
            )
          )}
        </h2>
        <div className="section stack">
          {others > 0 && (
            <label className="row-flex small">
              <input
                type="checkbox"
                checked={withOthers}
                onChange={event => {
                  playStore.setState({ withOthers: event.currentTarget.checked });
                  runCommand("check.now");
                }}
              />
              {words.check.others(others)}
            </label>
          )}
          {problem && (
            <p className="why" data-tone="bad" role="alert">
              <b>{words.check.trouble}</b> {say(problem)}
            </p>
          )}
          {steps === 0 ? (
            <p className="muted small">{words.check.none}</p>
          ) : verdict ? (
            <WhyCards verdict={verdict} />
          ) : (
            checking === null && !problem && <p className="muted small">{words.check.notYet}</p>
          )}
        </div>
      </section>
      {verdict && ours && <BaseMap />}
      {verdict && robot && (
        <section aria-label={words.check.title}>
          <h2 className="heading">
            <span className="grow">{words.check.title}</span>
          </h2>
          <div className="section">
            {figures(verdict, plan, robot).map(figure => (
              <div key={figure.name} className="figure">
                <i className="mark" data-verdict={figure.verdict} aria-hidden />
                <span className="grow">{figure.name}</span>
                <b>{figure.says}</b>
                <span className="visually-hidden">{words.tree.verdicts[figure.verdict]}</span>
              </div>
            ))}
            {verdict.assumptions.length > 0 && (
              <details className="small assumptions">
                <summary>{words.check.assumptions}</summary>
                <ul className="notes">
                  {verdict.assumptions.map(says => (
                    <li key={says}>{say(says)}</li>
                  ))}
                </ul>
              </details>
            )}
          </div>
        </section>
      )}
    </>
  );
}
