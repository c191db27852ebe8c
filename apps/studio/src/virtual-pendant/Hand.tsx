import { Power } from "lucide-react";
import { useEffect, useState } from "react";
import { useStore } from "zustand";
import { Segments } from "../ui/Choice.tsx";
import { HoldButton } from "../ui/HoldButton.tsx";
import { Slide } from "../ui/Slide.tsx";
import { words } from "../messages/index.ts";
import type { VirtualPendantLink } from "./link.ts";

/** What the hands are on: mode key, enabling switch, drives, speed. */
export function Hand({ link, alone }: { readonly link: VirtualPendantLink; readonly alone: boolean }) {
  const told = useStore(link.view, state => state.words)!;
  const lamps = useStore(link.view, state => state.lamps)!;
  const [kept, setKept] = useState(false);
  const [drag, setDrag] = useState<number | null>(null);
  const isManual = told.keys.find(({ id }) => id === lamps.key)?.mode === "manual";
  useEffect(() => {
    const letGo = (): void => {
      setKept(false);
      link.letGo();
    };
    const hidden = (): void => {
      if (document.hidden) letGo();
    };
    addEventListener("blur", letGo);
    addEventListener("pagehide", letGo);
    document.addEventListener("visibilitychange", hidden);
    return () => {
      removeEventListener("blur", letGo);
      removeEventListener("pagehide", letGo);
      document.removeEventListener("visibilitychange", hidden);
      link.letGo();
    };
  }, [link]);
  // On a page of its own the key E is the enabling switch, so that a mouse is free for the jog keys.
  useEffect(() => {
    if (!alone) return;
    const isSwitch = (event: KeyboardEvent): boolean =>
      event.key.toLowerCase() === "e" && !event.ctrlKey && !event.metaKey && !event.altKey;
    const down = (event: KeyboardEvent): void => {
      if (isSwitch(event) && !event.repeat) link.enable(true);
    };
    const up = (event: KeyboardEvent): void => {
      if (isSwitch(event)) {
        setKept(false);
        link.enable(false);
      }
    };
    addEventListener("keydown", down);
    addEventListener("keyup", up);
    return () => {
      removeEventListener("keydown", down);
      removeEventListener("keyup", up);
    };
  }, [link, alone]);
  const keep = (on: boolean): void => {
    setKept(on);
    link.enable(on);
  };
  const override = drag ?? lamps.override;
  return (
    <section className="desk-hand stack" aria-label={words.cabinet.hand}>
      <Segments
        label={words.cabinet.key}
        value={lamps.key}
        onChange={position => {
          link.act({ do: "key", position });
        }}
        options={told.keys.map(({ id, name }) => ({ value: id, words: name }))}
      />
      <div className="desk-enable">
        <HoldButton
          className="btn enabling"
          label={words.cabinet.enable}
          onHold={() => {
            link.enable(true);
          }}
          onRelease={() => {
            if (!kept) link.enable(false);
          }}
        >
          <span className="lamp" data-on={lamps.enabled} aria-hidden />
          {words.cabinet.enable}
          <span className="dim small">
            {words.cabinet.enableHold}
            {alone && <span className="desk-key">{words.cabinet.enableKey}</span>}
          </span>
        </HoldButton>
        <label className="desk-keep small muted">
          <input
            type="checkbox"
            checked={kept}
            onChange={event => {
              keep(event.currentTarget.checked);
            }}
          />
          {words.cabinet.keep}
        </label>
      </div>
      <div className="row-flex">
        <button
          className="btn grow"
          aria-pressed={lamps.servo === "on"}
          onClick={() => {
            link.act({ do: "servo", on: lamps.servo === "off" });
          }}
        >
          <Power />
          {told.labels.servo}
          <span className="servo-state" data-servo={lamps.servo}>
            {words.cabinet.servo[lamps.servo]}
          </span>
        </button>
      </div>
      <div className="desk-override">
        <span className="muted">{words.cabinet.override}</span>
        <Slide
          label={words.cabinet.override}
          value={override}
          says={`${Math.round(100 * override)} %`}
          onChange={setDrag}
          onDone={value => {
            setDrag(null);
            link.act({ do: "override", percent: Math.round(100 * value) });
          }}
        />
        <span className="num">{Math.round(100 * override)} %</span>
      </div>
      <p className="small muted desk-says" role="status">
        {lamps.jog
          ? words.cabinet.jogging(lamps.jog.joint, lamps.jog.direction > 0 ? "+" : "−")
          : isManual
            ? lamps.enabled
              ? words.cabinet.ready
              : words.cabinet.howToJog
            : words.cabinet.notManual}
      </p>
    </section>
  );
}
