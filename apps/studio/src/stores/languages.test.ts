import { LIBRARY, robotById } from "@twincell/core";
import { DIALECTS } from "@twincell/languages";
import { beforeEach, expect, test } from "vitest";
import { chooseLanguage, languageOf, languagesOf, languageStore } from "./languages.ts";

const ur = robotById("ur10e")!;
const rx = robotById("staubli_rx90l")!;
beforeEach(() => {
  languageStore.setState({ chosen: {} });
});

test("a robot's own language comes first; the others say in a sentence why not", () => {
  expect(languageOf(ur)?.id).toBe("urscript");
  expect(languageOf(rx)?.id).toBe("v-plus");
  for (const robot of LIBRARY) {
    const all = languagesOf(robot);
    expect(new Set(all.map(each => each.dialect))).toEqual(new Set(DIALECTS));
    for (const { why } of all) if (why !== null) expect(why).toMatch(/\.$/);
  }
});

test("the choice is kept for each robot; one that its controller does not understand is not taken", () => {
  const own = languagesOf(rx)
    .filter(each => each.why === null)
    .map(each => each.dialect.id);
  const last = own.at(-1)!;
  chooseLanguage(rx.id, last);
  chooseLanguage(ur.id, "v-plus");
  expect(languageOf(rx)?.id).toBe(last);
  expect(languageOf(ur)?.id).toBe("urscript");
  expect(languageOf(null)).toBeNull();
});
