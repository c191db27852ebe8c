import { spawn, spawnSync, type ChildProcess } from "node:child_process";
import { existsSync, mkdtempSync, writeFileSync } from "node:fs";
import { connect } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const kept = fileURLToPath(new URL("../../../../../.cache/brokers/", import.meta.url));
/** Where that program is, or undefined; `npm run clients` brings both. */
export function programOf(name: "mosquitto" | "nats-server"): string | undefined {
  const places = [join(kept, name), `/usr/sbin/${name}`, `/usr/local/sbin/${name}`];
  const found = places.find(each => existsSync(each));
  if (found !== undefined) return found;
  return spawnSync(name, ["-h"]).error === undefined ? name : undefined;
}
/** A mosquitto on loopback, ready when it takes connections. */
export async function mosquitto(port: number): Promise<ChildProcess> {
  const folder = mkdtempSync(join(tmpdir(), "twincell-mosquitto-"));
  const config = join(folder, "mosquitto.conf");
  writeFileSync(config, `listener ${port} 127.0.0.1\nallow_anonymous true\npersistence false\n`);
  const broker = spawn(programOf("mosquitto")!, ["-c", config], { stdio: "ignore" });
  for (;;) {
    const taken = await new Promise<boolean>(resolve => {
      const socket = connect({ host: "127.0.0.1", port });
      socket.on("connect", () => {
        socket.destroy();
        resolve(true);
      });
      socket.on("error", () => {
        resolve(false);
      });
    });
    if (taken) return broker;
    if (broker.exitCode !== null) throw new Error(`mosquitto ended with ${broker.exitCode}`);
  }
}
