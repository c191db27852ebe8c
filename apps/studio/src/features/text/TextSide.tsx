import { FileCode2, FileDigit } from "lucide-react";
import type { KeyboardEvent, ReactNode } from "react";
import { useStore } from "zustand";
import type { TextPoint } from "@twincell/languages";
import type { TextProgram } from "@twincell/project";
import { importText } from "../../stores/importing.ts";
import { newProgram } from "../../stores/programs.ts";
import { notify } from "../../stores/notices.ts";
import { pointAt, pointsOf, stepOfPoint, textStore } from "../../stores/text.ts";
import { playStore } from "../../stores/play.ts";
import { goToLine, goToPoint } from "../../runtime/text-program.ts";
import { Segments } from "../../ui/Choice.tsx";
import { words } from "../../messages/index.ts";
import { findingsOf } from "./findings.ts";

/** Left of the text: which program, its files, its points. `children` is the choice among the cell's programs. */
export function TextSide({ text, children }: { readonly text: TextProgram; readonly children: ReactNode }) {
  const state = useStore(textStore);
  const verdict = useStore(playStore, each => each.verdict);
  const points = pointsOf(state).filter(point => point.uses.length > 0 || point.fixed === undefined);
  const selected = pointAt(pointsOf(state), state.cursor);
  const base = state.base[text.name];
  const findings = findingsOf(state.read, verdict);
  const worst = (point: TextPoint): "bad" | "warn" | "ok" => {
    const own = findings.filter(each => point.uses.some(use => use.file === each.file && use.motionLine === each.line));
    return own.some(each => each.verdict === "bad") ? "bad" : own.length > 0 ? "warn" : "ok";
  };
  const onKey = (event: KeyboardEvent): void => {
    const by = event.key === "ArrowDown" ? 1 : event.key === "ArrowUp" ? -1 : 0;
    const at = selected === undefined ? -1 : points.indexOf(selected);
    const next = points[Math.min(points.length - 1, Math.max(0, at + by))];
    if (by === 0 || next === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    goToPoint(next);
  };
  return (
    <section className="text-side" aria-label={words.text.files} id="program">
      {children}
      <div className="text-kind">
        <Segments
          label={words.text.kind}
          value="text"
          onChange={value => {
            if (value === "steps") toSteps(text);
          }}
          options={[
            { value: "steps", words: words.text.steps },
            { value: "text", words: words.text.text },
          ]}
        />
      </div>
      <h2 className="heading">
        <span className="grow">{words.text.files}</span>
        <span className="text-language">{text.language.toUpperCase()}</span>
      </h2>
      <ul className="text-files">
        {text.files.map((file, index) => (
          <li key={file.name}>
            <button
              className="row"
              aria-current={state.cursor.file === index}
              onClick={() => goToLine({ file: index, line: 1 })}
            >
              {file.name === text.main ? <FileCode2 aria-hidden /> : <FileDigit aria-hidden />}
              <span className="grow text-file-name">{file.name}</span>
              {base?.[index] !== undefined && base[index] !== file.text && (
                <span className="text-modified" title={words.text.changed}>
                  M
                </span>
              )}
            </button>
          </li>
        ))}
      </ul>
      <h2 className="heading">
        <span className="grow">{words.text.points}</span>
        <span>{points.length}</span>
      </h2>
      {state.read?.points.kind === "not-yet" && <p className="empty">{state.read.points.because}</p>}
      {state.read?.points.kind === "found" && points.length === 0 && <p className="empty">{words.text.noPoints}</p>}
      <ul className="text-points scroll" role="listbox" aria-label={words.text.points} tabIndex={0} onKeyDown={onKey}>
        {points.map(point => (
          <li
            key={`${point.value.file}:${point.value.start}`}
            role="option"
            aria-selected={point === selected}
            className="row"
            onClick={() => goToPoint(point)}
          >
            <i
              className="mark"
              data-verdict={stepOfPoint(state, point) === undefined ? "unknown" : worst(point)}
              aria-hidden
            />
            <span className="grow text-point-name">
              {point.name === "" ? words.text.unnamed(point.value.line) : point.name}
            </span>
            <span className="dim small">{words.text.uses(point.uses.length)}</span>
          </li>
        ))}
      </ul>
    </section>
  );
}

/** A copy of the text is read into steps of a new program; the text stays. */
function toSteps(text: TextProgram): void {
  const joined = text.files.map(file => file.text).join("");
  newProgram();
  const [fault] = importText(joined, text.main);
  if (fault === undefined) notify("info", words.text.converted);
  else notify("bad", fault);
}
