import { compose, copyPose, identity, inverse, type Pose } from "@twincell/core";
import { assumedLens, BASE_MARKER, type Lens, LENS_BOARD, type MarkerSheet } from "@twincell/core/vision";
import { cellStore } from "../../stores/cell.ts";
import { markerViewStore } from "../../stores/marker-view.ts";
import { words } from "../../messages/index.ts";
import type { MarkerAnswer, MarkerRequest, MarkerSeen } from "../../workers/marker-messages.ts";
import { eachPicture, openCamera } from "../video/camera.ts";
import { keepLens, lensOf } from "./lenses.ts";

/** What the scene draws by: written in place, read once a frame. */
export interface MarkerView {
  lens: Lens;
  /** Camera x right, y down, z forward; at the size at which the cell is drawn. */
  readonly worldFromCamera: Pose<"world", "camera">;
  /** Counts up with every pose; −1 before the first. */
  revision: number;
}
export const markerView: MarkerView = { lens: assumedLens(1280, 720), worldFromCamera: identity(), revision: -1 };

/** After so long without the marker the cell is drawn faintly [s]. */
const LOST_S = 0.5;
const TELL_EVERY_MS = 250;
const listeners = new Set<() => void>();
/** Called after every picture. */
export function onMarkerPicture(listen: () => void): () => void {
  listeners.add(listen);
  return () => listeners.delete(listen);
}

/** The canvas that shows the pictures, behind the scene. */
let shownOn: HTMLCanvasElement | null = null;
export function showPicturesOn(canvas: HTMLCanvasElement | null): void {
  shownOn = canvas;
}

const sheetOf = (side_m: number): MarkerSheet => ({
  ...BASE_MARKER,
  tags: BASE_MARKER.tags.map(tag => ({ ...tag, side_m })),
});

type Shown = VideoFrame | ImageBitmap;

/** One camera whose pictures are looked through, one at a time; what comes meanwhile is left out. */
class MarkerCamera {
  readonly #worker = new Worker(new URL("../../workers/marker.worker.ts", import.meta.url), { type: "module" });
  readonly #stops: (() => void)[] = [];
  #busy = false;
  #over = false;
  /** The picture that is being looked through: it is shown with its own pose, so that both agree. */
  #looking: Shown | null = null;
  #seen_s = -Infinity;
  #told_ms = -Infinity;
  #width = 0;
  #height = 0;

