import type { Robot } from "@twincell/core";
import { useEffect, useRef } from "react";
import { paintedRobot } from "../../runtime/pictures/robot-painter.ts";

/** Pixels of the picture for one of the page, so that it is sharp on dense screens. */
const DENSITY = 2;

/** A robot as it looks. It is painted when it comes into view: a list has more than a hundred. */
export function Picture({
  robot,
  width,
  height,
}: {
  readonly robot: Robot;
  readonly width: number;
  readonly height: number;
}) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const here = canvas.current;
    if (!here) return;
    let left = false;
    const seen = new IntersectionObserver(entries => {
      if (!entries.some(({ isIntersecting }) => isIntersecting)) return;
      seen.disconnect();
      void paintedRobot(robot.id, width * DENSITY, height * DENSITY).then(picture => {
        const context = here.getContext("2d");
        if (left || !context) return;
        context.clearRect(0, 0, here.width, here.height);
        if (picture) context.putImageData(new ImageData(picture.data, picture.width, picture.height), 0, 0);
        here.dataset["painted"] = robot.id;
      });
    });
    seen.observe(here);
    return () => {
      left = true;
      seen.disconnect();
    };
  }, [robot.id, width, height]);
  return (
    <canvas ref={canvas} className="robot-picture" width={width * DENSITY} height={height * DENSITY} aria-hidden />
  );
}
