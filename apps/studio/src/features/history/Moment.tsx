import { BellRing, GitBranch, Link2 } from "lucide-react";
import { useStore } from "zustand";
import { branchFromHere, shareMoment, theHistory } from "../../runtime/robot/cell-control.ts";
import { historyStore } from "../../stores/history.ts";
import { say, words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";
import { clockOf, MOST_SHOWN, wallOf } from "./times.ts";

/** How everything stood at the moment that is looked at, what can be done with it, and what happened around it. */
export function Moment() {
  const { moment, marks, troubles: problems, window, startedAt_ms, t_s } = useStore(historyStore);
  const { modes, safeties } = words.history;
  const inSight = marks.filter(mark => mark.at_s >= window.from_s && mark.at_s <= window.to_s);
  const lines = Object.entries(moment.signals);
  return (
    <div className="history-moment">
      <p className="small muted">{wallOf(startedAt_ms, t_s)}</p>
      {problems.map(problem => (
        <p key={problem} className="small history-trouble">
          {problem}
        </p>
      ))}
      {!moment.recorded && <p className="small history-trouble">{words.history.gap}</p>}
      <div className="history-acts">
        <button
          className="btn tight"
          onClick={() => {
            theHistory.lastAlarm();
          }}
        >
          <BellRing />
          {words.history.lastAlarm}
        </button>
        <button
          className="btn tight"
          onClick={() => {
            void shareMoment();
          }}
        >
          <Link2 />
          {words.history.share}
        </button>
        <button
          className="btn tight"
          title={words.history.branchSays}
          onClick={() => {
            void branchFromHere();
          }}
        >
          <GitBranch />
          {words.history.branch}
        </button>
      </div>
      <dl className="history-facts">
        <dt>{words.inspector.step}</dt>
        <dd>{moment.step || words.history.noStep}</dd>
        <dt>{words.history.mode}</dt>
        <dd>{modes[moment.mode]}</dd>
        <dt>{words.history.safety}</dt>
        <dd data-safety={moment.safety}>{safeties[moment.safety]}</dd>
        <dt>{words.history.gripper}</dt>
        <dd>{moment.gripperClosed ? words.history.closed : words.history.opened}</dd>
        {lines.map(([name, value]) => (
          <Line key={name} name={name} value={value} />
        ))}
      </dl>
      {moment.message && <p className="small">{say(moment.message)}</p>}
      <h3>{words.history.events}</h3>
      {inSight.length === 0 && <p className="small muted">{words.history.noEvents}</p>}
      <ul className="history-events">
        {inSight.slice(0, MOST_SHOWN).map((mark, i) => (
          <li key={i} data-level={mark.level}>
            <button
              className="link"
              onClick={() => {
                theHistory.seek(mark.at_s);
              }}
            >
              {clockOf(mark.at_s)}
            </button>{" "}
            <span>{mark.kind === "operator" ? `${mark.code} ${say(mark.sentence)}` : say(mark.sentence)}</span>
          </li>
        ))}
      </ul>
      {inSight.length > MOST_SHOWN && (
        <p className="small muted">{words.history.moreMarks(inSight.length - MOST_SHOWN)}</p>
      )}
    </div>
  );
}

const Line = ({ name, value }: { readonly name: string; readonly value: boolean | number }) => (
  <>
    <dt>{name}</dt>
    <dd>{typeof value === "boolean" ? (value ? "1" : "0") : Number.isInteger(value) ? value : fixed(value, 2)}</dd>
  </>
);
