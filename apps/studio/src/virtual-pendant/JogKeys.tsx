import { Minus, Plus } from "lucide-react";
import { useEffect, useRef } from "react";
import { useStore } from "zustand";
import type { PendantWords } from "@twincell/protocol";
import { fixedXyz } from "../runtime/jog/fixed-xyz.ts";
import { showNumber } from "../ui/expression.ts";
import { HoldButton } from "../ui/HoldButton.tsx";
import { words } from "../messages/index.ts";
import { fixed } from "../messages/numbers.ts";
import type { VirtualPendantLink } from "./link.ts";

const NONE: PendantWords["joints"] = [];
const TIP = ["x", "y", "z", "rx", "ry", "rz"] as const;
const write = (element: HTMLElement | null | undefined, text: string): void => {
  if (element && element.textContent !== text) element.textContent = text;
};

/** A row a joint: − and + jog while they are held; between them where the joint is in its range. */
export function JogKeys({ link, disabled }: { readonly link: VirtualPendantLink; readonly disabled: boolean }) {
  const joints = useStore(link.view, state => state.words?.joints ?? NONE);
  const jog = useStore(link.view, state => state.lamps?.jog);
  const values = useRef<(HTMLElement | null)[]>([]);
  const gauges = useRef<(HTMLElement | null)[]>([]);
  const tips = useRef<(HTMLElement | null)[]>([]);
  useEffect(() => {
    const turn = new Float64Array(3);
    return link.onShown(({ q_rad, flange }) => {
      joints.forEach(({ lower_rad, upper_rad, slides }, i) => {
        const q = q_rad[i] ?? NaN;
        write(values.current[i], slides ? `${showNumber(q, "length")} mm` : `${fixed((q * 180) / Math.PI, 2)}°`);
        const gauge = gauges.current[i];
        if (gauge) gauge.style.left = `${100 * Math.min(1, Math.max(0, (q - lower_rad) / (upper_rad - lower_rad)))}%`;
      });
      fixedXyz(flange.quaternion as [number, number, number, number], turn);
      TIP.forEach((_, i) => {
        write(
          tips.current[i],
          i < 3 ? `${fixed(1000 * flange.position[i]!, 1)} mm` : `${fixed((turn[i - 3]! * 180) / Math.PI, 1)}°`,
        );
      });
    });
  }, [link, joints]);
  const hold = (joint: number, direction: -1 | 1) => () => {
    link.act({ do: "jog", joint, direction });
  };
  const release = (joint: number) => () => {
    link.act({ do: "jog", joint, direction: 0 });
  };
  return (
    <section className="desk-jog" aria-label={words.cabinet.jog} data-off={disabled}>
      <div className="axes">
        {joints.map((_, i) => {
          const joint = i + 1;
          const name = words.time.joint(joint);
          return (
            <div className="axis" key={joint} data-jogged={jog?.joint === joint}>
              <span className="axis-name">{name}</span>
              <HoldButton
                label={words.jog.minus(name)}
                className="btn icon axis-button"
                onHold={hold(joint, -1)}
                onRelease={release(joint)}
              >
                <Minus />
              </HoldButton>
              <span className="gauge" aria-hidden>
                <i
                  ref={element => {
                    gauges.current[i] = element;
                  }}
                />
              </span>
              <HoldButton
                label={words.jog.plus(name)}
                className="btn icon axis-button"
                onHold={hold(joint, 1)}
                onRelease={release(joint)}
              >
                <Plus />
              </HoldButton>
              <span
                className="num axis-value"
                ref={element => {
                  values.current[i] = element;
                }}
              />
            </div>
          );
        })}
      </div>
      <dl className="desk-tip" aria-label={words.cabinet.flange}>
        {TIP.map((axis, i) => (
          <div key={axis}>
            <dt>{words.cabinet.tip[axis]}</dt>
            <dd
              className="num"
              ref={element => {
                tips.current[i] = element;
              }}
            />
          </div>
        ))}
      </dl>
    </section>
  );
}
