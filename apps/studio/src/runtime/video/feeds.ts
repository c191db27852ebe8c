import { changePanel, panelOf, videoStore, type VideoSource } from "../../stores/video.ts";
import { words } from "../../messages/index.ts";
import { eachPicture, listCameras, openCamera } from "./camera.ts";
import { drawPicture, newFeed, type Feed } from "./feed.ts";
import { watchServerCamera } from "./server-feeds.ts";

const feeds = new Map<string, { readonly feed: Feed; readonly stop: () => void }>();
/** More panels than this nobody looks at, and each costs its unpacking. */
const MOST_PANELS = 4;

export const feedOf = (id: string): Feed | undefined => feeds.get(id)?.feed;
export const panelId = (source: VideoSource): string =>
  source.kind === "here" ? `here:${source.device}` : `server:${source.name}`;

/** Shows a camera as a panel. Once only; a fifth takes the place of the first. */
export function showCamera(source: VideoSource, name: string): void {
  const id = panelId(source);
  const { panels } = videoStore.getState();
  if (panelOf(id)) return;
  if (panels.length >= MOST_PANELS) hideCamera(panels[0]!.id);
  videoStore.setState(state => ({
    panels: [
      ...state.panels,
      { id, name, source, trouble: source.kind === "here" ? words.video.asking : words.video.connecting },
    ],
  }));
  const feed = newFeed(id);
  feeds.set(id, {
    feed,
    stop: source.kind === "server" ? watchServerCamera(feed, source.name) : filmHere(feed, source.device),
  });
}
export function hideCamera(id: string): void {
  feeds.get(id)?.stop();
  feeds.delete(id);
  videoStore.setState(({ panels, heldBy, measured }) => ({
    panels: panels.filter(panel => panel.id !== id),
    heldBy: heldBy === id ? null : heldBy,
    measured: measured === id ? null : measured,
  }));
}
/** Tries a camera of this computer again, after a permission was given or a plug put in. */
export function tryAgain(id: string): void {
  const panel = panelOf(id);
  if (!panel) return;
  hideCamera(id);
  showCamera(panel.source, panel.name);
}

function filmHere(feed: Feed, device: string): () => void {
  let stop: (() => void) | null = null;
  let over = false;
  void openCamera(device).then(opened => {
    if (opened.kind === "refused") {
      changePanel(feed.id, { trouble: opened.sentence });
      return;
    }
    if (over) {
      for (const track of opened.stream.getTracks()) track.stop();
      return;
    }
    changePanel(feed.id, { trouble: "", ...(device === "" ? {} : { name: opened.name }) });
    void listCameras().then(devices => {
      videoStore.setState({ devices });
    });
    ({ stop } = eachPicture(opened.stream, (video, captured_s) => {
      drawPicture(feed, video, video.videoWidth, video.videoHeight, captured_s);
    }));
    for (const track of opened.stream.getVideoTracks())
      track.addEventListener("ended", () => {
        if (!over) changePanel(feed.id, { trouble: words.video.takenAway });
      });
  });
  return () => {
    over = true;
    stop?.();
  };
}
