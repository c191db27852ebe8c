export { abbEgmAdapter, type AbbEgmAdapterOptions } from "./egm-adapter.ts";
export { abbAdapter, type AbbAdapterOptions } from "./adapter.ts";
