export * from "./expression.ts";
export * from "./typing.ts";
export * from "./evaluate.ts";
export * from "./print.ts";
export * from "./parse.ts";
export { KEYWORDS } from "./words.ts";
