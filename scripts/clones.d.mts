/** A token of a source text. */
export interface CodeToken {
  readonly word: string;
}
/** A file of code, and the folder that it counts to. */
export interface CodeFile {
  readonly folder: string;
  readonly path: string;
  readonly text: string;
}
/** Two equal passages; lines count from 1. */
export interface ClonePair {
  readonly lines: number;
  readonly tokens: number;
  readonly sides: readonly { readonly path: string; readonly first: number; readonly last: number }[];
}
export const LEAST_LINES: number;
export const LEAST_TOKENS: number;
/** Tokens without comments and imports. */
export function tokensOf(text: string): CodeToken[];
/** Equal passages of different folders, longest first. */
export function clonesIn(files: readonly CodeFile[]): ClonePair[];
/** Sources under a folder, tests and `testing` apart. */
export function filesOf(folder: string): CodeFile[];
/** A pair as one line for a person. */
export function sentence(pair: ClonePair): string;
