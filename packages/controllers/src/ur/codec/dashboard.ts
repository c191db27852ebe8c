/**
 * Words of the dashboard: what is asked, and what is answered. Both sides take them from here; neither is tested
 * against the other alone.
 */
export const BANNER = "Connected: Universal Robots Dashboard Server";

/** Commands by their word; what follows the word is the argument. Longer words go first where one begins another. */
export const COMMANDS = [
  "robotmode",
  "safetymode",
  "safetystatus",
  "power on",
  "power off",
  "brake release",
  "load installation",
  "load",
  "play",
  "pause",
  "stop",
  "running",
  "programstate",
  "get loaded program",
  "isprogramsaved",
  "unlock protective stop",
  "close safety popup",
  "close popup",
  "popup",
  "addtolog",
  "restart safety",
  "polyscopeversion",
  "version",
  "get serial number",
  "get robot model",
  "is in remote control",
  "get operational mode",
  "set operational mode",
  "clear operational mode",
  "generate flight report",
  "generate support file",
  "savelog",
  "quit",
  "shutdown",
] as const;
export type DashboardCommand = (typeof COMMANDS)[number];

/** Commands that change nothing: they are answered in local control too. */
const ASKING: ReadonlySet<DashboardCommand> = new Set<DashboardCommand>([
  "robotmode",
  "safetymode",
  "safetystatus",
  "running",
  "programstate",
  "get loaded program",
  "isprogramsaved",
  "polyscopeversion",
  "version",
  "get serial number",
  "get robot model",
  "is in remote control",
  "get operational mode",
  "quit",
  "addtolog",
  "savelog",
]);
export const onlyRequests = (command: DashboardCommand): boolean => ASKING.has(command);

export interface Asked {
  readonly command: DashboardCommand;
  readonly argument: string;
}
/** Capitals count the same. Null when it is no command. */
export function readCommand(line: string): Asked | null {
  const text = line.trim();
  const lower = text.toLowerCase();
  for (const command of COMMANDS) {
    if (lower === command) return { command, argument: "" };
    if (lower.startsWith(`${command} `)) return { command, argument: text.slice(command.length + 1).trim() };
  }
  return null;
}

export const REPLIES = {
  notUnderstood: (line: string): string => `could not understand: "${line}"`,
  failed: (command: string): string => `Failed to execute: ${command}`,
  /** No word of the vendor is known for it: a line of that kind. */
  local: (command: string): string =>
    `Command is not allowed due to safety reasons: ${command} is not allowed in local control`,
  tooSoon:
    "Cannot unlock protective stop until 5s after occurrence. Always inspect cause of protective stop before unlocking",
  unlocking: "Protective stop releasing",
  poweringOn: "Powering on",
  poweringOff: "Powering off",
  releasing: "Brake releasing",
  starting: "Starting program",
  pausing: "Pausing program",
  stopped: "Stopped",
} as const;

/** What stands behind the colon of an answer: `Robotmode: RUNNING` is RUNNING. */
export const valueIn = (answer: string): string => answer.slice(answer.indexOf(":") + 1).trim();
