import { useEffect, useRef } from "react";
import { onFrame } from "../runtime/jog/jog-frames.ts";
import { theLive, type Live } from "../runtime/live.ts";

/** Calls `write` once now and in every frame in which the robot moved, outside React. */
export function useLive(write: (live: Readonly<Live>) => void): void {
  const latest = useRef(write);
  const seen = useRef(-1);
  useEffect(() => {
    latest.current = write;
    seen.current = -1;
  });
  useEffect(
    () =>
      onFrame(() => {
        const live = theLive();
        if (live.revision === seen.current) return;
        seen.current = live.revision;
        latest.current(live);
      }),
    [],
  );
}
