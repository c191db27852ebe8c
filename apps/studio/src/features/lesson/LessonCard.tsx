import { bestResult, type LessonResult } from "@twincell/core";
import { X } from "lucide-react";
import { useMemo } from "react";
import { useStore } from "zustand";
import {
  handIn,
  helpOf,
  judgedNow,
  leaveLesson,
  lessonStore,
  lessonText,
  meanOf,
  MOST_ATTEMPTS,
  reportText,
  type Help,
} from "../../stores/lesson.ts";
import { playStore } from "../../stores/play.ts";
import { Segments } from "../../ui/Choice.tsx";
import { download } from "../../ui/download.ts";
import { words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";
import "./lesson.css";

/** The lesson under way: what comes next, the attempts so far, and a report of them. */
export function LessonCard() {
  const state = useStore(lessonStore);
  const plan = useStore(playStore, each => each.plan);
  const stale = useStore(playStore, each => each.stale);
  const { lesson, attempts, guided } = state;
  const now = useMemo(() => (lesson && plan ? judgedNow(lesson) : null), [lesson, plan]);
  if (!lesson) return null;
  const over = attempts.length >= MOST_ATTEMPTS;
  const best = bestResult(attempts);
  return (
    <aside className="lesson float" aria-label={words.lesson.title}>
      <div className="row-flex">
        <b className="grow">{words.lesson.reportTitle(lesson.name)}</b>
        {!over && <span className="dim small">{words.lesson.attempt(attempts.length + 1, MOST_ATTEMPTS)}</span>}
        <button
          className="btn quiet icon tight"
          aria-label={words.lesson.leave}
          title={words.lesson.leave}
          onClick={leaveLesson}
        >
          <X />
        </button>
      </div>
      {!over && (
        <>
          <p className="muted" role="status">
            {hint(now, lesson.goals.length, helpOf(state))}
          </p>
          <Segments
            label={words.lesson.help}
            value={guided ? "guided" : "alone"}
            options={[
              { value: "guided", words: words.lesson.helps.guided },
              { value: "alone", words: words.lesson.helps.alone },
            ]}
            onChange={value => lessonStore.setState({ guided: value === "guided" })}
          />
        </>
      )}
      {attempts.length > 0 && (
        <ol className="lesson-attempts">
          {attempts.map((each, i) => (
            <li key={i} data-best={i === best} data-passed={each.passed}>
              <span>
                {words.lesson.result(i + 1, fixed(each.score, 0))} ·{" "}
                {each.passed ? words.lesson.passed : words.lesson.failed}
              </span>
              <span className="small dim">
                {words.lesson.figures(
                  fixed(each.duration_s, 1),
                  fixed(each.length_m, 2),
                  fixed(meanOf(each) * 1000, 1),
                )}
              </span>
              {each.lacks.length > 0 && (
                <span className="small">{each.lacks.map(lack => words.lesson.lacks[lack]).join(" ")}</span>
              )}
            </li>
          ))}
        </ol>
      )}
      <div className="row-flex lesson-foot">
        {attempts.length > 0 && (
          <button
            className="btn tight"
            onClick={() =>
              download(
                `${lesson.name}.report.md`,
                new Blob([reportText(state, new Date().toISOString().slice(0, 10))], { type: "text/markdown" }),
              )
            }
          >
            {words.lesson.report}
          </button>
        )}
        <button
          className="btn tight"
          onClick={() => download(`${lesson.name}.lesson.json`, new Blob([lessonText()], { type: "application/json" }))}
        >
          {words.lesson.saveFile}
        </button>
        {!over && (
          <button className="btn primary tight" disabled={stale || plan === null} onClick={handIn}>
            {words.lesson.handIn}
          </button>
        )}
      </div>
    </aside>
  );
}

/** What comes next, as far as help goes. */
function hint(now: LessonResult | null, goals: number, help: Help): string {
  if (help === "none") return words.lesson.alone;
  const met = now?.met ?? [];
  const next = now === null ? 0 : met.indexOf(false);
  if (next < 0) return words.lesson.allMet;
  const count = words.lesson.goals(met.filter(Boolean).length, goals);
  if (help !== "hints") return count;
  const off_m = now?.distances_m[next] ?? Infinity;
  const says =
    Number.isFinite(off_m) && next > 0
      ? words.lesson.next(next + 1, fixed(off_m * 1000, 0))
      : words.lesson.nextNew(next + 1);
  return `${count}. ${says}`;
}
