// Type-checks every package under its own compiler settings: a package of ours sees no DOM, no Node, no clock.
import { spawnSync } from "node:child_process";
import { readdirSync, existsSync } from "node:fs";
import { fileURLToPath } from "node:url";

const root = fileURLToPath(new URL("..", import.meta.url));
const projects = ["packages", "apps"]
  .flatMap(floor => readdirSync(`${root}${floor}`).map(name => `${floor}/${name}/tsconfig.json`))
  .filter(path => existsSync(root + path))
  .concat("tsconfig.tests.json");

let bad = 0;
for (const project of projects) {
  const run = spawnSync(process.execPath, ["node_modules/typescript7/bin/tsc", "-p", project], {
    cwd: root,
    stdio: "inherit",
  });
  if (run.status !== 0) {
    bad++;
    console.error(`types: ${project} does not compile.`);
  }
}
console.log(`types: ${projects.length - bad} of ${projects.length} projects compile.`);
process.exit(bad ? 1 : 0);
