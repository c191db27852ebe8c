// What is kept as evidence: the file with the dated result, the command that makes it anew, and the folders whose code
// it judges. A new one is one entry.
import { existsSync } from "node:fs";

const soak = (name, judges, ...options) => ({
  name,
  result: `scripts/soak/${name}.json`,
  command: ["--expose-gc", `scripts/soak/${name}.ts`, ...options],
  judges,
});
const languages = ["packages/languages/src"];

export const EVIDENCE = [
  soak("faults", ["packages/controllers/src"], "--keep"),
  soak("editors", ["packages/project/src/sharing"]),
  soak("fuzz-dialects", languages),
  soak("fuzz-recordings", ["packages/recording/src"]),
  soak("hostile-requests", ["apps/server/src/api", "apps/server/src/people", "apps/server/src/sockets"]),
  soak("ik-round-trips", ["packages/core/src/kinematics"]),
  soak("imports", languages),
  soak("jog-singular", ["packages/core/src/teach", "packages/core/src/kinematics"]),
  soak("kill-recorder", ["packages/recording/src", "apps/cli/src/commands/record.ts"]),
  soak("physics-hour", ["packages/physics/src"]),
  soak("profile", ["packages/core/src/trajectory"]),
  soak("random-programs", ["packages/controllers/src", "packages/core/src/collision"], "--keep"),
  soak("round-trips", languages),
  soak("thin-obstacles", ["packages/core/src/collision"]),
  soak("verdicts", ["packages/core/src/collision", "packages/core/src/mesh"]),
  {
    name: "public-programs",
    result: "docs/public-programs.json",
    command: ["scripts/public-programs.ts", process.env.TWINCELL_PUBLIC_PROGRAMS ?? "public-programs", "--write"],
    judges: languages,
  },
];

/** Whether each result has its script: a renamed one is seen. */
export const scriptsOf = (evidence, root) =>
  evidence.map(each => each.command.find(word => word.endsWith(".ts"))).filter(script => !existsSync(root + script));
