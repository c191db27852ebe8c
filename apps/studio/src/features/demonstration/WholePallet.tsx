import { useEffect } from "react";
import { inferWholePallet, showsCycle, teachWholePallet } from "../../runtime/planning/whole-pallet.ts";
import type { OpenDemonstration } from "../../stores/demonstration.ts";
import { showNumber } from "../../ui/expression.ts";
import { NumberField } from "../../ui/NumberField.tsx";
import { words } from "../../messages/index.ts";

const MOST_PLACES = 400;
const mm = (length_m: number): string => showNumber(length_m, "length", 1);

/** One or two shown placements become the program for all of them: what was understood, and the button. */
export function WholePallet({ open }: { readonly open: OpenDemonstration }) {
  const { demonstration, pallet, places } = open;
  useEffect(() => inferWholePallet(undefined), [demonstration]);
  if (!showsCycle(demonstration) || !pallet) return null;
  const count = pallet.kind === "program" ? pallet.places : (places ?? 1);
  return (
    <section className="whole-pallet stack" aria-label={words.demonstration.pallet}>
      <h3 className="small">{words.demonstration.pallet}</h3>
      {pallet.kind === "program" ? (
        <p className="small" role="status">
          {words.demonstration.palletSays(pallet.part, pallet.surface, pallet.pallet.columns, pallet.pallet.rows)}{" "}
          {words.demonstration.palletRules(
            words.demonstration.gridRules[pallet.rules[0]],
            words.demonstration.gridRules[pallet.rules[1]],
          )}{" "}
          {words.demonstration.grasps[pallet.grasp]}{" "}
          {words.demonstration.palletOff(pallet.off_m.length, mm(Math.max(...pallet.off_m)), mm(pallet.approach_m))}
        </p>
      ) : (
        <p className="small" role="alert">
          {refusalWords(pallet)}
        </p>
      )}
      <div className="row-flex whole-pallet-row">
        <span className="small muted" aria-hidden>
          {words.demonstration.places}
        </span>
        <NumberField
          label={words.demonstration.places}
          quantity="plain"
          decimals={0}
          value={count}
          min={1}
          max={MOST_PLACES}
          onChange={(value, done) => {
            if (done) inferWholePallet(Math.round(value));
          }}
        />
        <span className="grow" />
        <button className="btn" disabled={pallet.kind !== "program"} onClick={teachWholePallet}>
          {words.demonstration.palletTeach}
        </button>
      </div>
    </section>
  );
}

function refusalWords(refusal: Exclude<OpenDemonstration["pallet"], null | { readonly kind: "program" }>): string {
  const { palletRefused } = words.demonstration;
  switch (refusal.why) {
    case "no-cycle":
      return palletRefused.noCycle;
    case "no-part":
      return palletRefused.noPart(refusal.position_m.map(mm).join(" "));
    case "several-feeders":
      return palletRefused.severalFeeders(mm(refusal.apart_m));
    case "no-surface":
      return palletRefused.noSurface(refusal.position_m.map(mm).join(" "));
    case "no-grid":
      return refusal.places === undefined ? palletRefused.noGrid : palletRefused.noGridOf(refusal.places);
    case "irregular":
      return palletRefused.irregular(mm(refusal.off_m));
  }
}
