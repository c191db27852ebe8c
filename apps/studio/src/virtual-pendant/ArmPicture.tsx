import { useEffect, useRef } from "react";
import type { PendantShown } from "@twincell/protocol";
import { words } from "../messages/index.ts";
import type { VirtualPendantLink } from "./link.ts";

/** Seen from front right and above: where a point [m] is on the paper. */
const TURN_RAD = -0.62;
const TILT_RAD = 0.42;
const COS = Math.cos(TURN_RAD);
const SIN = Math.sin(TURN_RAD);
const UP = Math.cos(TILT_RAD);
const AWAY = Math.sin(TILT_RAD);
const across = (x: number, y: number): number => COS * y - SIN * x;
const down = (x: number, y: number, z: number): number => -(UP * z - AWAY * (COS * x + SIN * y));
const TRIAD = ["x", "y", "z"] as const;

/**
 * A picture of the arm in lines: joints where they are, as thick as arms are. Written by the read-out, not by React.
 */
export function ArmPicture({ link, joints }: { readonly link: VirtualPendantLink; readonly joints: number }) {
  const casing = useRef<SVGPolylineElement>(null);
  const paint = useRef<SVGPolylineElement>(null);
  const shade = useRef<SVGPolylineElement>(null);
  const knuckles = useRef<(SVGCircleElement | null)[]>([]);
  const axes = useRef<(SVGLineElement | null)[]>([]);
  const picture = useRef<SVGSVGElement>(null);
  useEffect(() => {
    let reach = 0;
    return link.onShown(({ points, flange }: PendantShown) => {
      if (reach === 0) {
        for (let i = 1; i < points.length; i++)
          reach += Math.hypot(...points[i]!.map((x, k) => x - points[i - 1]![k]!));
        reach = Math.max(0.3, 0.74 * reach);
        picture.current?.setAttribute("viewBox", `${-reach} ${-1.08 * reach} ${2 * reach} ${1.62 * reach}`);
        picture.current?.style.setProperty("--reach", String(reach));
      }
      const on = points.map(([x, y, z]) => `${across(x, y).toFixed(4)},${down(x, y, z).toFixed(4)}`).join(" ");
      for (const line of [casing, paint]) line.current?.setAttribute("points", on);
      shade.current?.setAttribute(
        "points",
        points.map(([x, y]) => `${across(x, y).toFixed(4)},${down(x, y, 0).toFixed(4)}`).join(" "),
      );
      points.slice(1).forEach(([x, y, z], i) => {
        knuckles.current[i]?.setAttribute("cx", across(x, y).toFixed(4));
        knuckles.current[i]?.setAttribute("cy", down(x, y, z).toFixed(4));
      });
      const [px, py, pz] = flange.position;
      const [qx, qy, qz, qw] = flange.quaternion;
      const size = 0.11 * reach;
      // biome-ignore format: table of numbers
      const columns = [
        [1 - 2 * (qy * qy + qz * qz), 2 * (qx * qy + qz * qw), 2 * (qx * qz - qy * qw)], [2 * (qx * qy - qz * qw), 1 - 2 * (qx * qx + qz * qz), 2 * (qy * qz + qx * qw)],
        [2 * (qx * qz + qy * qw), 2 * (qy * qz - qx * qw), 1 - 2 * (qx * qx + qy * qy)],
      ] as const;
      columns.forEach(([x, y, z], i) => {
        const line = axes.current[i];
        line?.setAttribute("x1", across(px, py).toFixed(4));
        line?.setAttribute("y1", down(px, py, pz).toFixed(4));
        line?.setAttribute("x2", across(px + size * x, py + size * y).toFixed(4));
        line?.setAttribute("y2", down(px + size * x, py + size * y, pz + size * z).toFixed(4));
      });
    });
  }, [link]);
  const ring = (radius: number): string =>
    Array.from({ length: 49 }, (_, i) => {
      const a = (i / 48) * 2 * Math.PI;
      const x = radius * Math.cos(a);
      const y = radius * Math.sin(a);
      return `${across(x, y).toFixed(3)},${down(x, y, 0).toFixed(3)}`;
    }).join(" ");
  return (
    <svg ref={picture} className="arm-picture" viewBox="-1 -1.08 2 1.62" role="img" aria-label={words.cabinet.picture}>
      <g className="arm-floor">
        {[0.25, 0.5, 0.75, 1].map(radius => (
          <polygon key={radius} points={ring(radius)} />
        ))}
      </g>
      <polyline ref={shade} className="arm-shade" />
      <polyline ref={casing} className="arm-casing" />
      <polyline ref={paint} className="arm-paint" />
      {Array.from({ length: joints + 1 }, (_, i) => (
        <circle
          key={i}
          ref={element => {
            knuckles.current[i] = element;
          }}
          className="arm-joint"
        />
      ))}
      {TRIAD.map((axis, i) => (
        <line
          key={axis}
          ref={element => {
            axes.current[i] = element;
          }}
          className={`arm-axis axis-${axis}`}
        />
      ))}
    </svg>
  );
}
