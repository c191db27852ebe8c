import { Ruler, X } from "lucide-react";
import { useStore } from "zustand";
import { buildStore } from "../../stores/build.ts";
import { clearMeasure, measureStore } from "../../stores/measure.ts";
import { showNumber } from "../../ui/expression.ts";
import { words } from "../../messages/index.ts";
import "./build.css";

const MARKS = ["ΔX", "ΔY", "ΔZ"] as const;

/** What was measured between two picks. */
export function MeasureCard() {
  const measuring = useStore(buildStore, state => state.tool === "measure");
  const { picks, result, clearance } = useStore(measureStore);
  if (!measuring) return null;
  return (
    <section className="measure-card float" aria-label={words.build.tools.measure}>
      {result ? (
        <>
          <h2 className="row-flex">
            <Ruler aria-hidden />
            <b>{showNumber(result.distance_m, "length", 1)}</b>
            <span className="dim">mm</span>
            <span className="grow" />
            <button className="btn quiet icon tight" aria-label={words.build.clearMeasure} onClick={clearMeasure}>
              <X />
            </button>
          </h2>
          <dl>
            {MARKS.map((mark, k) => (
              <div key={mark}>
                <dt>{mark}</dt>
                <dd>{showNumber(result.delta_m[k]!, "length", 1)}</dd>
              </div>
            ))}
            {result.angle_rad !== null && (
              <div>
                <dt>{words.build.angle}</dt>
                <dd>{showNumber(result.angle_rad, "angle", 1)}°</dd>
              </div>
            )}
          </dl>
          {clearance && (
            <p className="small" data-touching={clearance.distance_m === 0}>
              {clearance.distance_m === 0
                ? words.build.interfere
                : words.build.clearance(showNumber(clearance.distance_m, "length", 1))}
            </p>
          )}
        </>
      ) : (
        <p className="small" role="status">
          {picks.length === 0 ? words.build.pickFirst : words.build.pickSecond}
        </p>
      )}
    </section>
  );
}
