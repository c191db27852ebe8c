export * from "./axes.ts";
export * from "./bytes.ts";
export * from "./commands.ts";
export * from "./form.ts";
export * from "./moves.ts";
export * from "./packet.ts";
export * from "./state.ts";
export * from "./variables.ts";
