import { strToU8, zipSync } from "fflate";

/** No file says when it was made: the same program is the same archive. 1980 is where the format begins to count. */
const EPOCH = new Date(1980, 0, 1);

/** Files in one archive, in their order. */
export const zipped = (files: readonly { readonly name: string; readonly text: string }[]): Uint8Array<ArrayBuffer> =>
  zipSync(Object.fromEntries(files.map(({ name, text }) => [name, strToU8(text)])), {
    level: 6,
    mtime: EPOCH,
  }) as Uint8Array<ArrayBuffer>;
