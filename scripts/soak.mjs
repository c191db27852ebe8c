// npm run soak: what there is to soak, with the last results; npm run soak -- NAME [ARGUMENTS…] runs one, -- all runs
// every one, for the night.
import { spawnSync } from "node:child_process";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { node, root } from "./prepare.mjs";

const folder = `${root}scripts/soak/`,
  shared = new Set(["kept"]);
const names = readdirSync(folder)
  .filter(file => file.endsWith(".ts") && !file.endsWith(".test.ts"))
  .map(file => file.slice(0, -3))
  .filter(name => !shared.has(name));
const [wanted, ...rest] = process.argv.slice(2);

if (wanted === undefined) {
  for (const name of names) {
    const said =
      /\/\*\*\n([\s\S]*?)\*\//
        .exec(readFileSync(`${folder}${name}.ts`, "utf8"))?.[1]
        .replace(/^ \* ?/gm, "")
        .trim()
        .replace(/\n/g, " ") ?? "";
    const kept = existsSync(`${folder}${name}.json`) ? JSON.parse(readFileSync(`${folder}${name}.json`, "utf8")) : null;
    console.log(
      `${name}\n  ${said}\n  ${kept ? `Last result: ${kept.date ?? "no date"}, ${kept.machine ?? "unknown machine"}.` : "No result yet."}\n`,
    );
  }
  process.exit(0);
}
if (wanted !== "all" && !names.includes(wanted)) {
  console.error(`There is no soak “${wanted}”. There are: ${names.join(", ")}, or all.`);
  process.exit(2);
}
const failed = (wanted === "all" ? names : [wanted]).filter(name => {
  const args = wanted === "all" ? (name === "faults" ? ["--keep"] : []) : rest;
  return (
    spawnSync(node, ["--expose-gc", `scripts/soak/${name}.ts`, ...args], { cwd: root, stdio: "inherit" }).status !== 0
  );
});
if (failed.length > 0) console.error(`Not held: ${failed.join(", ")}.`);
process.exit(failed.length > 0 ? 1 : 0);
