import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { LOOP_FILES, RSI_FILE } from "./loop.ts";

test("the programs that the manual offers are those that both sides are built on", () => {
  for (const { name, text } of [...LOOP_FILES, RSI_FILE]) {
    const offered = readFileSync(new URL(`../../../../../docs/controllers/${name}`, import.meta.url), "latin1");
    expect(offered.replaceAll("\r\n", "\n"), name).toBe(text.replaceAll("\r\n", "\n"));
    expect(
      text.split("\r\n").every(line => line.length < 470 && /^[\x20-\x7e]*$/.test(line)),
      name,
    ).toBe(true);
  }
});
