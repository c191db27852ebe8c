import { createReadStream, existsSync } from "node:fs";
import { cp, mkdir, readdir, readFile, rm, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { dirname, join, normalize, resolve } from "node:path";
import type { Plugin } from "vite";
import { withoutNormalMaps } from "./vite-glb.ts";

/** Controllers and hands that are drawn as themselves; every other one falls back to the generic models. */
const PROFILES = [
  "generic-trigger",
  "generic-trigger-squeeze-thumbstick",
  "generic-hand",
  "oculus-touch-v3",
  "meta-quest-touch-plus",
  "pico-4",
];
const TYPES: Readonly<Record<string, string>> = {
  ".json": "application/json",
  ".glb": "model/gltf-binary",
  ".png": "image/png",
};

interface Layouts {
  readonly layouts: Record<string, { assetPath: string; readonly components: unknown }>;
}

/** A controller of no hand looks as that of the right one where its parts are the same: a megabyte less to load. */
async function shareModel(folder: string): Promise<void> {
  const file = join(folder, "profile.json");
  const profile: Layouts = JSON.parse(await readFile(file, "utf8"));
  const { none, right } = profile.layouts;
  if (!none || !right || JSON.stringify(none.components) !== JSON.stringify(right.components)) return;
  await rm(join(folder, none.assetPath));
  none.assetPath = right.assetPath;
  await writeFile(file, JSON.stringify(profile));
}

/** The generic models weigh more than a megabyte each, most of it for what nobody sees. */
async function lighten(folder: string): Promise<void> {
  for (const name of await readdir(folder)) {
    if (!name.endsWith(".glb")) continue;
    const file = join(folder, name);
    await writeFile(file, withoutNormalMaps(await readFile(file)));
  }
}

/** Serves the models of headset controllers from the studio's own address, in development and in the build. */
export function controllerProfiles(): Plugin {
  const source = join(
    dirname(createRequire(import.meta.url).resolve("@webxr-input-profiles/assets/package.json")),
    "dist/profiles",
  );
  const kept = async (): Promise<string> => {
    const list: Record<string, unknown> = JSON.parse(await readFile(join(source, "profilesList.json"), "utf8"));
    return JSON.stringify(Object.fromEntries(Object.entries(list).filter(([name]) => PROFILES.includes(name))));
  };
  let outDir = "dist";
  return {
    name: "twincell-controller-profiles",
    configResolved(config) {
      outDir = resolve(config.root, config.build.outDir);
    },
    configureServer(server) {
      server.middlewares.use("/profiles", (request, response, next) => {
        const path = normalize(decodeURIComponent((request.url ?? "/").split("?")[0]!));
        const file = join(source, path);
        if (path === "/profilesList.json") {
          void kept().then(text => {
            response.setHeader("content-type", TYPES[".json"]!);
            response.end(text);
          });
          return;
        }
        const type = TYPES[file.slice(file.lastIndexOf("."))];
        if (!file.startsWith(source) || type === undefined || !existsSync(file)) {
          next();
          return;
        }
        response.setHeader("content-type", type);
        createReadStream(file).pipe(response);
      });
    },
    async closeBundle() {
      const target = join(outDir, "profiles");
      await mkdir(target, { recursive: true });
      await writeFile(join(target, "profilesList.json"), await kept());
      for (const profile of PROFILES) {
        await cp(join(source, profile), join(target, profile), { recursive: true });
        await shareModel(join(target, profile));
        await lighten(join(target, profile));
      }
    },
  };
}
