import { asciiText } from "../../parser/index.ts";

/** Characters of a job name since the NX100, and of a comment. */
const JOB_LENGTH = 32;
const COMMENT_LENGTH = 32;

/** A job name: capitals, digits, `-` and `_`, at most 32 characters, not in `taken`, which receives it. */
export function jobName(name: string, taken: Set<string>): string {
  const plain = asciiText(name)
    .toUpperCase()
    .replace(/[^A-Z0-9_-]+/g, "_")
    .replace(/^[_-]+|[_-]+$/g, "");
  const stem = plain === "" ? "JOB" : plain.slice(0, JOB_LENGTH);
  for (let i = 1; ; i++) {
    const tail = i === 1 ? "" : `-${i}`;
    const tried = stem.slice(0, JOB_LENGTH - tail.length) + tail;
    if (taken.has(tried)) continue;
    taken.add(tried);
    return tried;
  }
}

/**
 * What a person called something, as it can stand in a comment. Marks that the reader of comments keeps for itself are
 * dropped.
 */
export const commentText = (name: string, length = COMMENT_LENGTH): string =>
  asciiText(name)
    .replace(/^[*='\s]+/, "")
    .slice(0, length)
    .trim();
/** The comment of a job, and the name of a tool or a user frame. */
export const titleText = (name: string): string => asciiText(name).slice(0, COMMENT_LENGTH).trim();
