#!/usr/bin/env node
import { constants, enableCompileCache } from "node:module";
import { homedir } from "node:os";
import { join } from "node:path";

/**
 * What was compiled once is read from the disk the next time: a server is back after less than half the time. It lies
 * where programs keep what they can make anew; without such a place, or with NODE_DISABLE_COMPILE_CACHE, it is compiled
 * each time.
 */
process.env["NODE_COMPILE_CACHE"] ??= join(
  process.env["XDG_CACHE_HOME"] ?? join(homedir(), ".cache"),
  "twincell",
  "compiled",
);
const { status } = enableCompileCache(process.env["NODE_COMPILE_CACHE"]);
// Threads and processes of this one would try again, and fail again.
if (status === constants.compileCacheStatus.FAILED) delete process.env["NODE_COMPILE_CACHE"];

const { runCommandLine } = await import("./command-line.ts");
await runCommandLine(process.argv.slice(2));
