/** What a machine has of what Twincell wants. Unknown things are null. */
export interface Machine {
  /** "24.21.0" */
  readonly node: string;
  readonly studioBuilt: boolean;
  /** Whether the port that `serve` takes by default is free. */
  readonly portFree: boolean;
  readonly port: number;
  readonly lanAddresses: readonly string[];
  readonly chromium: string | null;
  /** "3.12", or null where no Python answers. */
  readonly python: string | null;
  /** Free bytes where the server keeps its recordings. */
  readonly freeBytes: number | null;
  /** Optional parts of the package: name@version, and whether it is there. */
  readonly parts: readonly { readonly name: string; readonly what: string; readonly installed: boolean }[];
}

/** One thing looked at. Only `bad` keeps Twincell from working; every other level than `ok` says the way out. */
export interface Diagnosis {
  readonly level: "ok" | "note" | "bad";
  readonly about: string;
  readonly sentence: string;
}

const LEAST_NODE = [24, 0] as const;
const LEAST_PYTHON = [3, 10] as const;
const LEAST_BYTES = 1e9;

/** What a machine lacks, a sentence each, with the way out. */
export function diagnose(machine: Machine): readonly Diagnosis[] {
  const { port, freeBytes, python, chromium } = machine;
  const found: Diagnosis[] = [];
  const say = (level: Diagnosis["level"], about: string, sentence: string): void => {
    found.push({ level, about, sentence });
  };
  if (atLeast(machine.node, LEAST_NODE)) say("ok", "Node", `Node ${machine.node} runs Twincell.`);
  else say("bad", "Node", `Node ${machine.node} is too old. Install Node ${LEAST_NODE.join(".")} or newer.`);
  if (machine.studioBuilt) say("ok", "studio", "The studio is there.");
  else say("bad", "studio", "The studio is not built. Run npm run build, or install the package anew.");
  if (machine.portFree) say("ok", "port", `Port ${port} is free.`);
  else say("note", "port", `Port ${port} is taken: serve takes the next free one; choose another with --port.`);
  say(
    machine.lanAddresses.length > 0 ? "ok" : "note",
    "secure context",
    machine.lanAddresses.length > 0
      ? `Phones and headsets reach this machine at ${machine.lanAddresses.join(", ")} with serve --lan, which makes a certificate; without HTTPS a browser gives them neither WebXR nor a camera.`
      : "This machine has no address in a local network: join one before serve --lan, or use the studio on this machine, where no certificate is needed.",
  );
  if (chromium !== null)
    say("ok", "browser", `Chromium is at ${chromium}; WebXR needs a Chromium or a headset's own browser.`);
  else
    say(
      "note",
      "browser",
      "No Chromium was found. Any current browser shows the studio; for WebXR use Chrome, Edge or a headset's own browser.",
    );
  if (python !== null && atLeast(python, LEAST_PYTHON))
    say("ok", "Python", `Python ${python} runs the Python clients.`);
  else
    say(
      "note",
      "Python",
      `${python === null ? "No Python was found" : `Python ${python} is too old for the Python clients`}. Install Python ${LEAST_PYTHON.join(".")} or newer where you want to use them.`,
    );
  if (freeBytes === null)
    say("note", "disk", "How much disk is free could not be read. Look before recording for long.");
  else if (freeBytes < LEAST_BYTES)
    say(
      "bad",
      "disk",
      `Only ${megabytes(freeBytes)} MB of disk are free. Make room: recordings need at least 1000 MB.`,
    );
  else say("ok", "disk", `${megabytes(freeBytes)} MB of disk are free.`);
  for (const { name, what, installed } of machine.parts)
    if (installed) say("ok", name, `${what} on the command line is installed.`);
    else say("note", name, `${what} on the command line is not installed. Add it with npm install ${name}.`);
  return found;
}

const megabytes = (bytes: number): string => String(Math.floor(bytes / 1e6));

function atLeast(version: string, [major, minor]: readonly [number, number]): boolean {
  const [has = 0, hasMinor = 0] = version.split(".").map(Number);
  return has > major || (has === major && hasMinor >= minor);
}
