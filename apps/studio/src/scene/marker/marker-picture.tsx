import { useEffect, useRef } from "react";
import { useStore } from "zustand";
import { showPicturesOn, startMarkerView } from "../../runtime/marker/marker-camera.ts";
import { markerViewStore } from "../../stores/marker-view.ts";

/** The camera's picture behind the scene. */
export default function MarkerPicture() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const seen = useStore(markerViewStore, state => state.seen);
  useEffect(() => {
    showPicturesOn(canvas.current);
    const stop = startMarkerView();
    return () => {
      stop();
      showPicturesOn(null);
    };
  }, []);
  return <canvas ref={canvas} className="marker-picture" data-seen={seen} aria-hidden />;
}
