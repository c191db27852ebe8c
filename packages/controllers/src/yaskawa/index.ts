export {
  exampleScale as yaskawaExampleScale,
  resolution_rad as yaskawaResolution_rad,
  type PulseScale as YaskawaPulseScale,
} from "./codec/index.ts";
export {
  yaskawaAdapter,
  type YaskawaAdapter,
  type YaskawaAdapterOptions,
  type FileClient as YaskawaFiles,
} from "./adapter/index.ts";
export * from "./virtual/index.ts";
export { yaskawa } from "./brand.ts";
