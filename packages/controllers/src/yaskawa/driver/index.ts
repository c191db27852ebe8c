export { yaskawaFace, type YaskawaFace, type YaskawaFaceOptions } from "./face.ts";
export type { FileClient, FileOutcome } from "./files.ts";
