import { degrees } from "@twincell/core";
import { useEffect, useState } from "react";
import { useStore } from "zustand";
import {
  beginCalibration,
  beginRecording,
  closeGlove,
  endRecording,
  keepCalibration,
  openGlove,
  takeRest,
  type SerialLine,
} from "../../runtime/glove.ts";
import { registerCommands } from "../../stores/commands.ts";
import { closeDialog, dialogStore, openDialog } from "../../stores/dialogs.ts";
import { gloveStore, readHands, wearerOf, type Calibration } from "../../stores/glove.ts";
import { notify } from "../../stores/notices.ts";
import { Frame } from "../../ui/Frame.tsx";
import { NumberField } from "../../ui/NumberField.tsx";
import { words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";
import "./glove.css";

/** Fewer counts are no moving finger; the bar is full at this many. */
const WIDE = 1000;
/** 100 mV for each g, a common tracker [m/s² per V]. */
const FIRST_SLOPE = 9.6;

/** Asks the person for a serial line; null when the browser has none or nothing was chosen. */
async function chosenLine(): Promise<SerialLine | null> {
  const serial: unknown = Reflect.get(navigator, "serial");
  if (typeof serial !== "object" || serial === null || !("requestPort" in serial)) {
    notify("warn", words.glove.unsupported);
    return null;
  }
  try {
    return await (serial as { requestPort(): Promise<SerialLine> }).requestPort();
  } catch {
    return null; // the person closed the chooser
  }
}

/** A data glove with a tracker: connected, calibrated for the one who wears it, and recorded. */
export default function GloveDialog() {
  const shown = useStore(dialogStore, state => state.open === "glove");
  const state = useStore(gloveStore);
  useEffect(() => {
    readHands(localStorage);
    return registerCommands([
      { id: "glove.open", group: "program", words: words.glove.command, run: () => openDialog("glove") },
    ]);
  }, []);
  const isOpen = state.link === "open";
  const connect = async (): Promise<void> => {
    const line = await chosenLine();
    if (line) await openGlove(line);
  };
  return (
    <Frame
      open={shown}
      title={words.glove.title}
      onClose={closeDialog}
      width={440}
      foot={
        <>
          <button
            className="btn"
            disabled={state.link === "opening"}
            onClick={() => void (isOpen ? closeGlove() : connect())}
          >
            {isOpen ? words.glove.disconnect : words.glove.connect}
          </button>
          <span className="grow" />
          <button
            className="btn primary"
            disabled={!isOpen || !wearerOf(state) || state.calibration !== null}
            onClick={() => (state.recording ? endRecording() : beginRecording())}
          >
            {state.recording ? words.glove.stop : words.glove.record}
          </button>
        </>
      }
    >
      <div className="stack glove">
        <p className="small" role="status">
          {isOpen ? words.glove.reads(state.samples, fixed(state.rate_Hz, 0), state.dropped) : words.glove.none}
        </p>
        <div className="pair">
          <span className="label">{words.glove.wearer}</span>
          <span className="field">
            <select
              aria-label={words.glove.wearer}
              value={state.wearer}
              onChange={event => gloveStore.setState({ wearer: event.currentTarget.value })}
            >
              {state.profiles.length === 0 && <option value="">{words.glove.nobody}</option>}
              {state.profiles.map(({ name }) => (
                <option key={name}>{name}</option>
              ))}
            </select>
          </span>
        </div>
        {state.calibration ? (
          <Wizard calibration={state.calibration} />
        ) : (
          <>
            {words.glove.fingers.map((finger, i) => (
              <Bar
                key={finger}
                label={finger}
                share={isOpen ? (state.bends_rad[i] ?? 0) / (Math.PI / 2) : 0}
                says={isOpen ? `${fixed(degrees(state.bends_rad[i] ?? 0), 0)}°` : "–"}
              />
            ))}
            {isOpen && <p className="small dim">{state.closed ? words.glove.hand.closed : words.glove.hand.open}</p>}
            <button className="btn" disabled={!isOpen || state.recording} onClick={beginCalibration}>
              {words.glove.calibrate}
            </button>
          </>
        )}
      </div>
    </Frame>
  );
}

/** Ranges of the fingers, the tracker at rest, its sensitivity, and whose hand it is. */
function Wizard({ calibration }: { readonly calibration: Calibration }) {
  const [name, setName] = useState("");
  const [slope, setSlope] = useState(FIRST_SLOPE);
  return (
    <>
      <p className="small">{words.glove.sweepSays}</p>
      {calibration.sweeps.map(({ low, high }, i) => {
        const counts = Math.max(0, high - low);
        return (
          <Bar
            key={words.glove.fingers[i]}
            label={words.glove.fingers[i]!}
            share={Math.min(1, counts / WIDE)}
            says={words.glove.counts(Number.isFinite(counts) ? counts : 0)}
          />
        );
      })}
      <div className="pair">
        <span className="small">{words.glove.restSays}</span>
        <button className="btn" onClick={takeRest}>
          {words.glove.rest}
        </button>
      </div>
      <div className="pair">
        <span className="small">{words.glove.slopeSays}</span>
        <NumberField
          label={words.glove.slope}
          quantity="plain"
          value={slope}
          min={0.01}
          max={1000}
          decimals={3}
          onChange={setSlope}
        />
      </div>
      <div className="pair">
        <span className="label">{words.glove.name}</span>
        <span className="field text">
          <input
            aria-label={words.glove.name}
            value={name}
            maxLength={40}
            onChange={event => setName(event.currentTarget.value)}
          />
        </span>
      </div>
      <div className="row-flex">
        <button className="btn" onClick={() => gloveStore.setState({ calibration: null })}>
          {words.common.cancel}
        </button>
        <button
          className="btn primary grow"
          disabled={name.trim() === ""}
          onClick={() => keepCalibration(name, slope, localStorage)}
        >
          {words.glove.keep}
        </button>
      </div>
    </>
  );
}

const Bar = ({ label, share, says }: { readonly label: string; readonly share: number; readonly says: string }) => (
  <div className="glove-bar">
    <span className="small">{label}</span>
    <span className="progress" aria-hidden>
      <i style={{ width: `${share * 100}%` }} />
    </span>
    <span className="num small">{says}</span>
  </div>
);
