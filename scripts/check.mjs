// npm run check: format, lint, boundaries, types and the tests beside what changed since main was left (or since the last
// commit, on main itself). Under a minute for a change of one package; npm test is the whole.
import { spawnSync } from "node:child_process";
import { existsSync, readdirSync } from "node:fs";
import { dirname } from "node:path";
import { install, node, root } from "./prepare.mjs";

install();
const began = Date.now();
const git = (...args) => spawnSync("git", args, { cwd: root, encoding: "utf8" }).stdout.trim();
const lines = text => text.split("\n").filter(line => line !== "");
const base = git("merge-base", "HEAD", process.argv[2] ?? "main") || "HEAD";
const changed = [
  ...new Set([
    ...lines(git("diff", "--name-only", "--diff-filter=d", base)),
    ...lines(git("ls-files", "--others", "--exclude-standard")),
  ]),
];
const code = changed.filter(file => /\.(ts|tsx|mjs)$/.test(file));
if (code.length === 0) {
  console.log("No code changed.");
  process.exit(0);
}
// A change of a package is compiled with all that joins it; an app alone is compiled alone.
const places = new Set(code.map(file => /^(packages|apps)\/[^/]+/.exec(file)?.[0]).filter(Boolean));
const packages = [...places].some(place => place.startsWith("packages/"));
const projects = [...places, ...(packages ? ["apps/studio", "apps/server", "apps/cli"] : [])];
const tests = [...new Set(code.map(file => dirname(file)).filter(folder => folder.includes("/src")))]
  .flatMap(folder => readdirSync(root + folder).map(name => `${folder}/${name}`))
  .concat(code)
  .filter(file => /\.test\.tsx?$/.test(file) && !file.includes("browser-tests/"));
const besides = [...new Set(tests)];
const stages = [
  ["format", ["node_modules/@biomejs/biome/bin/biome", "format", ...code]],
  ["lint", ["node_modules/eslint/bin/eslint.js", "--max-warnings", "0", "--no-warn-ignored", ...code]],
  ["boundaries", depcruise()],
  ...[...new Set(projects)]
    .map(place => `${place}/tsconfig.json`)
    .filter(project => existsSync(root + project))
    .map(project => [`types of ${project}`, ["node_modules/typescript7/bin/tsc", "-p", project]]),
  // Tests beside what changed; what imports it from afar is npm test's.
  ["tests", ["node_modules/vitest/vitest.mjs", "run", "--project", "quick", "--passWithNoTests", ...besides]],
];

const failed = [];
for (const [name, args] of stages) {
  const { status } = spawnSync(node, args, { cwd: root, stdio: "inherit" });
  if (status !== 0) failed.push(name);
}
const seconds = ((Date.now() - began) / 1000).toFixed(0);
console.log(failed.length ? `Not passed: ${failed.join(", ")} (${seconds} s).` : `Checked in ${seconds} s.`);
process.exit(failed.length ? 1 : 0);

function depcruise() {
  return ["node_modules/dependency-cruiser/bin/dependency-cruiser.mjs", "--config", "dependency-cruiser.mjs"].concat(
    [...places].length ? [...places] : ["packages"],
  );
}
