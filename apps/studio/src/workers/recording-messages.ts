import type { Catalogued } from "@twincell/recording";

export interface ToRecordingReader {
  readonly name: string;
  readonly blob: Blob;
}
export interface FromRecordingReader {
  readonly name: string;
  readonly said: Catalogued;
}
