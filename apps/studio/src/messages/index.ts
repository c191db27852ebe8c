import { en } from "./en.ts";

/** Every string a person sees or hears of. Another language is another file of this shape. */
export type Words = typeof en;
export const words: Words = en;
