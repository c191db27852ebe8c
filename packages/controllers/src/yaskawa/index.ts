export {
  EXAMPLE_SCALE as YASKAWA_EXAMPLE_SCALE,
  resolution_rad as yaskawaResolution_rad,
  type PulseScale as YaskawaPulseScale,
} from "./codec/index.ts";
export {
  yaskawaFace,
  type YaskawaFace,
  type YaskawaFaceOptions,
  type FileClient as YaskawaFiles,
} from "./driver/index.ts";
export * from "./virtual/index.ts";
export { yaskawa } from "./brand.ts";
