import { packed } from "../runtime/video/packing.ts";
import type { PackRequest, PackAnswer } from "../runtime/video/packing.ts";

/** Makes a JPEG of a picture, beside the page. */
addEventListener("message", ({ data }: MessageEvent<PackRequest>) => {
  void packed(data).then((answer: PackAnswer) => {
    postMessage(answer, { transfer: "bytes" in answer ? [answer.bytes.buffer] : [] });
  });
});
