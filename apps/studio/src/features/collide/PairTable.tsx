import { editPair, type PairEntry } from "@twincell/core";
import type { PairsRecord } from "@twincell/project";
import { commit } from "../../stores/document.ts";
import { words } from "../../messages/index.ts";

const short = (name: string): string => (name === "tool" ? "T" : name.replace("link ", ""));
const edit = ({ a, b, watched }: PairEntry): void => {
  commit(words.undo.pairs, document =>
    document.pairs === undefined
      ? document
      : { ...document, pairs: { ...document.pairs, ...editPair(document.pairs, a, b, !watched) } },
  );
};

/** A triangle of pairs: filled is checked, hollow is left out, a line is joined by a joint. Each edit can be undone. */
export function PairTable({ pairs, stale }: { pairs: PairsRecord; stale: boolean }) {
  const parts = [...new Set(pairs.entries.flatMap(({ a, b }) => [a, b]))];
  const samples = Math.max(0, ...pairs.entries.map(entry => entry.samples));
  const entryOf = (a: string, b: string): PairEntry | undefined =>
    pairs.entries.find(entry => (entry.a === a && entry.b === b) || (entry.a === b && entry.b === a));
  return (
    <>
      {stale && (
        <p className="export-proof small">
          <i className="mark" data-verdict="warn" aria-hidden />
          {words.collide.matrixStale}
        </p>
      )}
      <div className="pair-scroll">
        <table className="pair-table">
          <thead>
            <tr>
              <td />
              {parts.slice(0, -1).map(part => (
                <th key={part} scope="col" title={part}>
                  {short(part)}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {parts.slice(1).map((row, i) => (
              <tr key={row}>
                <th scope="row" title={row}>
                  {row}
                </th>
                {parts.slice(0, i + 1).map(column => {
                  const entry = entryOf(row, column);
                  return <td key={column}>{entry && <Cell entry={entry} />}</td>;
                })}
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      <p className="small muted pair-legend">
        <i className="pair-mark" data-state="checked" aria-hidden /> {words.collide.checked}{" "}
        <i className="pair-mark" data-state="out" aria-hidden /> {words.collide.leftOut}{" "}
        <i className="pair-mark" data-state="joined" aria-hidden /> {words.collide.joined} ·{" "}
        {words.collide.tried(samples)} {words.collide.matrixHint}
      </p>
    </>
  );
}

function Cell({ entry }: { entry: PairEntry }) {
  const says = words.collide.pair(entry.a, entry.b, entry.watched, words.collide.reasons[entry.reason]);
  if (entry.reason === "adjacent")
    return (
      <span className="pair-cell" title={says}>
        <i className="pair-mark" data-state="joined" aria-hidden />
        <span className="visually-hidden">{says}</span>
      </span>
    );
  return (
    <button
      className="pair-cell"
      aria-pressed={entry.watched}
      aria-label={says}
      title={says}
      onClick={() => edit(entry)}
    >
      <i className="pair-mark" data-state={entry.watched ? "checked" : "out"} aria-hidden />
    </button>
  );
}
