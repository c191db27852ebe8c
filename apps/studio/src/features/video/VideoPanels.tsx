import { useEffect } from "react";
import { useStore } from "zustand";
import { startHoldingBack } from "../../runtime/video/video-delay.ts";
import { videoStore } from "../../stores/video.ts";
import { viewStore } from "../../stores/view.ts";
import { Measure } from "./Measure.tsx";
import { VideoPanel } from "./VideoPanel.tsx";
import "./video.css";

/** The pictures of cameras over the view. In a headset they hang in the room. */
export default function VideoPanels() {
  const panels = useStore(videoStore, state => state.panels);
  const measured = useStore(videoStore, state => state.measured);
  const inHeadset = useStore(viewStore, state => state.inHeadset);
  useEffect(startHoldingBack, []);
  return (
    <>
      {!inHeadset && panels.map((panel, i) => <VideoPanel key={panel.id} panel={panel} place={i} />)}
      {measured !== null && <Measure key={measured} id={measured} />}
    </>
  );
}
