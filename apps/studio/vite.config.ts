import { fileURLToPath } from "node:url";
import react from "@vitejs/plugin-react";
import { defineConfig } from "vite";
import { offlineStudio } from "./vite-offline.ts";
import { controllerProfiles } from "./vite-profiles.ts";

const empty = fileURLToPath(new URL("src/scene/xr/no-emulator.ts", import.meta.url));

/** The studio, and the small page by which a phone shows its camera. */
const page = (path: string): string => fileURLToPath(new URL(path, import.meta.url));

export default defineConfig({
  root: fileURLToPath(new URL(".", import.meta.url)),
  base: "./",
  plugins: [react(), controllerProfiles(), offlineStudio()],
  worker: { format: "es" },
  build: {
    target: "es2022",
    outDir: "dist",
    chunkSizeWarningLimit: 2000,
    rolldownOptions: { input: [page("index.html"), page("camera/index.html"), page("pendant/index.html")] },
  },
  resolve: {
    // The headset emulator's rooms weigh 4.6 MB and are never used: tests bring their own emulator.
    alias: { "@iwer/devui": empty, "@iwer/sem": empty },
    dedupe: ["three", "react", "react-dom"],
  },
  server: { host: "127.0.0.1" },
});
