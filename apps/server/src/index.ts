export { serve, type Served, type ServeOptions } from "./serve.ts";
export { servePendant, type ServedPendant } from "./pendant.ts";
export { lanAddresses } from "./lan.ts";
export { prepareJobInWorker } from "./stations/lay-out.ts";
export { nodeNetwork } from "./sockets/node-network.ts";
export { nodeScheduler } from "./clock.ts";
export { stationHost } from "./stations/host.ts";
export { newFile, recordingFile, recordingsFolder } from "./files/recordings-folder.ts";
export { recordRemote, type RemoteRecorder } from "./stations/record-remote.ts";
