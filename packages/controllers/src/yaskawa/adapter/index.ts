export { yaskawaAdapter, type YaskawaAdapter, type YaskawaAdapterOptions } from "./adapter.ts";
export type { FileClient, FileOutcome } from "./files.ts";
