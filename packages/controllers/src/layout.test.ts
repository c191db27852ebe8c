import { readdirSync } from "node:fs";
import { expect, test } from "vitest";

const here = (path: string): URL => new URL(path, import.meta.url);
const entries = (path: string): readonly string[] => readdirSync(here(path)).filter(name => name !== "testing");
const VENDORS = readdirSync(here("."), { withFileTypes: true })
  .filter(entry => entry.isDirectory() && entry.name !== "driver" && entries(`./${entry.name}`).includes("brand.ts"))
  .map(({ name }) => name);

test("every driver has its folder", () => {
  expect(VENDORS).toEqual(["abb", "fanuc", "kuka", "staubli", "staubli-cs7", "ur", "yaskawa"]);
});

test.each(VENDORS)("%s is laid out as every vendor: codec, adapter, virtual, and what apps meet", vendor => {
  const own = entries(`./${vendor}`).filter(name => !/\.test\.ts$/.test(name));
  expect(own.sort()).toEqual(["adapter", "brand.ts", "cannot.ts", "codec", "index.ts", "virtual"]);
  expect(entries(`./${vendor}/adapter`)).toEqual(expect.arrayContaining(["adapter.ts", "words.ts"]));
  expect(entries(`./${vendor}/virtual`)).toEqual(expect.arrayContaining(["controller.ts", "pendant.ts"]));
});
