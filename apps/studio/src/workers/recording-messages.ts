import type { Read } from "@twincell/recording";

export type ToRecordingReader = Uint8Array<ArrayBuffer>;
export type FromRecordingReader = Read;
