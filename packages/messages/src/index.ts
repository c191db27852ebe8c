export * from "./ask.ts";
export * from "./tell.ts";
export * from "./read.ts";
export * from "./host.ts";
export * from "./client.ts";
export * from "./video/wire.ts";
export * from "./video/clock.ts";
export * from "./video/relay.ts";
