import { Combine } from "lucide-react";
import { useEffect } from "react";
import { useStore } from "zustand";
import { buildStore } from "../../stores/build.ts";
import { changeMate, clearMate, mateStore } from "../../stores/mate.ts";
import { NumberField } from "../../ui/NumberField.tsx";
import { words } from "../../messages/index.ts";
import "./build.css";

/** What is to be picked for a mate, and what can be changed of the one that was made. */
export function MateCard() {
  const mating = useStore(buildStore, state => state.tool === "mate");
  return mating ? <Card /> : null;
}

function Card() {
  const { moving, fixed, flipped, offset_m } = useStore(mateStore);
  useEffect(() => clearMate, []);
  const isFace = moving?.feature.kind === "plane";
  const hasGap = isFace || (moving?.feature.kind === "circle" && fixed?.feature.kind === "circle");
  return (
    <section className="measure-card float" aria-label={words.build.tools.mate}>
      {moving && fixed ? (
        <>
          <h2 className="row-flex">
            <Combine aria-hidden />
            <b>{isFace ? words.mate.planes : words.mate.axes}</b>
          </h2>
          {hasGap && (
            <div className="pair">
              <span className="label">{isFace ? words.mate.gap : words.mate.shift}</span>
              <NumberField
                label={isFace ? words.mate.gap : words.mate.shift}
                mark="↕"
                quantity="length"
                min={-5}
                max={5}
                value={offset_m}
                onChange={(value, done) => changeMate({ offset_m: value }, done)}
              />
            </div>
          )}
          <button className="btn" aria-pressed={flipped} onClick={() => changeMate({ flipped: !flipped }, true)}>
            {words.mate.flip}
          </button>
          <button className="btn quiet" onClick={clearMate}>
            {words.mate.again}
          </button>
        </>
      ) : (
        <p className="small" role="status">
          {moving ? words.mate.pickFixed : words.mate.pickMoving}
        </p>
      )}
    </section>
  );
}
