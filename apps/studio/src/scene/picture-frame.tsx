import { useLayoutEffect, useRef } from "react";
import { useStore } from "zustand";
import { viewStore } from "../stores/view.ts";
import type { PictureFrame } from "./picture.ts";
import { WORDS } from "./words.ts";

/** The frame around the other camera's picture; the renderer draws into its place. */
export function Picture({ picture, onHide }: { readonly picture: PictureFrame; readonly onHide: () => void }) {
  const frame = useRef<HTMLElement>(null);
  const camera = useStore(viewStore, state => state.camera);
  useLayoutEffect(() => {
    const element = frame.current;
    const parent = element?.offsetParent;
    if (!element || !parent) return;
    const measure = (): void => {
      picture.visible = element.offsetWidth > 0;
      picture.left = element.offsetLeft + 1;
      picture.top = element.offsetTop + 1;
      picture.width = element.clientWidth;
      picture.height = element.clientHeight;
    };
    measure();
    const watch = new ResizeObserver(measure);
    watch.observe(parent);
    return () => {
      watch.disconnect();
      picture.visible = false;
    };
  }, [picture]);
  return (
    <section ref={frame} className="picture" aria-label={camera === "main" ? WORDS.closeCamera : WORDS.overview}>
      <header>
        <span>{camera === "main" ? WORDS.closeCamera : WORDS.overview}</span>
        <span>
          <button
            type="button"
            aria-label={WORDS.swapCameras}
            title={WORDS.swapCameras}
            onClick={() => viewStore.setState({ camera: camera === "main" ? "close" : "main" })}
          >
            <svg
              width="13"
              height="13"
              viewBox="0 0 16 16"
              fill="none"
              stroke="currentColor"
              strokeWidth="1.7"
              strokeLinecap="round"
              strokeLinejoin="round"
              aria-hidden="true"
            >
              <path d="M3 6h10l-3-3M13 10H3l3 3" />
            </svg>
          </button>
          <button type="button" aria-label={WORDS.hidePicture} title={WORDS.hidePicture} onClick={onHide}>
            <svg
              width="13"
              height="13"
              viewBox="0 0 16 16"
              stroke="currentColor"
              strokeWidth="1.7"
              strokeLinecap="round"
              aria-hidden="true"
            >
              <path d="M4 4l8 8M12 4l-8 8" />
            </svg>
          </button>
        </span>
      </header>
    </section>
  );
}
