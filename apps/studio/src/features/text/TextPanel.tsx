import { CircleX, Download, Hammer, LocateFixed, TriangleAlert } from "lucide-react";
import { useMemo } from "react";
import { useStore } from "zustand";
import { bytesOfTextFile, type TextFile, type TextProgram } from "@twincell/project";
import { goToLine, goToStep } from "../../runtime/text-program.ts";
import { cellStore } from "../../stores/cell.ts";
import { runCommand } from "../../stores/commands.ts";
import { notify } from "../../stores/notices.ts";
import { playStore } from "../../stores/play.ts";
import { pointAt, pointsOf, stepOfPoint, textStore } from "../../stores/text.ts";
import { textOf } from "../../stores/document.ts";
import { download } from "../../ui/download.ts";
import { say, words } from "../../messages/index.ts";
import { findingsOf, marksOf } from "./findings.ts";
import { lineSpans, numbersOf } from "./lines.ts";
import { TextLines } from "./TextLines.tsx";
import "./text.css";

/** The text of the program that is worked on: file tabs, lines, the point under the cursor, and what is wrong. */
export default function TextPanel() {
  const text = useStore(cellStore, state => textOf(state.document));
  return text && <Panel text={text} />;
}

function Panel({ text }: { readonly text: TextProgram }) {
  const state = useStore(textStore);
  const verdict = useStore(playStore, each => each.verdict);
  const findings = useMemo(() => findingsOf(state.read, verdict), [state.read, verdict]);
  const index = Math.min(state.cursor.file, text.files.length - 1);
  const file = text.files[index]!;
  const point = pointAt(pointsOf(state), state.cursor);
  const base = state.base[text.name]?.[index];
  const lines = useMemo(() => lineSpans(file.text).length, [file.text]);
  const changed = useMemo(() => changedLines(base, file.text), [base, file.text]);
  const marks = useMemo(() => marksOf(findings, index), [findings, index]);
  return (
    <section className="text-panel" aria-label={words.text.title}>
      <div className="text-tabs" role="tablist" aria-label={words.text.files}>
        {text.files.map((each, i) => (
          <button
            key={each.name}
            role="tab"
            className="text-tab"
            aria-selected={i === index}
            title={each.name}
            onClick={() => goToLine({ file: i, line: 1 })}
          >
            <span className="text-tab-name">{each.name}</span>
            {state.base[text.name]?.[i] !== undefined && state.base[text.name]?.[i] !== each.text && (
              <i className="text-dot" title={words.text.changed} />
            )}
          </button>
        ))}
        <span className="grow" />
        <button
          className="btn icon"
          aria-label={words.text.saveFile(file.name)}
          title={words.text.saveFile(file.name)}
          onClick={() => saveFile(file)}
        >
          <Download />
        </button>
      </div>
      <p className="text-crumbs">
        <span className="grow">
          {words.text.encoding[file.encoding ?? "utf-8"]} · {words.text.lineOf(state.cursor.line, lines)}
        </span>
        <span>{words.text.changes(changed)}</span>
      </p>
      {point && <PointCard text={text} />}
      <TextLines
        key={`${text.name}/${file.name}`}
        file={file}
        index={index}
        language={text.language}
        cursor={state.cursor.file === index ? state.cursor.line : 0}
        point={point}
        base={base}
        findings={marks}
        onLine={line => goToLine({ file: index, line })}
      />
      <Problems text={text} findings={findings} lines={lines} />
    </section>
  );
}

/** The point under the cursor: what it is, and what can be done with it. */
function PointCard({ text }: { readonly text: TextProgram }) {
  const state = useStore(textStore);
  const point = pointAt(pointsOf(state), state.cursor);
  if (!point) return null;
  const step = stepOfPoint(state, point);
  const called = point.name === "" ? words.text.unnamed(point.value.line) : point.name;
  const numbers = numbersOf(text.files[point.value.file]?.text ?? "", point.fields);
  return (
    <section className="text-point" aria-label={called}>
      <div className="text-point-head">
        <b>{called}</b>
        <span className="tag">{words.text.uses(point.uses.length)}</span>
        <span className="grow" />
        <button
          className="btn tight"
          disabled={step === undefined}
          onClick={() => step !== undefined && goToStep(step)}
        >
          <LocateFixed />
          {words.text.goTo}
        </button>
        <button
          className="btn primary tight"
          disabled={step === undefined || point.fixed !== undefined || state.reading}
          onClick={() => runCommand("program.touch-up")}
        >
          <Hammer />
          {words.text.touchUp}
        </button>
      </div>
      <dl className="text-numbers">
        {numbers.map(({ key, value }) => (
          <div key={key}>
            <dt>{key}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
      <p className="dim small">{point.fixed ?? words.text.drag(called)}</p>
    </section>
  );
}

function Problems({
  text,
  findings,
  lines,
}: {
  readonly text: TextProgram;
  readonly findings: ReturnType<typeof findingsOf>;
  readonly lines: number;
}) {
  const reading = useStore(textStore, state => state.reading);
  const problem = useStore(textStore, state => state.trouble);
  const checking = useStore(playStore, state => state.checking !== null);
  const bad = findings.filter(each => each.verdict === "bad").length;
  return (
    <section className="text-problems" aria-label={words.text.problems}>
      <h2 className="heading">
        <span>{words.text.problems}</span>
        {bad > 0 && <span className="text-count bad">{bad}</span>}
        {findings.length > bad && <span className="text-count near">{findings.length - bad}</span>}
      </h2>
      {problem !== null && (
        <p className="empty" role="alert">
          {problem}
        </p>
      )}
      {findings.length === 0 && problem === null && (
        <p className="empty" role="status">
          {reading || checking ? words.text.reading : words.text.clean(lines)}
        </p>
      )}
      <ul className="scroll">
        {findings.map((finding, i) => (
          <li key={i}>
            <button className="text-problem" onClick={() => goToLine({ file: finding.file, line: finding.line })}>
              {finding.verdict === "bad" ? <CircleX className="bad" /> : <TriangleAlert className="near" />}
              <span className="grow">{say(finding.sentence)}</span>
              <span className="dim small">
                {text.files.length > 1 && `${text.files[finding.file]?.name ?? ""} · `}
                {words.text.line(finding.line)}
              </span>
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}

function saveFile(file: TextFile): void {
  download(
    file.name,
    new Blob([bytesOfTextFile(file) as Uint8Array<ArrayBuffer>], { type: "application/octet-stream" }),
  );
  notify("done", words.text.saved(file.name));
}

function changedLines(base: string | undefined, text: string): number {
  if (base === undefined || base === text) return 0;
  const before = lineSpans(base).map(({ start, end }) => base.slice(start, end));
  return lineSpans(text).filter(({ start, end }, i) => text.slice(start, end) !== before[i]).length;
}
