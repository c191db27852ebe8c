import { useSyncExternalStore } from "react";

/** Whether the media query holds now. */
export function useMedia(query: string): boolean {
  return useSyncExternalStore(
    changed => {
      const list = matchMedia(query);
      list.addEventListener("change", changed);
      return () => list.removeEventListener("change", changed);
    },
    () => matchMedia(query).matches,
  );
}
/** A phone either way up, a tablet held upright, or a narrow window. */
export const PHONE = "(max-width: 900px), (max-height: 480px) and (pointer: coarse)";
