import { Plug, PlugZap, RefreshCw, Snowflake } from "lucide-react";
import { useState } from "react";
import { useStore } from "zustand";
import { Slide } from "../ui/Slide.tsx";
import { words } from "../messages/index.ts";
import type { VirtualPendantLink } from "./link.ts";

const MOST_DELAY_S = 0.5;
const MOST_LOSS = 0.5;

/** Who is connected, and what only a virtual controller lets a person do: make things go wrong. */
export function FaultInjections({ link, open }: { readonly link: VirtualPendantLink; readonly open: boolean }) {
  const { host, ports } = useStore(link.view, state => state.words)!;
  const { trouble: problem, peers } = useStore(link.view, state => state.lamps)!;
  const [delay, setDelay] = useState<number | null>(null);
  const [loss, setLoss] = useState<number | null>(null);
  const delay_s = delay ?? problem.delay_s;
  const lost = loss ?? problem.loss;
  return (
    <>
      <details className="desk-part" open={open}>
        <summary>{words.cabinet.connected(peers.length)}</summary>
        <p className="small muted">
          {words.cabinet.listens(
            host,
            Object.entries(ports)
              .map(([name, port]) => `${name} ${port}`)
              .join(", "),
          )}
        </p>
        <ul className="desk-peers small">
          {peers.map((peer, i) => (
            <li key={`${i} ${peer}`}>{peer}</li>
          ))}
        </ul>
      </details>
      <details className="desk-part" open={open}>
        <summary>{words.cabinet.faults}</summary>
        <div className="desk-override">
          <span className="muted">{words.cabinet.delay}</span>
          <Slide
            label={words.cabinet.delay}
            value={delay_s}
            max={MOST_DELAY_S}
            step={0.01}
            says={`${Math.round(1000 * delay_s)} ms`}
            onChange={setDelay}
            onDone={value => {
              setDelay(null);
              link.act({ do: "trouble", delay_s: value });
            }}
          />
          <span className="num">{Math.round(1000 * delay_s)} ms</span>
        </div>
        <div className="desk-override">
          <span className="muted">{words.cabinet.loss}</span>
          <Slide
            label={words.cabinet.loss}
            value={lost}
            max={MOST_LOSS}
            says={`${Math.round(100 * lost)} %`}
            onChange={setLoss}
            onDone={value => {
              setLoss(null);
              link.act({ do: "trouble", loss: value });
            }}
          />
          <span className="num">{Math.round(100 * lost)} %</span>
        </div>
        <div className="desk-buttons">
          <button
            className="btn"
            aria-pressed={problem.hangs}
            onClick={() => {
              link.act({ do: "trouble", hangs: !problem.hangs });
            }}
          >
            <Snowflake />
            {words.cabinet.hangs}
          </button>
          <button
            className="btn"
            aria-pressed={problem.unplugged}
            onClick={() => {
              link.act({ do: "trouble", unplugged: !problem.unplugged });
            }}
          >
            {problem.unplugged ? <PlugZap /> : <Plug />}
            {problem.unplugged ? words.stations.plugIn : words.cabinet.unplug}
          </button>
          <button
            className="btn"
            onClick={() => {
              link.act({ do: "reboot" });
            }}
          >
            <RefreshCw />
            {words.cabinet.reboot}
          </button>
        </div>
      </details>
    </>
  );
}
