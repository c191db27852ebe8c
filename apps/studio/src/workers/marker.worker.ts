import { angleBetween, copyPose, distance, type Pose } from "@twincell/core";
import {
  type BoardView,
  boardView,
  calibrateLens,
  type Lens,
  type MarkerSheet,
  SheetTracker,
  type SheetSighting,
} from "@twincell/core/vision";
import type { MarkerAnswer, MarkerRequest } from "./marker-messages.ts";

/** Views of the board that a lens is calibrated from. */
const VIEWS = 12;
/** A view differs from every other by so much, and the board is held this still while it is taken. */
const NEW_TURN_RAD = 0.16;
const STILL_TURN_RAD = 0.012;
const STILL_M = 0.003;
const MIN_TAGS = 8;

let lens: Lens | null = null;
let sheet: MarkerSheet | null = null;
let tracker: SheetTracker | null = null;
/** Views so far and how the board was held in each; null when no lens is being calibrated. */
let taken: { readonly views: BoardView[]; readonly poses: Pose[]; last: Pose } | null = null;
let gray = new Uint8Array(0);
let canvas: OffscreenCanvas | null = null;

const answer = (message: MarkerAnswer): void => {
  postMessage(message);
};

addEventListener("message", ({ data }: MessageEvent<MarkerRequest>) => {
  if (data.kind === "lens") {
    ({ lens, sheet } = data);
    tracker = new SheetTracker(lens, sheet);
    taken = data.calibrate ? { views: [], poses: [], last: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] } } : null;
  } else void look(data.picture, data.at_s);
});

async function look(picture: VideoFrame | ImageBitmap, at_s: number): Promise<void> {
  const began = performance.now();
  let stride = 0;
  try {
    stride = await readGray(picture);
  } finally {
    picture.close();
  }
  const sighting = tracker?.look(gray, stride, at_s);
  const took_s = (performance.now() - began) / 1000;
  if (sighting && taken) take(sighting);
  answer({
    kind: "seen",
    at_s,
    took_s,
    tags: sighting?.tags ?? 0,
    cameraFromSheet: sighting?.cameraFromSheet ?? { position: [0, 0, 0], quaternion: [0, 0, 0, 1] },
    error_px: sighting?.error_px ?? 0,
    views: taken?.views.length ?? null,
  });
  if (taken && taken.views.length >= VIEWS && lens) {
    const calibration = calibrateLens(lens.width, lens.height, taken.views);
    taken = null;
    answer({ kind: "calibration", calibration });
  }
}

/** A view is taken of a board that is held still in a way in which it was not held before. */
function take(sighting: SheetSighting): void {
  if (!taken || !tracker || !lens || !sheet || sighting.tags < MIN_TAGS) return;
  const now = sighting.cameraFromSheet;
  const still =
    angleBetween(now.quaternion, taken.last.quaternion) < STILL_TURN_RAD &&
    distance(now.position, taken.last.position) < STILL_M;
  taken.last = copyPose(now);
  if (!still || taken.poses.some(pose => angleBetween(pose.quaternion, now.quaternion) < NEW_TURN_RAD)) return;
  const view = boardView(tracker.detector, lens, sheet);
  if (!view) return;
  taken.views.push(view);
  taken.poses.push(copyPose(now));
}

/** Brings the brightness of a picture into `gray`; returns values from one row to the next. */
async function readGray(picture: VideoFrame | ImageBitmap): Promise<number> {
  if ("copyTo" in picture && isPlain(picture)) {
    const size = picture.allocationSize();
    if (gray.length < size) gray = new Uint8Array(size);
    const [luma] = await picture.copyTo(gray);
    // The first plane is the brightness, and it comes first.
    return luma!.stride;
  }
  const width = "displayWidth" in picture ? picture.displayWidth : picture.width;
  const height = "displayHeight" in picture ? picture.displayHeight : picture.height;
  canvas ??= new OffscreenCanvas(width, height);
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  const context = canvas.getContext("2d", { willReadFrequently: true })!;
  context.drawImage(picture, 0, 0);
  const { data } = context.getImageData(0, 0, width, height);
  if (gray.length < width * height) gray = new Uint8Array(width * height);
  for (let i = 0, at = 0; i < width * height; i++, at += 4)
    gray[i] = (77 * data[at]! + 150 * data[at + 1]! + 29 * data[at + 2]! + 128) >> 8;
  return width;
}

/** A picture whose first plane is its brightness, upright and whole. */
function isPlain(frame: VideoFrame): boolean {
  const turned = Reflect.get(frame, "rotation");
  return (
    (frame.format === "I420" || frame.format === "NV12" || frame.format === "I422" || frame.format === "I444") &&
    (turned === undefined || turned === 0) &&
    frame.visibleRect?.width === frame.displayWidth &&
    frame.visibleRect.height === frame.displayHeight
  );
}