  constructor() {
    this.#worker.addEventListener("message", ({ data }: MessageEvent<MarkerAnswer>) => {
      if (this.#over) return;
      if (data.kind === "seen") this.#answered(data);
      else this.#calibrated(data);
    });
    this.#stops.push(
      markerViewStore.subscribe((state, before) => {
        const calibrates = (state.views === null) !== (before.views === null);
        if (this.#width > 0 && (state.side_m !== before.side_m || calibrates)) this.#tellLens();
      }),
    );
    void this.#open();
  }

  async #open(): Promise<void> {
    const opened = await openCamera("back");
    if (opened.kind === "refused") {
      markerViewStore.setState({ problem: opened.sentence });
      return;
    }
    if (this.#over) {
      for (const track of opened.stream.getTracks()) track.stop();
      return;
    }
    markerViewStore.setState({ problem: "", camera: opened.name });
    const pictures = eachPicture(opened.stream, (video, captured_s) => {
      if (!this.#busy && !this.#over) void this.#send(video, captured_s);
    });
    this.#stops.push(() => pictures.stop());
    for (const track of opened.stream.getVideoTracks())
      track.addEventListener("ended", () => {
        if (!this.#over) markerViewStore.setState({ problem: words.video.takenAway, seen: false });
      });
  }

  async #send(video: HTMLVideoElement, at_s: number): Promise<void> {
    this.#busy = true;
    try {
      const sent = await pictureOf(video);
      this.#looking = "clone" in sent ? sent.clone() : await createImageBitmap(sent);
      const [width, height] =
        "displayWidth" in sent ? [sent.displayWidth, sent.displayHeight] : [sent.width, sent.height];
      if (width !== this.#width || height !== this.#height) {
        this.#width = width;
        this.#height = height;
        this.#tellLens();
      }
      this.#worker.postMessage({ kind: "picture", picture: sent, at_s } satisfies MarkerRequest, [sent]);
    } catch {
      // A video that has just changed its size, or ended, is looked at with its next picture.
      this.#busy = false;
    }
  }

  #tellLens(): void {
    const { camera, side_m, views } = markerViewStore.getState();
    const known = lensOf(camera, this.#width, this.#height, localStorage);
    const calibrate = views !== null;
    // What is calibrated must not rest on an earlier calibration.
    const lens = calibrate ? assumedLens(this.#width, this.#height) : known.lens;
    markerView.lens = lens;
    markerViewStore.setState({ lens: known.kind });
    const sheet = calibrate ? LENS_BOARD : sheetOf(side_m);
    this.#worker.postMessage({ kind: "lens", lens, sheet, calibrate } satisfies MarkerRequest);
  }

  #answered(seen: MarkerSeen): void {
    this.#busy = false;
    const picture = this.#looking;
    this.#looking = null;
    if (picture) {
      draw(picture, this.#width, this.#height);
      picture.close();
    }
    const calibrating = markerViewStore.getState().views !== null;
    if (seen.tags > 0) {
      this.#seen_s = seen.at_s;
      if (!calibrating) place(seen.cameraFromSheet);
    }
    const now_ms = performance.now();
    const isSeen = seen.at_s - this.#seen_s < LOST_S && !calibrating;
    const shown = markerViewStore.getState();
    const changed = isSeen !== shown.seen || (calibrating && seen.views !== shown.views);
    if (changed || now_ms - this.#told_ms > TELL_EVERY_MS) {
      this.#told_ms = now_ms;
      const [x, y, z] = seen.cameraFromSheet.position;
      markerViewStore.setState(before => ({
        seen: isSeen,
        took_s: seen.took_s,
        distance_m: seen.tags > 0 ? Math.hypot(x, y, z) : before.distance_m,
        error_px: seen.tags > 0 ? seen.error_px : before.error_px,
        views: calibrating ? (seen.views ?? before.views) : null,
      }));
    }
    for (const listen of listeners) listen();
  }

  #calibrated({ calibration }: Extract<MarkerAnswer, { readonly kind: "calibration" }>): void {
    const { camera } = markerViewStore.getState();
    const kept = calibration.kind !== "calibrated" || keepLens(camera, calibration.lens, localStorage);
    markerViewStore.setState({
      views: null,
      calibration: kept ? calibration.sentence : words.marker.notKept,
    });
  }

  stop(): void {
    this.#over = true;
    for (const stop of this.#stops) stop();
    this.#looking?.close();
    this.#looking = null;
    this.#worker.terminate();
    markerView.revision = -1;
  }
}

const pictureOf = (video: HTMLVideoElement): Promise<Shown> | Shown =>
  "VideoFrame" in window ? new VideoFrame(video) : createImageBitmap(video);

function draw(picture: Shown, width: number, height: number): void {
  if (!shownOn) return;
  if (shownOn.width !== width || shownOn.height !== height) {
    shownOn.width = width;
    shownOn.height = height;
  }
  shownOn.getContext("2d", { alpha: false })!.drawImage(picture, 0, 0, width, height);
}

/** The marker lies where the robot's base is, upright with the base's y axis: its frame is the base's. */
const markerFromCamera: Pose<"base", "camera"> = identity();
function place(cameraFromSheet: Pose): void {
  const base = cellStore.getState().document?.robot.worldFromBase;
  if (!base) return;
  inverse<string, string>(cameraFromSheet, markerFromCamera);
  const { scale } = markerViewStore.getState();
  // A cell that is drawn smaller is one that is looked at from farther away.
  for (let i = 0; i < 3; i++) markerFromCamera.position[i]! /= scale;
  copyPose(compose(base, markerFromCamera), markerView.worldFromCamera);
  markerView.revision++;
}

/** Opens the camera as long as the view through it is on. */
export function startMarkerView(): () => void {
  let camera: MarkerCamera | null = null;
  const follow = (on: boolean): void => {
    if (on && !camera) camera = new MarkerCamera();
    else if (!on && camera) {
      camera.stop();
      camera = null;
    }
  };
  follow(markerViewStore.getState().on);
  const stop = markerViewStore.subscribe(({ on }) => follow(on));
  return () => {
    stop();
    follow(false);
  };
}
