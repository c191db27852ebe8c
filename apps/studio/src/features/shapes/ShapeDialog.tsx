import { useState } from "react";
import { useStore } from "zustand";
import { cancelShapes, correctUnit, makeLight } from "../../runtime/mesh-import.ts";
import { cellStore } from "../../stores/cell.ts";
import { closeDialog, dialogStore } from "../../stores/dialogs.ts";
import { cardOf, shapeStore, type ShapeCard } from "../../stores/shapes.ts";
import { Segments } from "../../ui/Choice.tsx";
import { showNumber } from "../../ui/expression.ts";
import { Frame } from "../../ui/Frame.tsx";
import { say, words } from "../../messages/index.ts";
import { whole } from "../../messages/numbers.ts";
import "./shapes.css";

const UNITS = ["0.001", "0.01", "1", "0.0254"] as const;
/** What a phone or headset draws without effort, beside the rest of a cell. */
const LIGHT_TRIANGLES = 80_000;
const mm = (length_m: number, digits: number): string => `${showNumber(length_m, "length", digits)} mm`;

/** What came of an import: what it measures, what was mended, its unit to be corrected, and fewer triangles. */
export default function ShapeDialog() {
  const open = useStore(dialogStore, state => state.open === "shapes");
  const busy = useStore(shapeStore, state => state.busy);
  const shown = useStore(shapeStore, state => state.shown);
  const card = useStore(cellStore, state => cardOf(state.document, shown));
  const close = (): void => {
    if (shapeStore.getState().busy) cancelShapes();
    closeDialog();
  };
  return (
    <Frame open={open} title={card?.file ?? words.shapes.title} onClose={close} width={560}>
      {open && busy?.what === "reading" && (
        <div className="shape-busy" role="status">
          <span>{words.shapes.reading(busy.file)}</span>
          <button className="btn" onClick={cancelShapes}>
            {words.shapes.cancel}
          </button>
        </div>
      )}
      {open && card && busy?.what !== "reading" && <Body key={card.file} card={card} busy={busy !== null} />}
    </Frame>
  );
}

function Body({ card, busy }: { card: ShapeCard; busy: boolean }) {
  const { report, unit } = card;
  const facts = [
    [words.shapes.format, report.format],
    [words.shapes.size, `${report.size_m.map(side => showNumber(side, "length", 1)).join(" × ")} mm`],
    [words.shapes.triangles, whole(report.triangles)],
    [words.shapes.parts, whole(report.parts)],
    [words.shapes.materials, whole(report.materials)],
    [words.shapes.openEdges, whole(report.openEdges)],
  ] as const;
  return (
    <div className="stack shapes" aria-busy={busy}>
      <dl className="facts">
        {facts.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd className="num">{value}</dd>
          </div>
        ))}
      </dl>
      <section className="stack" aria-label={words.shapes.unit}>
        <h3 className="label">{words.shapes.unit}</h3>
        <Segments
          label={words.shapes.unit}
          value={String(unit.metresPerUnit)}
          options={UNITS.map(value => ({ value: value as string, words: words.shapes.units[value], disabled: busy }))}
          onChange={value => void correctUnit(card, Number(value))}
        />
        {unit.sentence !== "" && (
          <p className="small muted" data-certainty={unit.certainty}>
            {unit.certainty === "doubtful" && <b>{words.shapes.doubtful} </b>}
            {say(unit.sentence)}
          </p>
        )}
      </section>
      <section aria-label={words.shapes.fixes}>
        <h3 className="label">{words.shapes.fixes}</h3>
        {report.fixes.length === 0 ? (
          <p className="small muted">{words.shapes.noFixes}</p>
        ) : (
          <ul className="shape-fixes small">
            {report.fixes.map(fix => (
              <li key={fix}>{say(fix)}</li>
            ))}
          </ul>
        )}
      </section>
      <Light card={card} busy={busy} />
    </div>
  );
}

function Light({ card, busy }: { card: ShapeCard; busy: boolean }) {
  const { light } = card;
  const triangles = light?.faces ?? card.report.triangles;
  const [adapters, setFaces] = useState(() => Math.min(LIGHT_TRIANGLES, Math.max(4, Math.floor(triangles / 4))));
  const rows = light && [
    [words.shapes.triangles, whole(light.faces_before), whole(light.faces)],
    [words.shapes.materials, whole(light.materials_before), whole(light.materials)],
    [words.shapes.openEdges, whole(light.open_edges_before), whole(light.open_edges)],
  ];
  const measured = light && [
    [words.shapes.maxDeviation, light.max_deviation_m],
    [words.shapes.rmsDeviation, light.rms_deviation_m],
    [words.shapes.boundsChange, light.bounds_change_m],
  ];
  return (
    <section className="stack" aria-label={words.shapes.light}>
      <h3 className="label">{words.shapes.light}</h3>
      <p className="small muted">{words.shapes.lightSays}</p>
      <div className="shape-light">
        <label>
          <span className="small">{words.shapes.target}</span>
          <input
            className="input num"
            type="number"
            min={4}
            max={triangles}
            value={adapters}
            onChange={event => setFaces(Math.round(event.currentTarget.valueAsNumber))}
          />
        </label>
        <button
          className="btn"
          disabled={busy || !(adapters >= 4 && adapters < triangles)}
          onClick={() => void makeLight(card, adapters)}
        >
          {busy ? words.shapes.working : words.shapes.light}
        </button>
      </div>
      {rows && measured && (
        <>
          <table className="shape-table">
            <thead>
              <tr>
                <td />
                <th scope="col">{words.shapes.before}</th>
                <th scope="col">{words.shapes.after}</th>
              </tr>
            </thead>
            <tbody>
              {rows.map(([name, before, after]) => (
                <tr key={name}>
                  <th scope="row">{name}</th>
                  <td className="num">{before}</td>
                  <td className="num">{after}</td>
                </tr>
              ))}
              {measured.map(([name, value]) => (
                <tr key={name}>
                  <th scope="row">{name}</th>
                  <td />
                  <td className="num">{mm(Number(value), 3)}</td>
                </tr>
              ))}
            </tbody>
          </table>
          <p className="small muted">{words.shapes.samples(light.samples)}</p>
        </>
      )}
    </section>
  );
}
