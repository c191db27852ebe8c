import { words } from "../../messages/index.ts";

/** A camera that was allowed, or why not. */
export type OpenedCamera =
  | { readonly kind: "opened"; readonly stream: MediaStream; readonly name: string }
  | { readonly kind: "refused"; readonly sentence: string };

const WIDTH = 1280;
const HEIGHT = 720;
const PER_SECOND = 30;

/**
 * Asks for a camera of this device.
 *
 * @param wanted  id of one of them, "back" or "front" of a phone, or "" for any
 */
export async function openCamera(wanted: string): Promise<OpenedCamera> {
  if (!window.isSecureContext)
    return {
      kind: "refused",
      sentence: "A browser gives a camera only to a secure page: open it by https, or on the computer itself.",
    };
  if (!("mediaDevices" in navigator)) return { kind: "refused", sentence: "This browser has no access to cameras." };
  const which: MediaTrackConstraints =
    wanted === "back"
      ? { facingMode: "environment" }
      : wanted === "front"
        ? { facingMode: "user" }
        : wanted === ""
          ? {}
          : { deviceId: { exact: wanted } };
  try {
    const stream = await navigator.mediaDevices.getUserMedia({
      audio: false,
      video: { ...which, width: { ideal: WIDTH }, height: { ideal: HEIGHT }, frameRate: { ideal: PER_SECOND } },
    });
    return { kind: "opened", stream, name: stream.getVideoTracks()[0]?.label || words.video.camera.which };
  } catch (problem) {
    return {
      kind: "refused",
      sentence: sentenceOf(problem instanceof Error ? problem.name : "", String(problem)),
    };
  }
}

/** One sentence for each way in which a browser refuses a camera, with the way out. */
export function sentenceOf(name: string, detail: string): string {
  switch (name) {
    case "NotAllowedError":
      return "The camera was not allowed. Allow it for this page beside the address, then try again.";
    case "NotFoundError":
      return "No camera was found on this device. Plug one in, then try again.";
    case "OverconstrainedError":
      return "That camera is no longer there. Choose another.";
    case "NotReadableError":
      return "Another program uses the camera. Close it, then try again.";
    default:
      return `The camera could not be started: ${detail}.`;
  }
}

/** Cameras of this device; names only after one was allowed. */
export async function listCameras(): Promise<{ readonly device: string; readonly name: string }[]> {
  if (!window.isSecureContext || !("mediaDevices" in navigator)) return [];
  const all = await navigator.mediaDevices.enumerateDevices();
  return all
    .filter(({ kind }) => kind === "videoinput")
    .map(({ deviceId, label }, i) => ({ device: deviceId, name: label || `Camera ${i + 1}` }));
}

/**
 * Runs a stream in an element of its own; `picture` is called with each new picture and when it was taken, by the
 * page's clock [s].
 */
export function eachPicture(
  stream: MediaStream,
  picture: (video: HTMLVideoElement, captured_s: number) => void,
): { readonly video: HTMLVideoElement; stop(): void } {
  const video = document.createElement("video");
  let handle = 0;
  let over = false;
  const next = (now_ms: number, about: VideoFrameCallbackMetadata): void => {
    if (over) return;
    // Firefox and Safari do not say when: then it is taken to be now, and what the camera itself needs is left out.
    picture(video, (about.captureTime ?? now_ms) / 1000);
    handle = video.requestVideoFrameCallback(next);
  };
  Object.assign(video, { muted: true, playsInline: true, srcObject: stream });
  handle = video.requestVideoFrameCallback(next);
  // A stream that is stopped before it plays is no fault: whoever stopped it knows.
  video.play().catch((problem: unknown) => {
    if (!over) console.warn(String(problem));
  });
  return {
    video,
    stop() {
      over = true;
      video.cancelVideoFrameCallback(handle);
      for (const track of stream.getTracks()) track.stop();
      video.srcObject = null;
    },
  };
}
