// npm test: lint, boundary rules, clones, types, unit tests, browser tests; everything it needs is installed first.
import { spawnSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { build, install, node, outFolder, root } from "./prepare.mjs";
import { chromium } from "./chromium.mjs";
import { clientsPython, installBrokers, installBrowsers, installClients } from "./clients.mjs";
import { EVIDENCE } from "./evidence/list.mjs";
import { evidenceStates, stateSentence } from "./evidence/state.mjs";

install();
// In CI a client that is missing is a failure; elsewhere its tests say that they are skipped.
const clientsProblems = process.env.CI
  ? [installClients(), ...installBrokers(), ...installBrowsers()].filter(problem => problem !== undefined)
  : [];
const out = outFolder();
const browser = chromium();
const bin = name => `node_modules/${name}`;
const vitest = (config, report) => [
  bin("vitest/vitest.mjs"),
  "run",
  "--config",
  config,
  "--reporter=default",
  "--reporter=json",
  `--outputFile.json=${out}${report}`,
];

const stages = [
  ["format", [bin("@biomejs/biome/bin/biome"), "format", "."]],
  ["lint", [bin("eslint/bin/eslint.js"), ".", "--max-warnings", "0"]],
  [
    "boundaries",
    [bin("dependency-cruiser/bin/dependency-cruiser.mjs"), "--config", "dependency-cruiser.mjs", "packages", "apps"],
  ],
  ["clones", ["scripts/clones.mjs"]],
  ["types", ["scripts/types.mjs"]],
  ["unit tests", vitest("vitest.config.ts", "unit.json")],
  ["browser tests", browser ? vitest("vitest.browser.config.ts", "browser.json") : null],
];

const failed = [];
for (const problem of clientsProblems) console.log(problem);
if (clientsProblems.length > 0) failed.push("third-party clients");
const python = process.env.TWINCELL_PYTHON ?? clientsPython();
for (const [name, args] of stages) {
  console.log(`\n── ${name}`);
  if (args === null) {
    failed.push(name);
    continue;
  }
  if (name === "browser tests") build();
  const began = Date.now();
  const result = spawnSync(node, args, {
    cwd: root,
    stdio: "inherit",
    env: {
      ...process.env,
      PATH: `${root}node_modules/.bin:${process.env.PATH}`,
      ...(browser ? { TWINCELL_CHROMIUM: browser } : {}),
      ...(python ? { TWINCELL_PYTHON: python } : {}),
    },
  });
  console.log(
    `── ${name}: ${result.status === 0 ? "passed" : "FAILED"} in ${((Date.now() - began) / 1000).toFixed(0)} s`,
  );
  if (result.status !== 0) failed.push(name);
}

let passedTests = 0,
  failedTests = 0,
  skippedTests = 0;
for (const report of ["unit.json", "browser.json"]) {
  if (!existsSync(out + report)) continue;
  const { numPassedTests, numFailedTests, numPendingTests } = JSON.parse(readFileSync(out + report, "utf8"));
  passedTests += numPassedTests;
  failedTests += numFailedTests;
  skippedTests += numPendingTests;
}
const stale = evidenceStates(EVIDENCE, root).filter(state => state.level !== "current");
if (stale.length > 0) {
  console.log("\nEvidence that is missing or older than the code it judges (this fails nothing):");
  for (const state of stale) console.log(`  ${stateSentence(state)}`);
}
if (failed.length) console.log(`\nNot passed: ${failed.join(", ")}.`);
console.log(`\n${passedTests} passed, ${failedTests} failed, ${skippedTests} skipped`);
process.exit(failed.length ? 1 : 0);
