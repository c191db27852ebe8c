// Finds a Chromium for the browser tests; on Debian as root it installs the distribution's own package.
import { spawnSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";

const places = [
  "/usr/bin/chromium",
  "/usr/bin/chromium-browser",
  "/usr/bin/google-chrome-stable",
  "/usr/bin/google-chrome",
  "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
  "/Applications/Chromium.app/Contents/MacOS/Chromium",
  "C:/Program Files/Google/Chrome/Application/chrome.exe",
];

/** Path of a Chromium, or null with the reason printed. */
export function chromium() {
  const given = process.env.TWINCELL_CHROMIUM;
  if (given && existsSync(given)) return given;
  const found = places.find(path => existsSync(path));
  if (found) return found;
  const debian = existsSync("/etc/debian_version") && /debian/i.test(readFileSync("/etc/os-release", "utf8"));
  if (debian && process.getuid?.() === 0) {
    console.log("Installing Debian's Chromium for the browser tests (once) …");
    spawnSync("apt-get", ["update", "-qq"], { stdio: "inherit" });
    spawnSync("apt-get", ["install", "-y", "-qq", "--no-install-recommends", "chromium"], {
      stdio: "inherit",
      env: { ...process.env, DEBIAN_FRONTEND: "noninteractive" },
    });
    if (existsSync(places[0])) return places[0];
  }
  console.error(
    "The browser tests need Chromium or Chrome. On Debian: `apt-get install chromium` as root; elsewhere install it and set TWINCELL_CHROMIUM to its path.",
  );
  return null;
}
