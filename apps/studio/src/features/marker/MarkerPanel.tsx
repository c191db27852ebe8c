import { BASE_MARKER, LENS_BOARD, type MarkerSheet, sheetSvg } from "@twincell/core/vision";
import { Crosshair, Hand, Printer, RotateCcw, X } from "lucide-react";
import { useEffect } from "react";
import { useStore } from "zustand";
import { beginCarry, endCarry } from "../../runtime/marker/carry.ts";
import { closeMarkerView, MARKER_SCALES, markerViewStore, openMarkerView } from "../../stores/marker-view.ts";
import { download } from "../../ui/download.ts";
import { HoldButton } from "../../ui/HoldButton.tsx";
import { NumberField } from "../../ui/NumberField.tsx";
import { Segments } from "../../ui/Choice.tsx";
import { PHONE, useMedia } from "../../ui/useMedia.ts";
import { say, words } from "../../messages/index.ts";
import "./marker.css";

const SAID = words.marker;
const MIN_SIDE_M = 0.02;
const MAX_SIDE_M = 1;
type ScaleName = keyof typeof SAID.scales;
const SCALE_NAMES = MARKER_SCALES.map(String) as ScaleName[];

/** The view through the camera: whether the marker is seen, what to print, and the device as a handle. */
export default function MarkerPanel() {
  const { views, problem, carrying } = useStore(markerViewStore);
  const phone = useMedia(PHONE);
  useEffect(() => endCarry, []);
  return (
    <section className="marker float" aria-label={SAID.title}>
      <header>
        <h2>{SAID.title}</h2>
        <button className="btn quiet icon" aria-label={SAID.close} title={SAID.close} onClick={closeMarkerView}>
          <X />
        </button>
      </header>
      <State />
      {problem === "" && views === null && (
        <>
          <HoldButton className="btn primary marker-carry" label={SAID.carry} onHold={beginCarry} onRelease={endCarry}>
            <Hand />
            {carrying ? SAID.carrying : SAID.carry}
          </HoldButton>
        </>
      )}
      <details className="small" open={!phone || views !== null}>
        <summary>{SAID.settings}</summary>
        <Size />
        <Printing />
      </details>
    </section>
  );
}

function State() {
  const { problem, camera, seen, distance_m, error_px, took_s, views } = useStore(markerViewStore);
  if (problem !== "")
    return (
      <p className="small marker-problem" role="alert">
        {say(problem)}{" "}
        <button
          className="btn tight"
          onClick={() => {
            closeMarkerView();
            openMarkerView();
          }}
        >
          <RotateCcw />
          {SAID.again}
        </button>
      </p>
    );
  const sentence =
    camera === ""
      ? SAID.asking
      : views !== null
        ? SAID.views(views)
        : seen
          ? SAID.seen(distance_m, error_px, took_s)
          : SAID.looking;
  return (
    <p className="small marker-state" role="status" data-seen={seen}>
      {sentence}
    </p>
  );
}

function Size() {
  const { scale, side_m, objects } = useStore(markerViewStore);
  return (
    <div className="marker-size">
      <Segments
        label={SAID.scale}
        value={String(scale) as ScaleName}
        options={SCALE_NAMES.map(value => ({ value, words: SAID.scales[value] }))}
        onChange={value => {
          const chosen = MARKER_SCALES.find(each => String(each) === value);
          if (chosen !== undefined) markerViewStore.setState({ scale: chosen });
        }}
      />
      <Segments
        label={SAID.objects}
        value={objects ? "cell" : "robot"}
        options={[
          { value: "robot", words: SAID.robotOnly },
          { value: "cell", words: SAID.wholeCell },
        ]}
        onChange={value => markerViewStore.setState({ objects: value === "cell" })}
      />
      <label className="marker-side small">
        <span aria-hidden>{SAID.side}</span>
        <NumberField
          label={SAID.side}
          quantity="length"
          value={side_m}
          min={MIN_SIDE_M}
          max={MAX_SIDE_M}
          decimals={1}
          onChange={value => markerViewStore.setState({ side_m: value })}
        />
      </label>
    </div>
  );
}

function Printing() {
  const { views, lens, calibration, camera } = useStore(markerViewStore);
  const calibrating = views !== null;
  return (
    <>
      <p className="marker-lens" role="status">
        {calibration === "" ? SAID.lens[lens] : say(calibration)}
      </p>
      <div className="marker-buttons">
        <button className="btn tight" onClick={() => print(BASE_MARKER, SAID.sheetTitle)}>
          <Printer />
          {SAID.sheet}
        </button>
        <button className="btn tight" onClick={() => print(LENS_BOARD, SAID.boardTitle)}>
          <Printer />
          {SAID.board}
        </button>
        <button
          className="btn tight"
          disabled={camera === ""}
          onClick={() => markerViewStore.setState({ views: calibrating ? null : 0, calibration: "" })}
        >
          <Crosshair />
          {calibrating ? SAID.cancel : SAID.calibrate}
        </button>
      </div>
    </>
  );
}

function print(sheet: MarkerSheet, title: string): void {
  download(
    `twincell-${sheet.name}.svg`,
    new Blob([sheetSvg(sheet, title, SAID.sheetBelow)], { type: "image/svg+xml" }),
  );
}
