import { existsSync } from "node:fs";
import { fileURLToPath } from "node:url";

/** The built documentation, beside the command line in an installed package; undefined where it is not built. */
export function docsFolder(): string | undefined {
  return [new URL("../docs", import.meta.url), new URL("../../../../docs/.vitepress/dist", import.meta.url)]
    .map(folder => fileURLToPath(folder))
    .find(folder => ["index.html", "index.html.br"].some(file => existsSync(`${folder}/${file}`)));
}

/** The built studio: beside the command line in an installed package, in its own folder in the source tree. */
export function studioFolder(): string {
  const packaged = fileURLToPath(new URL("../studio", import.meta.url));
  return existsSync(`${packaged}/index.html`)
    ? packaged
    : fileURLToPath(new URL("../../../studio/dist", import.meta.url));
}
