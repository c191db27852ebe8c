import { sampleRate_Hz, type FilterOptions, type HandCheck } from "@twincell/core";
import { useMemo } from "react";
import { useStore } from "zustand";
import { closeDemonstration, refilter, teachDemonstration } from "../../runtime/planning/demonstrating.ts";
import { checkOpenHand } from "../../runtime/planning/whole-pallet.ts";
import { demonstrationStore, type OpenDemonstration } from "../../stores/demonstration.ts";
import { dialogStore } from "../../stores/dialogs.ts";
import { Segments } from "../../ui/Choice.tsx";
import { showNumber } from "../../ui/expression.ts";
import { Frame } from "../../ui/Frame.tsx";
import { NumberField } from "../../ui/NumberField.tsx";
import { say, words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";
import { WholePallet } from "./WholePallet.tsx";
import "./demonstration.css";

/** A recorded hand: what the filters make of it, how far that is off, and the steps it becomes. */
export default function DemonstrationDialog() {
  const shown = useStore(dialogStore, state => state.open === "demonstration");
  const open = useStore(demonstrationStore, state => state.open);
  return (
    <Frame
      open={shown && open !== null}
      title={open?.name ?? words.demonstration.title}
      onClose={closeDemonstration}
      width={460}
      foot={
        <>
          <button className="btn" onClick={closeDemonstration}>
            {words.common.cancel}
          </button>
          <span className="grow" />
          <button className="btn primary" disabled={!open?.filtered || open.working} onClick={teachDemonstration}>
            {words.demonstration.teach}
          </button>
        </>
      }
    >
      {open && <Body open={open} />}
    </Frame>
  );
}

function Body({ open }: { readonly open: OpenDemonstration }) {
  const { demonstration, dropped, filtered, options } = open;
  const hand = useMemo(() => checkOpenHand(demonstration), [demonstration]);
  const count = (kind: string): string => String(filtered?.parts.filter(part => part.kind === kind).length ?? 0);
  const mm = (length_m: number): string => `${showNumber(length_m, "length", 2)} mm`;
  const facts = [
    [words.demonstration.samples, words.demonstration.samplesSay(demonstration.times_s.length, dropped)],
    [words.demonstration.rate, words.demonstration.rateSays(fixed(sampleRate_Hz(demonstration), 0))],
    [words.demonstration.stops, count("stop")],
    [words.demonstration.straights, count("straight")],
    [words.demonstration.curves, count("curve")],
    [words.demonstration.points, String(filtered?.points ?? 0)],
    [words.demonstration.largest, filtered ? mm(filtered.deviation.max_m) : "–"],
    [words.demonstration.rms, filtered ? mm(filtered.deviation.rms_m) : "–"],
    [
      words.demonstration.fastest,
      hand?.speed ? words.demonstration.jointShare(hand.speed.joint, Math.round(100 * hand.speed.fraction)) : "–",
    ],
    [
      words.demonstration.torque,
      hand?.torque ? words.demonstration.jointShare(hand.torque.joint, Math.round(100 * hand.torque.fraction)) : "–",
    ],
  ] as const;
  return (
    <div className="stack demonstration">
      <p className="small demonstration-key">
        <i className="demonstration-original" aria-hidden /> {words.demonstration.original}
        <i className="demonstration-filtered" aria-hidden /> {words.demonstration.filtered}
      </p>
      <dl className="facts">
        {facts.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd className="num">{value}</dd>
          </div>
        ))}
      </dl>
      {hand && (
        <p className="small demonstration-hand" data-verdict={handVerdict(hand)} role="status">
          <i className="mark" data-verdict={handVerdict(hand)} aria-hidden /> {handWords(hand)}
          {hand.torqueUnknown !== null && ` ${say(hand.torqueUnknown)}`}
        </p>
      )}
      <div className="demonstration-options">
        {(["rest_m", "straight_m"] as const).map(which => (
          <div key={which} className="stack labelled">
            <span className="small muted" aria-hidden>
              {words.demonstration.options[which]}
            </span>
            <NumberField
              label={words.demonstration.options[which]}
              quantity="length"
              value={options[which]}
              min={0.0001}
              max={0.1}
              decimals={1}
              onChange={value_m => refilter({ [which]: value_m })}
            />
          </div>
        ))}
      </div>
      <Segments<FilterOptions["curves"]>
        label={words.demonstration.fit}
        value={options.curves}
        onChange={curves => refilter({ curves })}
        options={[
          { value: "fitted", words: words.demonstration.fits.fitted },
          { value: "averaged", words: words.demonstration.fits.averaged },
        ]}
      />
      <WholePallet open={open} />
    </div>
  );
}

const handVerdict = ({ unreached, speed, torque }: HandCheck): "ok" | "bad" =>
  unreached > 0 || (speed?.fraction ?? 0) > 1 || (torque?.fraction ?? 0) > 1 ? "bad" : "ok";

/** Whether the robot could follow the hand as it went; what is beyond it first. */
function handWords({ unreached, first, speed, torque }: HandCheck): string {
  if (first) return `${words.demonstration.unreached(unreached, fixed(first.at_s, 2))} ${say(first.sentence)}`;
  if ((speed?.fraction ?? 0) > 1) return words.demonstration.tooFast(speed!.joint, fixed(speed!.at_s, 2));
  if ((torque?.fraction ?? 0) > 1) return words.demonstration.tooHeavy(torque!.joint, fixed(torque!.at_s, 2));
  return words.demonstration.follows;
}
