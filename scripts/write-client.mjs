/** Writes clients/typescript/src/api.ts: node scripts/write-client.mjs. A test holds the file to it. */
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { clientTypes } from "./client-types.mjs";

const path = fileURLToPath(new URL("../clients/typescript/src/api.ts", import.meta.url));
writeFileSync(path, clientTypes());
const root = fileURLToPath(new URL("..", import.meta.url));
execFileSync(process.execPath, [`${root}node_modules/@biomejs/biome/bin/biome`, "format", "--write", path], {
  cwd: root,
});
