export { createUrAdapter } from "./adapter.ts";
