import type { Robot } from "@twincell/core";
import { useMemo } from "react";
import { robotPicture } from "./picture.ts";

export function Picture({ robot }: { readonly robot: Robot }) {
  const { viewBox, bones, joints, width } = useMemo(() => robotPicture(robot), [robot]);
  return (
    <svg className="robot-picture" viewBox={viewBox} aria-hidden>
      <path
        d={bones}
        fill="none"
        stroke={robot.paint?.casting ?? "#eaa50c"}
        strokeWidth={width}
        strokeLinecap="round"
        strokeLinejoin="round"
      />
      {joints.map(([x, y], i) => (
        <circle key={i} cx={x} cy={y} r={0.34 * width} fill={robot.paint?.dark ?? "var(--bg)"} />
      ))}
    </svg>
  );
}
