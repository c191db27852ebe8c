declare module "occt-import-js" {
  import type { OcctResult } from "@twincell/formats";
  /** Loads the CAD kernel, a WebAssembly module of its own. */
  export default function load(options: { readonly locateFile: () => string }): Promise<{
    ReadStepFile(bytes: Uint8Array, parameters: Readonly<Record<string, unknown>>): OcctResult;
  }>;
}
