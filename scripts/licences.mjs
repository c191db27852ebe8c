// node scripts/licences.mjs: the licences of everything that a release contains, from the lock file, as Markdown.
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

const root = fileURLToPath(new URL("..", import.meta.url));
/**
 * Licences under which parts may be in a release. LGPL is one file of its own, loaded apart from the rest and
 * replaceable.
 */
const ALLOWED =
  /^(MIT|MIT-0|ISC|0BSD|BSD-2-Clause|BSD-3-Clause|Apache-2\.0|Zlib|OFL-1\.1|Unlicense|CC0-1\.0|BlueOak-1\.0\.0|CC-BY-4\.0|Python-2\.0)$/;
const APART = new Map([["occt-import-js", "LGPL-2.1"]]);

/** What the licence file of a package says where its package.json does not: MIT texts, fonts under OFL and Apache. */
const REVIEWED = new Map([
  ["@pmndrs/handle", "MIT"],
  ["@pmndrs/msdfonts", "OFL-1.1 AND Apache-2.0"],
  ["@pmndrs/pointer-events", "MIT"],
  ["@pmndrs/uikit", "MIT"],
  ["@pmndrs/xr", "MIT"],
  ["@react-three/handle", "MIT"],
  ["@react-three/uikit", "MIT"],
  ["@react-three/xr", "MIT"],
  ["dequeue", "BSD-2-Clause"],
  ["humanize", "MIT"],
  ["precond", "MIT"],
  ["webgl-constants", "MIT"],
]);

/** Packages of the lock file that are not for development alone: name, version, licence. */
export function released() {
  const { packages } = JSON.parse(readFileSync(`${root}package-lock.json`, "utf8"));
  return Object.entries(packages)
    .filter(([path, { dev, devOptional, link }]) => path.startsWith("node_modules/") && !dev && !devOptional && !link)
    .map(([path, { version, license }]) => {
      const name = path.slice(path.lastIndexOf("node_modules/") + "node_modules/".length);
      return { name, version, licence: REVIEWED.get(name) ?? license ?? "not stated" };
    })
    .toSorted((a, b) => (a.name < b.name ? -1 : 1));
}

/** Whether a licence text such as "(MIT OR Apache-2.0)" leaves a choice that is allowed. */
export const isAllowed = ({ name, licence }) =>
  APART.get(name) === licence ||
  licence
    .replace(/[()]/g, "")
    .split(" OR ")
    .some(one => one.split(" AND ").every(each => ALLOWED.test(each.trim())));

export function thirdParty() {
  const rows = released().map(({ name, version, licence }) => `| ${name} | ${version} | ${licence} |`);
  return `# Parts by others\n\n| package | version | licence |\n|---|---|---|\n${rows.join("\n")}\n`;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  process.stdout.write(thirdParty());
  const refused = released().filter(each => !isAllowed(each));
  for (const { name, version, licence } of refused)
    process.stderr.write(`${name} ${version}: ${licence} is not allowed.\n`);
  process.exitCode = refused.length > 0 ? 1 : 0;
}
