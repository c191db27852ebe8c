import { RotateCcw } from "lucide-react";
import { useEffect, useRef, useState } from "react";
import { useStore } from "zustand";
import { feedOf } from "../../runtime/video/feeds.ts";
import { onPicture } from "../../runtime/video/feed.ts";
import { createMeasurement, figuresOf, type LatencyFigures } from "../../runtime/video/measurement.ts";
import { watchCodes } from "../../runtime/video/sightings.ts";
import { CODE_CELLS, codeCells } from "../../runtime/video/time-code.ts";
import { videoStore } from "../../stores/video.ts";
import { Frame } from "../../ui/Frame.tsx";
import { words } from "../../messages/index.ts";

/** A cell and the white about the code: a tenth of the code is one cell on each side. */
const CELL_PX = 32;
const QUIET_CELLS = 1.5;
const SIDE_PX = CELL_PX * (CODE_CELLS + 2 * QUIET_CELLS);
const SAY_EVERY_MS = 300;
type Sees = keyof typeof words.video.sees;

/** Glass to glass: this screen shows a clock, the camera films it, and what comes back tells how old it is. */
export function Measure({ id }: { readonly id: string }) {
  const [round, setRound] = useState(0);
  const name = useStore(videoStore, state => state.panels.find(panel => panel.id === id)?.name ?? "");
  const close = (): void => videoStore.setState({ measured: null });
  return (
    <Frame
      open
      title={`${words.video.measure}: ${name}`}
      onClose={close}
      width={820}
      foot={
        <>
          <span className="grow small muted">{words.video.glassSays}</span>
          <button className="btn" onClick={() => setRound(round + 1)}>
            <RotateCcw />
            {words.video.anew}
          </button>
        </>
      }
    >
      <Round key={round} id={id} />
    </Frame>
  );
}

function Round({ id }: { readonly id: string }) {
  const pattern = useRef<HTMLCanvasElement>(null);
  const mirror = useRef<HTMLCanvasElement>(null);
  const [sees, setSees] = useState<Sees>("nothing");
  const [figures, setFigures] = useState<LatencyFigures | null>(null);
  const [estimate_s, setEstimate] = useState<number | null>(null);
  useEffect(() => {
    const feed = feedOf(id);
    const canvas = pattern.current;
    if (!feed || !canvas) return;
    const measurement = createMeasurement(Math.random());
    const estimates_s: number[] = [];
    let drawn = -1;
    let handle = 0;
    let last: Sees = "nothing";
    const draw = (): void => {
      const code = measurement.codeAt(performance.now() / 1000);
      if (code.counter !== drawn) {
        drawn = code.counter;
        drawCode(canvas, codeCells(code));
      }
      handle = requestAnimationFrame(draw);
    };
    draw();
    const stopWatching = watchCodes(feed, measurement.session, ({ sighting, drawn_s }) => {
      last = sighting.kind;
      if (sighting.kind === "read" && measurement.seen(sighting.codes, drawn_s) !== null)
        canvas.dataset["counted"] = String(measurement.figures?.n ?? 0);
    });
    const stopMirror = onPicture(id, ({ canvas: picture, times }) => {
      const small = mirror.current;
      if (small) small.getContext("2d")!.drawImage(picture, 0, 0, small.width, small.height);
      if (times && Number.isFinite(times.captured_s)) {
        estimates_s.push(Math.max(0, times.shown_s - times.captured_s));
        if (estimates_s.length > 600) estimates_s.shift();
      }
    });
    const timer = setInterval(() => {
      const still = performance.now() / 1000 - (feed.times?.shown_s ?? -Infinity) > 1;
      setSees(still ? "nothing" : last);
      setFigures(measurement.figures);
      setEstimate(figuresOf(estimates_s)?.median_s ?? null);
    }, SAY_EVERY_MS);
    return () => {
      cancelAnimationFrame(handle);
      clearInterval(timer);
      stopWatching();
      stopMirror();
    };
  }, [id]);
  const { figures: name, ms } = words.video;
  const none = "–";
  return (
    <div className="video-measure">
      <canvas
        ref={pattern}
        className="video-pattern"
        width={SIDE_PX}
        height={SIDE_PX}
        role="img"
        aria-label={words.video.pattern}
      />
      <div className="stack">
        <p className="small">{words.video.measureSays}</p>
        <canvas ref={mirror} className="video-mirror" width={256} height={144} aria-hidden />
        <p role="status" className="small" data-sees={sees}>
          {words.video.sees[sees]}
        </p>
        <dl className="facts" aria-label={words.video.glass}>
          <div>
            <dt>{name.median}</dt>
            <dd data-figure="median">{figures ? ms(figures.median_s) : none}</dd>
          </div>
          <div>
            <dt>{name.p95}</dt>
            <dd data-figure="p95">{figures ? ms(figures.p95_s) : none}</dd>
          </div>
          <div>
            <dt>{name.spread}</dt>
            <dd data-figure="spread">{figures ? `${ms(figures.least_s)} … ${ms(figures.most_s)}` : none}</dd>
          </div>
          <div>
            <dt>{name.n}</dt>
            <dd data-figure="n">{figures?.n ?? 0}</dd>
          </div>
          <div>
            <dt>{name.estimate}</dt>
            <dd data-figure="estimate">{estimate_s === null ? none : ms(estimate_s)}</dd>
          </div>
        </dl>
      </div>
    </div>
  );
}

/** Pure black and white, whatever the theme. */
function drawCode(canvas: HTMLCanvasElement, cells: Uint8Array): void {
  const context = canvas.getContext("2d")!;
  context.fillStyle = "#fff";
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.fillStyle = "#000";
  for (let i = 0; i < cells.length; i++)
    if (cells[i] === 1)
      context.fillRect(
        (QUIET_CELLS + (i % CODE_CELLS)) * CELL_PX,
        (QUIET_CELLS + Math.floor(i / CODE_CELLS)) * CELL_PX,
        CELL_PX,
        CELL_PX,
      );
}
