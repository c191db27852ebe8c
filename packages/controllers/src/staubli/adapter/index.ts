export { createStaubliAdapter, type StaubliAdapterOptions } from "./adapter.ts";
