import { useStore } from "zustand";
import { words } from "../messages/index.ts";
import type { VirtualPendantLink } from "./link.ts";

/** Lines in, which a click switches, and lines out, which are lamps. */
export function Signals({ link, open }: { readonly link: VirtualPendantLink; readonly open: boolean }) {
  const { inputs, outputs } = useStore(link.view, state => state.words)!;
  const on = useStore(link.view, state => state.lamps?.on) ?? [];
  return (
    <details className="desk-part" open={open}>
      <summary>{words.cabinet.signals}</summary>
      {inputs.length === 0 && <p className="small muted">{words.cabinet.noSignals}</p>}
      <div className="desk-lines">
        {inputs.map(signal => (
          <button
            key={signal}
            className="btn tight line"
            aria-pressed={on.includes(signal)}
            onClick={() => {
              link.act({ do: "input", signal, value: !on.includes(signal) });
            }}
          >
            <span className="lamp" data-on={on.includes(signal)} aria-hidden />
            {signal}
          </button>
        ))}
      </div>
      {outputs.length > 0 && <h3 className="small dim">{words.cabinet.outputs}</h3>}
      <ul className="desk-lines">
        {outputs.map(signal => (
          <li key={signal} className="line">
            <span className="lamp" data-on={on.includes(signal)} aria-hidden />
            {signal}
            <span className="visually-hidden">{on.includes(signal) ? words.common.on : words.common.off}</span>
          </li>
        ))}
      </ul>
    </details>
  );
}
