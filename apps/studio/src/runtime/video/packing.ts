export interface PackRequest {
  readonly bitmap: ImageBitmap;
  /** 0 … 1 */
  readonly quality: number;
  /** Free bytes in front of the picture, and how long both may be together. */
  readonly headBytes: number;
  readonly most: number;
}
export type PackAnswer = { readonly bytes: Uint8Array<ArrayBuffer> } | { readonly fault: string };

let canvas: OffscreenCanvas | null = null;

/** A picture as JPEG, with room for its head. The bitmap is used up. */
export async function packed({ bitmap, quality, headBytes, most }: PackRequest): Promise<PackAnswer> {
  const { width, height } = bitmap;
  try {
    canvas ??= new OffscreenCanvas(width, height);
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    canvas.getContext("2d")!.drawImage(bitmap, 0, 0);
    const blob = await canvas.convertToBlob({ type: "image/jpeg", quality });
    if (blob.size > most - headBytes)
      return { fault: `A picture of ${(blob.size / 1e6).toFixed(1)} MB is too large to be sent.` };
    const bytes = new Uint8Array(headBytes + blob.size);
    bytes.set(new Uint8Array(await blob.arrayBuffer()), headBytes);
    return { bytes };
  } catch (problem) {
    return {
      fault: `The picture could not be made into a JPEG: ${problem instanceof Error ? problem.message : String(problem)}.`,
    };
  } finally {
    bitmap.close();
  }
}
