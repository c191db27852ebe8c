import type { WebGLRenderer } from "three";

/** Whether pixels are made by the processor: then the picture is drawn with less, so that the studio stays usable. */
export function drawsInSoftware(gl: WebGLRenderer): boolean {
  const context = gl.getContext();
  const info = context.getExtension("WEBGL_debug_renderer_info");
  return (
    info !== null &&
    /swiftshader|llvmpipe|software|basic render/i.test(String(context.getParameter(info.UNMASKED_RENDERER_WEBGL)))
  );
}
