import { type Camera, Matrix4, type WebGLRenderer } from "three";
import { theLive } from "../runtime/live.ts";
import { drawsInSoftware } from "./software.ts";

const COARSE = 0.5;
const REST_MS = 260;

/**
 * Where the processor draws the pixels: coarse while something moves, sharp as soon as it rests.
 * A graphics card always draws sharp.
 */
export class Sharpness {
  readonly #seen = new Matrix4();
  #revision = -1;
  #full = 0;
  #software: boolean | null = null;
  #moved_ms = -Infinity;
  #timer: ReturnType<typeof setTimeout> | undefined;

  choose(gl: WebGLRenderer, camera: Camera, invalidate: () => void): void {
    this.#software ??= drawsInSoftware(gl);
    if (!this.#software) return;
    const now_ms = performance.now();
    const { revision } = theLive();
    if (this.#full === 0) {
      this.#full = gl.getPixelRatio();
      this.#revision = revision;
      this.#seen.copy(camera.matrixWorld);
      return;
    }
    if (revision !== this.#revision || !this.#seen.equals(camera.matrixWorld)) this.#moved_ms = now_ms;
    this.#revision = revision;
    this.#seen.copy(camera.matrixWorld);
    const coarse = now_ms - this.#moved_ms < REST_MS;
    const ratio = coarse ? Math.min(COARSE, this.#full) : this.#full;
    if (gl.getPixelRatio() !== ratio) gl.setPixelRatio(ratio);
    if (!coarse) return;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(invalidate, REST_MS + 20);
  }
}
