import { spawnSync } from "node:child_process";
import { existsSync } from "node:fs";
import { statfs } from "node:fs/promises";
import { createServer } from "node:net";
import { homedir } from "node:os";
import { delimiter, join } from "node:path";
import { lanAddresses } from "@twincell/server";
import { given } from "../io/arguments.ts";
import { diagnose, type Machine } from "../io/machine.ts";
import { OPTIONAL_PARTS } from "../io/optional-parts.ts";
import { studioFolder } from "../io/studio-folder.ts";
import { UseFault, type Command } from "../io/usage.ts";

const PORT = 7341;
const CHROMIUMS = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "msedge"];
const CHROMIUM_PLACES = [
  "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
  "C:\\Program Files\\Google\\Chrome\\Application\\chrome.exe",
  "C:\\Program Files (x86)\\Microsoft\\Edge\\Application\\msedge.exe",
];

export const doctorCommand: Command = {
  name: "doctor",
  summary: "what this machine lacks, and the way out",
  usage: `twincell doctor [--port P]

Looks at Node, the studio, the port, the local network (phones and headsets need HTTPS), a Chromium for WebXR, Python for
its clients, disk space and the optional parts. A line each: ok, note or bad, and the way out. Exit 1 when anything is bad.`,
  async run(args) {
    const options = given(args, { port: { type: "string" } });
    const port = options.number("port") ?? PORT;
    if (!(Number.isInteger(port) && port > 0 && port <= 65535))
      throw new UseFault(`--port wants a whole number from 1 to 65535, not ${port}.`);
    const found = diagnose(await lookAtMachine(port));
    for (const { level, about, sentence } of found)
      process.stdout.write(`${level.padEnd(5)} ${about.padEnd(16)} ${sentence}\n`);
    return found.some(({ level }) => level === "bad") ? 1 : 0;
  },
};

async function lookAtMachine(port: number): Promise<Machine> {
  return {
    node: process.versions.node,
    studioBuilt: existsSync(join(studioFolder(), "index.html")),
    portFree: await isFree(port),
    port,
    lanAddresses: lanAddresses(),
    chromium: chromium(),
    python: python(),
    freeBytes: await statfs(homedir()).then(
      ({ bavail, bsize }) => bavail * bsize,
      () => null,
    ),
    parts: OPTIONAL_PARTS.map(({ name, version, what }) => ({
      name: `${name}@${version}`,
      what,
      installed: isInstalled(name),
    })),
  };
}

const isFree = (port: number): Promise<boolean> =>
  new Promise(resolve => {
    const server = createServer();
    server.once("error", () => {
      resolve(false);
    });
    server.listen(port, "127.0.0.1", () => {
      server.close(() => {
        resolve(true);
      });
    });
  });

function isInstalled(name: string): boolean {
  try {
    import.meta.resolve(name);
    return true;
  } catch {
    return false; // The one way in which Node says that a package is not there.
  }
}

function chromium(): string | null {
  const folders = (process.env["PATH"] ?? "").split(delimiter);
  const names = process.platform === "win32" ? CHROMIUMS.map(name => `${name}.exe`) : CHROMIUMS;
  const places = [...CHROMIUM_PLACES, ...folders.flatMap(folder => names.map(name => join(folder, name)))];
  return places.find(place => existsSync(place)) ?? null;
}

function python(): string | null {
  for (const command of ["python3", "python"]) {
    const { stdout, status } = spawnSync(command, ["--version"], { encoding: "utf8", timeout: 5000 });
    const version = /Python (\d+\.\d+)/.exec(stdout ?? "")?.[1];
    if (status === 0 && version !== undefined) return version;
  }
  return null;
}
