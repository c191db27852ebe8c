// npm start: install what is missing, build, serve the studio, say where it is.
import { spawn } from "node:child_process";
import { build, buildDocsBeside, install, node, root } from "./prepare.mjs";

install();
build();
// The pages of the help come a little later: the studio does not wait for them.
const docs = buildDocsBeside();
const child = spawn(node, ["apps/cli/src/main.ts", "serve", "--open", ...process.argv.slice(2)], {
  cwd: root,
  stdio: "inherit",
});
for (const signal of ["SIGINT", "SIGTERM"]) process.on(signal, () => child.kill(signal));
child.on("exit", code => {
  docs?.kill();
  process.exit(code ?? 0);
});
