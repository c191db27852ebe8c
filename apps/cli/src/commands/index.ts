import type { Command } from "../io/usage.ts";
import { auditCommand } from "./audit.ts";
import { backupCommand } from "./backup.ts";
import { benchCommand } from "./bench.ts";
import { calibrateCommand } from "./calibrate.ts";
import { checkCommand } from "./check.ts";
import { connectCommand } from "./connect.ts";
import { datasetCommand } from "./dataset.ts";
import { demonstrateCommand } from "./demonstrate.ts";
import { dialectsCommand } from "./dialects.ts";
import { diffCommand } from "./diff.ts";
import { doctorCommand } from "./doctor.ts";
import { firstMotionCommand } from "./first-motion.ts";
import { fkCommand } from "./fk.ts";
import { ikCommand } from "./ik.ts";
import { importCommand } from "./import.ts";
import { jogCommand } from "./jog.ts";
import { meshCommand } from "./mesh.ts";
import { mcpCommand } from "./mcp.ts";
import { moveCommand } from "./move.ts";
import { parseCommand } from "./parse.ts";
import { postCommand } from "./post.ts";
import { reachCommand } from "./reach.ts";
import { recordCommand } from "./record.ts";
import { replayCommand } from "./replay.ts";
import { robotsCommand } from "./robots.ts";
import { runCommand } from "./run.ts";
import { serveCommand } from "./serve.ts";
import { serviceCommand } from "./service.ts";
import { simulateCommand } from "./simulate.ts";
import { stopCommand } from "./stop.ts";
import { tokenCommand } from "./token.ts";
import { validateCommand } from "./validate.ts";
import { virtualCommand } from "./virtual.ts";
import { watchCommand } from "./watch.ts";

export const COMMANDS: readonly Command[] = [
  robotsCommand,
  dialectsCommand,
  fkCommand,
  ikCommand,
  checkCommand,
  reachCommand,
  simulateCommand,
  validateCommand,
  datasetCommand,
  diffCommand,
  postCommand,
  parseCommand,
  runCommand,
  serveCommand,
  serviceCommand,
  virtualCommand,
  connectCommand,
  firstMotionCommand,
  moveCommand,
  jogCommand,
  stopCommand,
  watchCommand,
  recordCommand,
  replayCommand,
  calibrateCommand,
  demonstrateCommand,
  importCommand,
  meshCommand,
  mcpCommand,
  doctorCommand,
  tokenCommand,
  auditCommand,
  backupCommand,
  benchCommand,
];
