import type { Lens, MarkerSheet, LensCalibration } from "@twincell/core/vision";
import type { Pose } from "@twincell/core";

/** What the page tells the worker that looks for the marker. */
export type MarkerRequest =
  | { readonly kind: "lens"; readonly lens: Lens; readonly sheet: MarkerSheet; readonly calibrate: boolean }
  | { readonly kind: "picture"; readonly picture: VideoFrame | ImageBitmap; readonly at_s: number };

/** What one picture shows. */
export interface MarkerSeen {
  readonly kind: "seen";
  readonly at_s: number;
  readonly took_s: number;
  readonly tags: number;
  readonly cameraFromSheet: Pose;
  readonly error_px: number;
  /** Views of the board so far; null when no lens is being calibrated. */
  readonly views: number | null;
}
export type MarkerAnswer = MarkerSeen | { readonly kind: "calibration"; readonly calibration: LensCalibration };
