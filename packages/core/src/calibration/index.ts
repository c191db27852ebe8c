export * from "./residual.ts";
export * from "./frame.ts";
export * from "./register.ts";
export * from "./tcp.ts";
export * from "./confidence.ts";
export * from "./base-registration.ts";
