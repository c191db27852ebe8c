// npm run clients: third-party clients and parsers, which tests hold ours against, in a Python environment of their
// own; two brokers: mosquitto of the system and nats-server, which Go builds; and Firefox and WebKitGTK beside
// Chromium. Installed once for each state of scripts/clients/requirements.txt; `npm test` uses them where they are, CI
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
  "asyncua",
  "fanuc_rmi",
  "jsonschema",
  "mcap_ros2.reader",
  "openapi_spec_validator",
  "opentelemetry.proto.collector.trace.v1.trace_service_pb2",
  "paho.mqtt.client",
  "pandas",
  "py_openshowvar",
  "pymodbus.client",
  "pytest",
  "rapidchecker",
  "RSIPI",
  "roslibpy",
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

const NATS = "github.com/nats-io/nats-server/v2@v2.15.2";
const brokers = `${root}.cache/brokers`;
const has = command => spawnSync(command, ["-h"], { stdio: "ignore" }).error === undefined;

/** Brings the brokers that are missing. Returns the sentences of what went wrong. */
export function installBrokers() {
  const problems = [];
  const run = (command, args, env = {}) =>
    spawnSync(command, args, { stdio: "inherit", env: { ...process.env, ...env } }).status === 0;
  if (!existsSync(`${brokers}/nats-server${windows ? ".exe" : ""}`)) {
    console.log("Building nats-server (once) …");
    mkdirSync(brokers, { recursive: true });
    const go = ["go", "/usr/local/go/bin/go"].find(each => spawnSync(each, ["version"]).status === 0);
    if (go === undefined || !run(go, ["install", NATS], { GOBIN: brokers }))
      problems.push(`nats-server is not there: it is built with \`go install ${NATS}\`, which needs Go.`);
  }
  const mosquitto = ["mosquitto", "/usr/sbin/mosquitto", "/usr/local/sbin/mosquitto"];
  if (!mosquitto.some(has)) {
    const isRoot = process.getuid?.() === 0;
    const installed =
      isRoot &&
      has("apt-get") &&
      run("apt-get", ["update"]) &&
      run("apt-get", ["install", "-y", "--no-install-recommends", "mosquitto"]);
    if (!installed) problems.push("mosquitto is not there: install it with the packages of this system.");
  }
  return problems;
}

/** Browsers beside Chromium, and a display for them: without one they have no WebGL. */
const BROWSERS = { "firefox-esr": "firefox-esr", WebKitWebDriver: "webkit2gtk-driver", Xvfb: "xvfb" };
const FOR_WEBGL = ["libegl1", "libgl1-mesa-dri"];

/** Installs the browsers that are missing, from Debian's packages. Returns the sentences of what went wrong. */
export function installBrowsers() {
  const there = name => spawnSync("which", [name], { stdio: "ignore" }).status === 0;
  const missing = () => Object.keys(BROWSERS).filter(name => !there(name));
  if (missing().length === 0) return [];
  if (process.getuid?.() === 0 && there("apt-get")) {
    console.log("Installing Firefox and WebKitGTK (once) …");
    const env = { ...process.env, DEBIAN_FRONTEND: "noninteractive" };
    const names = [...Object.values(BROWSERS), ...FOR_WEBGL];
    spawnSync("apt-get", ["update", "-qq"], { stdio: "inherit" });
    spawnSync("apt-get", ["install", "-y", "-qq", "--no-install-recommends", ...names], { stdio: "inherit", env });
  }
  return missing().map(
    name => `${name} is not there: install ${BROWSERS[name]} with the packages of this system (Debian's names).`,
  );
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const problems = [installClients(), ...installBrokers(), ...installBrowsers()].filter(
    problem => problem !== undefined,
  );
  for (const problem of problems) console.error(problem);
  if (problems.length > 0) process.exit(1);
  console.log(`Third-party clients are in ${folder}.`);
}
