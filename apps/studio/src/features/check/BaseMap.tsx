import type { SuggestedBase } from "@twincell/core";
import { useStore } from "zustand";
import { moveToSuggestedBase } from "../../runtime/planning/base-map.ts";
import { baseMapStore, showBaseMap } from "../../stores/base-map.ts";
import { connectionStore } from "../../stores/connection.ts";
import { words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";

/** The switch of the base position map, what its colours mean, and the place that it suggests. */
export function BaseMap() {
  const { on, field, best, share } = useStore(baseMapStore);
  return (
    <section aria-label={words.check.baseMap}>
      <h2 className="heading">
        <label className="row-flex grow" title={words.check.baseMapTip}>
          <input type="checkbox" checked={on} onChange={event => showBaseMap(event.currentTarget.checked)} />
          {words.check.baseMap}
        </label>
      </h2>
      {on && (
        <div className="section stack" aria-busy={share !== null}>
          <div className="base-map-scale" aria-hidden />
          <div className="row-flex small dim base-map-words">
            <span>{words.check.baseMapSome}</span>
            <span>{words.check.baseMapAll}</span>
            <span>{words.check.baseMapRoom}</span>
          </div>
          {share !== null ? (
            <p className="small muted" role="status">
              {words.check.baseMapSearching(Math.round(share * 100))}
            </p>
          ) : field?.points === 0 ? (
            <p className="small muted">{words.check.baseMapNoPoints}</p>
          ) : best === null ? (
            <p className="small muted">{words.check.baseMapNone}</p>
          ) : (
            best && field && <Suggestion best={best} points={field.points} />
          )}
        </div>
      )}
    </section>
  );
}

function Suggestion({ best, points }: { readonly best: SuggestedBase; readonly points: number }) {
  const connected = useStore(connectionStore, state => state.station !== null);
  if (Math.hypot(best.x_m, best.y_m) < 1e-9) return <p className="small">{words.check.baseMapHere}</p>;
  return (
    <div className="stack">
      <p className="small">
        <b>{words.check.baseMapBest(signed(best.x_m), signed(best.y_m))}</b>
        <br />
        <span className="muted">{words.check.baseMapSays(best.roomy, points, fixed(best.duration_s, 1))}</span>
      </p>
      {connected ? (
        <p className="small muted">{words.check.baseMapConnected}</p>
      ) : (
        <button className="btn" onClick={() => moveToSuggestedBase(best)}>
          {words.check.baseMapMove}
        </button>
      )}
    </div>
  );
}

const signed = (length_m: number): string => `${length_m < 0 ? "−" : "+"}${fixed(Math.abs(length_m * 1000), 0)}`;
