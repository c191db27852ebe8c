import { spawn, type ChildProcess } from "node:child_process";
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { connect } from "@nats-io/transport-node";
import { jetstreamManager } from "@nats-io/jetstream";
import { freePort } from "../../testing/free-port.ts";
import { programOf } from "./broker.ts";

export interface NatsCluster {
  readonly servers: readonly string[];
  /** Ends node `i` as a power cut would. */
  kill(i: number): void;
  start(i: number): void;
  /** Which node leads that stream. */
  leader(stream: string): Promise<number>;
  close(): void;
}

/** Real nats-servers with JetStream on loopback; ready when the cluster answers, not when a port is open. */
export async function natsCluster(nodes: number): Promise<NatsCluster> {
  const folder = mkdtempSync(join(tmpdir(), "twincell-nats-"));
  const ports: number[] = [];
  for (let i = 0; i < 2 * nodes; i++) ports.push(await freePort("127.0.0.1"));
  const servers = ports.slice(0, nodes).map(port => `127.0.0.1:${port}`);
  const routes = ports.slice(nodes).map(port => `"nats://127.0.0.1:${port}"`);
  const children: ChildProcess[] = [];
  const start = (i: number): void => {
    const config = join(folder, `n${i}.conf`);
    const cluster = `cluster { name: plant, listen: "127.0.0.1:${ports[nodes + i]}", routes: [${routes.join(", ")}], no_advertise: true }`;
    writeFileSync(
      config,
      `server_name: n${i}
listen: "${servers[i]}"
jetstream { store_dir: "${folder}/n${i}", max_mem: 64MB, max_file: 1GB }
${nodes > 1 ? cluster : ""}
`,
    );
    children[i] = spawn(programOf("nats-server")!, ["-c", config], { stdio: "ignore" });
  };
  for (let i = 0; i < nodes; i++) start(i);
  const asked = async <T>(ask: (manager: Awaited<ReturnType<typeof jetstreamManager>>) => Promise<T>): Promise<T> => {
    for (;;) {
      let connection;
      try {
        connection = await connect({ servers: [...servers], timeout: 1000 });
        return await ask(await jetstreamManager(connection, { timeout: 2000 }));
      } catch {
        await new Promise(resolve => setTimeout(resolve, 50));
      } finally {
        await connection?.close();
      }
    }
  };
  await asked(manager => manager.getAccountInfo());
  return {
    servers,
    start,
    kill(i) {
      children[i]!.kill("SIGKILL");
    },
    leader: stream =>
      asked(async manager => Number((await manager.streams.info(stream)).cluster?.leader?.slice(1) ?? "0")),
    close() {
      for (const child of children) child.kill("SIGKILL");
    },
  };
}
