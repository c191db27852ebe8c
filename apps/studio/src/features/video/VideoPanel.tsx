import { Link2, Maximize, RotateCcw, Timer, X } from "lucide-react";
import { useEffect, useRef } from "react";
import { useStore } from "zustand";
import { heldAt_s } from "../../runtime/video/video-delay.ts";
import { onPicture, type Feed } from "../../runtime/video/feed.ts";
import { feedOf, hideCamera, tryAgain } from "../../runtime/video/feeds.ts";
import { freshness } from "../../runtime/video/freshness.ts";
import { videoStore, type VideoPanel as Panel } from "../../stores/video.ts";
import { Tip } from "../../ui/Tip.tsx";
import { say, words } from "../../messages/index.ts";
import { ageWords } from "../../messages/phrases.ts";
import { movable } from "./movable.ts";

const SAY_EVERY_MS = 250;

/** One camera: its picture, how old it is, and what can be done with it. */
export function VideoPanel({
  panel: { id, name, source, trouble: problem },
  place,
}: {
  readonly panel: Panel;
  readonly place: number;
}) {
  const frame = useRef<HTMLElement>(null);
  const grip = useRef<HTMLDivElement>(null);
  const held = useStore(videoStore, state => state.heldBy === id);
  useEffect(() => (frame.current && grip.current ? movable(frame.current, grip.current, place) : undefined), [place]);
  return (
    <section ref={frame} className="video-panel" aria-label={words.video.panel(name)} data-trouble={problem !== ""}>
      <header>
        <div
          ref={grip}
          className="video-grip"
          tabIndex={0}
          role="button"
          aria-label={words.video.move}
          title={words.video.move}
        >
          {name}
        </div>
        <Age id={id} />
        <Tip words={`${words.video.hold}. ${words.video.holdTip}`}>
          <button
            className="btn quiet icon"
            aria-label={words.video.hold}
            aria-pressed={held}
            onClick={() => videoStore.setState({ heldBy: held ? null : id })}
          >
            <Link2 />
          </button>
        </Tip>
        <Tip words={words.video.measure}>
          <button
            className="btn quiet icon"
            aria-label={words.video.measure}
            onClick={() => videoStore.setState({ measured: id })}
          >
            <Timer />
          </button>
        </Tip>
        <Tip words={words.video.full}>
          <button
            className="btn quiet icon"
            aria-label={words.video.full}
            onClick={() => {
              if (frame.current)
                void (document.fullscreenElement ? document.exitFullscreen() : frame.current.requestFullscreen());
            }}
          >
            <Maximize />
          </button>
        </Tip>
        <Tip words={words.video.close}>
          <button className="btn quiet icon" aria-label={words.video.close} onClick={() => hideCamera(id)}>
            <X />
          </button>
        </Tip>
      </header>
      <Picture id={id} trouble={problem} />
      {problem && (
        <p className="video-trouble" role="status">
          {say(problem)}{" "}
          {source.kind === "here" && problem !== words.video.asking && (
            <button className="btn tight" onClick={() => tryAgain(id)}>
              <RotateCcw />
              {words.video.again}
            </button>
          )}
        </p>
      )}
      <footer className="small">
        <span>{words.video.noSafety}</span>
        {held && <Held />}
      </footer>
    </section>
  );
}

/** Calls `write` four times a second, outside React. */
function useSaying(write: () => void): void {
  const latest = useRef(write);
  useEffect(() => {
    latest.current = write;
  });
  useEffect(() => {
    latest.current();
    const timer = setInterval(() => {
      latest.current();
    }, SAY_EVERY_MS);
    return () => {
      clearInterval(timer);
    };
  }, []);
}

/** The feed's own canvas, and over it what is to be known about it. */
function Picture({ id, trouble: problem }: { readonly id: string; readonly trouble: string }) {
  const box = useRef<HTMLDivElement>(null);
  const says = useRef<HTMLParagraphElement>(null);
  useEffect(() => {
    const canvas = feedOf(id)?.canvas;
    const into = box.current;
    if (!canvas || !into) return;
    into.prepend(canvas);
    return () => {
      canvas.remove();
    };
  }, [id]);
  useSaying(() => {
    const feed = feedOf(id);
    const element = says.current;
    if (!feed || !element || !box.current) return;
    const now = freshness(feed.times, performance.now() / 1000);
    const text =
      now.kind === "late"
        ? words.video.late(now.age_s)
        : now.kind === "still"
          ? words.video.still(now.still_s)
          : now.kind === "none" && problem === ""
            ? words.video.waiting
            : "";
    box.current.dataset["state"] = now.kind;
    if (element.textContent !== text) element.textContent = text;
  });
  return (
    <div ref={box} className="video-picture" data-state="none">
      <p ref={says} className="video-says" role="status" />
    </div>
  );
}

const agesOf = (feed: Feed): number => (feed.times ? Math.max(0, feed.times.shown_s - feed.times.captured_s) : NaN);

/**
 * The running estimate, quietly: the middle of the last pictures' ages, with how far the clocks may be off in its tip.
 */
function Age({ id }: { readonly id: string }) {
  const element = useRef<HTMLSpanElement>(null);
  const ages = useRef<number[]>([]);
  useEffect(
    () =>
      onPicture(id, feed => {
        ages.current.push(agesOf(feed));
        if (ages.current.length > 30) ages.current.shift();
      }),
    [id],
  );
  useSaying(() => {
    const feed = feedOf(id);
    const sorted = ages.current.toSorted((a, b) => a - b);
    const at = element.current;
    if (!feed || !at || sorted.length === 0) return;
    at.textContent = ageWords(sorted[sorted.length >> 1]!);
    const { stages } = feed;
    const { ms } = words.video;
    at.title = `${words.video.ageTip} ${words.video.uncertain(feed.uncertain_s)}${stages ? `\n${words.video.stages(ms(stages.taken_s), ms(stages.toServer_s), ms(stages.toHere_s), ms(stages.unpacked_s))}` : ""}`;
  });
  return <span ref={element} className="video-age small" />;
}

function Held() {
  const element = useRef<HTMLSpanElement>(null);
  useSaying(() => {
    const at_s = heldAt_s();
    if (element.current)
      element.current.textContent =
        at_s === null ? words.video.heldNot : words.video.heldBack(performance.now() / 1000 - at_s);
  });
  return <span ref={element} role="status" className="video-held" />;
}
