export { serve, type Served, type ServeOptions } from "./serve.ts";
export { servePendant, type ServedPendant } from "./pendant.ts";
export {
  addCellLink,
  addToken,
  mayUse,
  readTokens,
  removeToken,
  ROLES,
  tokenReader,
  type Role,
} from "./people/tokens.ts";
export { auditFile, openAuditLog, readAudit } from "./people/audit-log.ts";
export { checkBackup, makeBackup, restoreBackup } from "./files/backup.ts";
export { lanAddresses } from "./lan.ts";
export { prepareJobInWorker } from "./stations/lay-out.ts";
export { nodeNetwork } from "./sockets/node-network.ts";
export { nodeScheduler } from "./clock.ts";
export { stationHost } from "./stations/host.ts";
export { newFile, recordingFile, recordingFolderOf, recordingsFolder } from "./files/recordings-folder.ts";
export { recordRemote, type RemoteRecorder } from "./stations/record-remote.ts";
export { joinHost, joinServer, type Joined, type Told } from "./stations/join.ts";
export { readConnections, restoreConnections, saveConnection, type SavedConnection } from "./stations/connections.ts";
export { schedulerWith } from "./api/robots.ts";
export { jsonLog, textLog, withoutSecrets, type Log } from "./operations/log.ts";
