/** Size of a small picture of a cell [px]: twice that of its card. */
export const THUMBNAIL = { width: 536, height: 348 } as const;

let draw: (() => string | null) | null = null;

/** The scene says how the open cell is drawn as a small picture. @returns what takes that back. */
export function onDrawThumbnail(next: () => string | null): () => void {
  draw = next;
  return () => {
    if (draw === next) draw = null;
  };
}
/** The open cell as a data URL; null while there is no 3D view. */
export const drawThumbnail = (): string | null => draw?.() ?? null;
