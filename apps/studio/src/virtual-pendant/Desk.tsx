import { useEffect } from "react";
import { useStore } from "zustand";
import { say, words } from "../messages/index.ts";
import { Around } from "./Around.tsx";
import { ArmPicture } from "./ArmPicture.tsx";
import { Hand } from "./Hand.tsx";
import { JogKeys } from "./JogKeys.tsx";
import type { VirtualPendantLink } from "./link.ts";
import { Signals } from "./Signals.tsx";
import { FaultInjections } from "./Troubles.tsx";
import "../ui/axis.css";
import "./cabinet.css";

/**
 * The pendant and the cabinet of a virtual controller, as a person stands before them (rows T-26, T-27).
 *
 * @param alone  on a page of its own, or as a part of the studio's panel.
 */
export function Desk({ link, alone }: { readonly link: VirtualPendantLink; readonly alone: boolean }) {
  const told = useStore(link.view, state => state.words);
  const lamps = useStore(link.view, state => state.lamps);
  const connected = useStore(link.view, state => state.connected);
  const complaint = useStore(link.view, state => state.complaint);
  useEffect(() => {
    link.watch(true);
    return () => {
      link.letGo();
      link.watch(false);
    };
  }, [link]);
  if (!told || !lamps)
    return (
      <p className="desk-wait muted" role="status">
        {complaint ? say(complaint.sentence) : words.cabinet.connecting}
      </p>
    );
  const says = say(complaint ? `${complaint.sentence} ${complaint.hint}` : lamps.says);
  return (
    <div className="desk" data-alone={alone} data-connected={connected}>
      {!connected && (
        <p className="desk-lost" role="alert">
          {words.cabinet.lost}
        </p>
      )}
      <header className="desk-head">
        <h1 className="desk-title">
          <span className="desk-brand">{told.brandName}</span>
          <span className="muted small">
            {told.robotName} · {words.cabinet.virtual}
          </span>
        </h1>
        <span className="desk-safety" data-safety={lamps.safety} role="status">
          {lamps.safety === "normal"
            ? lamps.moving
              ? words.cabinet.moves
              : words.cabinet.stands
            : words.control.safetyStates[lamps.safety]}
        </span>
        <button
          className="mushroom"
          aria-pressed={lamps.pressed}
          aria-label={lamps.pressed ? words.cabinet.redOut : words.cabinet.red}
          onClick={() => {
            link.act({ do: "emergency-stop", pressed: !lamps.pressed });
          }}
        >
          <i aria-hidden>{lamps.pressed ? "↻" : words.cabinet.stop}</i>
          <span aria-hidden>{lamps.pressed ? words.cabinet.redOutShort : words.cabinet.redShort}</span>
        </button>
      </header>
      <p className="desk-complaint" role="alert" data-any={says !== ""}>
        {says}
      </p>
      <Hand link={link} alone={alone} />
      <div className="desk-arm">
        {alone && <ArmPicture link={link} joints={told.joints.length} />}
        <JogKeys link={link} disabled={!lamps.enabled} />
      </div>
      <div className="desk-side">
        <Around link={link} />
        <Signals link={link} open={alone} />
      </div>
      <div className="desk-wire">
        <FaultInjections link={link} open={alone} />
      </div>
      {alone && <p className="desk-honest small dim">{words.cabinet.honest}</p>}
    </div>
  );
}
