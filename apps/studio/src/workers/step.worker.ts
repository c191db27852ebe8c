import load from "occt-import-js";
import kernelAddress from "occt-import-js/dist/occt-import-js.wasm?url";
import { STEP_PARAMETERS, type OcctResult } from "@twincell/formats";

/**
 * The CAD kernel, a WebAssembly module of its own, alone in a worker: it cannot be interrupted, and its memory never
 * shrinks. Whoever has had enough ends the worker. Answers with what it read, or with why it could not.
 */
addEventListener("message", ({ data }: MessageEvent<Uint8Array>) => {
  void load({ locateFile: () => new URL(kernelAddress, import.meta.url).href })
    .then(kernel => compact(kernel.ReadStepFile(data, STEP_PARAMETERS)))
    .catch((problem: unknown) => (problem instanceof Error ? problem.message : String(problem)))
    .then((answer: OcctResult | string) => postMessage(answer));
});

/** Numbers in typed arrays: plain ones take eight times as long to send. */
const compact = (result: OcctResult): OcctResult =>
  result.meshes
    ? {
        ...result,
        meshes: result.meshes.map(mesh => ({
          ...mesh,
          attributes: { position: { array: Float64Array.from(mesh.attributes.position.array) } },
          index: { array: Uint32Array.from(mesh.index.array) },
        })),
      }
    : result;
