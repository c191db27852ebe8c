export * from "./messages.ts";
export * from "./shared-cell.ts";
export * from "./room.ts";
export * from "./graft.ts";
export * from "./session.ts";
