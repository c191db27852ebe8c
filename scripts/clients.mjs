// npm run clients: third-party clients and parsers, which tests hold ours against, in a Python environment of their
// own. Installed once for each state of scripts/clients/requirements.txt; `npm test` uses them where they are, CI
// installs them.
import { spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { root } from "./prepare.mjs";

const requirements = `${root}scripts/clients/requirements.txt`;
const folder = `${root}.cache/clients`;
const windows = process.platform === "win32";
const python = windows ? `${folder}/Scripts/python.exe` : `${folder}/bin/python3`;
const stamp = `${folder}/.installed`;
/** What must be importable for the tests to run against all of them. */
const MODULES = [
  "abb_robot_client.egm",
  "abb_robot_client.rws",
  "fanuc_rmi",
  "jsonschema",
  "mcap_ros2.reader",
  "openapi_spec_validator",
  "pandas",
  "py_openshowvar",
  "pytest",
  "rapidchecker",
  "RSIPI",
  "rtde_control",
  "urx.urrtmon",
  "websockets",
];

const wanted = () => createHash("sha256").update(readFileSync(requirements)).digest("hex");

/** The Python that has the clients; undefined before `npm run clients`. */
export const clientsPython = () => (existsSync(stamp) && readFileSync(stamp, "utf8") === wanted() ? python : undefined);

/** Installs what is missing. Returns the sentence of what went wrong, or undefined. */
export function installClients() {
  if (clientsPython() !== undefined) return undefined;
  console.log("Installing third-party clients (once) …");
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  const steps = [
    [windows ? "python" : "python3", ["-m", "venv", folder]],
    [python, ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-r", requirements]],
    [
      python,
      [
        "-c",
        `import importlib.util as u, sys\nsys.exit(", ".join(m for m in ${JSON.stringify(MODULES)} if u.find_spec(m) is None) or 0)`,
      ],
    ],
  ];
  for (const [command, args] of steps) {
    const { status, error } = spawnSync(command, args, { stdio: "inherit" });
    if (status !== 0)
      return `Third-party clients are not installed: \`${command} ${args.slice(0, 3).join(" ")} …\` ended with ${error?.message ?? status}. Python 3.10 or newer with venv and pip is needed.`;
  }
  writeFileSync(stamp, wanted());
  return undefined;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const problem = installClients();
  if (problem !== undefined) {
    console.error(problem);
    process.exit(1);
  }
  console.log(`Third-party clients are in ${folder}.`);
}
