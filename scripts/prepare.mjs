// What both commands of the README need first: the packages of the lock file, and a Node that runs TypeScript.
// Runs on any Node from 20.19, without any package installed; what it starts runs on the Node 24 of the lock file.
import { spawn, spawnSync } from "node:child_process";
import { existsSync, mkdirSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { createHash } from "node:crypto";
import { constants, setPriority } from "node:os";
import { fileURLToPath } from "node:url";

export const root = fileURLToPath(new URL("..", import.meta.url));
/** The Node of the lock file: it runs .ts files as they are. */
export const node = `${root}node_modules/node/bin/node`;

const stamp = `${root}node_modules/.twincell-installed`;
const lockHash = () =>
  createHash("sha256")
    .update(readFileSync(`${root}package-lock.json`))
    .digest("hex");

/** Installs what the lock file names, unless that was done before. Works offline from then on. */
export function install() {
  const [major, minor] = process.versions.node.split(".").map(Number);
  if (major < 20 || (major === 20 && minor < 19)) {
    console.error(`Twincell needs Node 24; this is ${process.versions.node}. Install Node 24 or newer.`);
    process.exit(2);
  }
  const wanted = lockHash();
  if (existsSync(node) && existsSync(stamp) && readFileSync(stamp, "utf8") === wanted) return;
  console.log("Installing packages (once) …");
  // npm would name each package that wants a newer Node; one sentence says it for all of them.
  if (major < 24)
    console.log(
      `This is Node ${process.versions.node}: the Node 24 that is installed with the packages is used instead.`,
    );
  run("npm", ["ci", "--no-audit", "--no-fund", ...(major < 24 ? ["--loglevel=error"] : [])]);
  if (!existsSync(node)) {
    console.error(
      "The packages are installed but node_modules/node/bin/node is missing: npm was told to skip install scripts. Run `npm ci --ignore-scripts=false`.",
    );
    process.exit(2);
  }
  writeFileSync(stamp, wanted);
}

/** A build is for people, also where a test asks for it: there NODE_ENV is "test", which made a slow one for developers. */
const PRODUCTION = { ...process.env, NODE_ENV: "production" };

/** Builds the studio when a source file is newer than the last build. */
export function build() {
  const built = `${root}apps/studio/dist/index.html`;
  const sources = [
    "packages",
    "apps/studio/src",
    "apps/studio/index.html",
    ...readdirSync(`${root}apps/studio`)
      .filter(name => /^vite.*\.ts$/.test(name))
      .map(name => `apps/studio/${name}`),
    "package-lock.json",
  ];
  if (existsSync(built) && !isNewer(sources, statSync(built).mtimeMs)) return;
  console.log("Building the studio …");
  run(node, ["node_modules/vite/bin/vite.js", "build", "apps/studio", "--logLevel", "warn"], { env: PRODUCTION });
}

/** Whether a file of these paths, tests apart, was changed after a time [ms since 1970]. */
function isNewer(paths, since_ms) {
  const found = spawnSync(
    "find",
    [...paths, "-newermt", new Date(since_ms).toISOString(), "-type", "f", "-not", "-name", "*.test.ts"],
    { cwd: root, encoding: "utf8" },
  );
  return found.status !== 0 || found.stdout.trim() !== "";
}

const VITEPRESS = ["node_modules/vitepress/bin/vitepress.js", "build", "docs"];

/** Builds the documentation; a link that leads nowhere ends it. */
export function buildDocs() {
  console.log("Building the documentation …");
  run(node, VITEPRESS, { env: PRODUCTION });
}

/** Builds the documentation with least priority when a page is newer than the last build; the process, or undefined. */
export function buildDocsBeside() {
  const built = `${root}docs/.vitepress/dist/index.html`;
  const sources = [...readdirSync(`${root}docs`).map(name => `docs/${name}`), "docs/.vitepress/config.mjs"];
  const pages = sources.filter(name => name !== "docs/.vitepress");
  if (existsSync(built) && !isNewer(pages, statSync(built).mtimeMs)) return undefined;
  const child = spawn(node, VITEPRESS, { cwd: root, env: PRODUCTION, stdio: ["ignore", "ignore", "inherit"] });
  if (child.pid !== undefined) setPriority(child.pid, constants.priority.PRIORITY_LOW);
  child.on("error", problem => console.error(`The documentation is not built: ${problem.message}`));
  return child;
}

export function run(command, args, options = {}) {
  const result = spawnSync(command, args, { cwd: root, stdio: "inherit", ...options });
  if (result.error) {
    console.error(`${command}: ${result.error.message}`);
    process.exit(2);
  }
  if (result.status !== 0) process.exit(result.status ?? 1);
}

/** Folder for what tests leave to be looked at: screenshots, reports. */
export function outFolder() {
  mkdirSync(`${root}out`, { recursive: true });
  return `${root}out/`;
}
