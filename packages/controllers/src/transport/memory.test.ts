import { manualScheduler } from "@twincell/core";
import { expect, test } from "vitest";
import { describeNetwork } from "../testing/network.ts";
import { memoryNetwork, type Address, type ByteStream } from "./index.ts";

describeNetwork("memory network", () => {
  const scheduler = manualScheduler();
  const network = memoryNetwork(scheduler);
  return {
    network,
    close: () => {
      network.close();
    },
    async until(so) {
      for (let i = 0; i < 1000 && !so(); i++) await scheduler.elapse(0.001);
      if (!so()) throw new Error("It never came about.");
    },
  };
});

const SERVER: Address = { host: "127.0.0.2", port: 30_004 };
async function line(seed = 1) {
  const scheduler = manualScheduler();
  const network = memoryNetwork(scheduler, seed);
  const accepted: ByteStream[] = [];
  const connected: ByteStream[] = [];
  await network.listen(SERVER, stream => {
    accepted.push(stream);
  });
  void network.connect(SERVER).then(answer => {
    if (answer.kind === "connected") connected.push(answer.stream);
  });
  await scheduler.elapse(0.01);
  const got: number[] = [];
  const chunks: number[] = [];
  accepted[0]!.onBytes(lent => {
    got.push(...lent);
    chunks.push(lent.length);
  });
  return { scheduler, network, client: connected[0]!, server: accepted[0]!, got, chunks };
}

test("a delayed, jittery stream keeps its order", async () => {
  const { scheduler, network, client, got } = await line(7);
  network.weather.delay_s = 0.02;
  network.weather.jitter_s = 0.05;
  for (let i = 0; i < 200; i++) {
    client.send(Uint8Array.of(i));
    await scheduler.elapse(0.001);
  }
  expect(got.length).toBeGreaterThan(0);
  expect(got.length).toBeLessThan(200);
  await scheduler.elapse(0.1);
  expect(got).toEqual(Array.from({ length: 200 }, (_, i) => i));
});

test("jittery datagrams overtake each other, get lost and come twice, as often as asked", async () => {
  const scheduler = manualScheduler();
  const network = memoryNetwork(scheduler, 3);
  const one = await network.bind({ host: "127.0.0.1", port: 0 });
  const two = await network.bind({ host: "127.0.0.1", port: 0 });
  if (one.kind === "taken" || two.kind === "taken") throw new Error("No port.");
  const got: number[] = [];
  two.socket.onDatagram(lent => {
    got.push(lent[0]! | (lent[1]! << 8));
  });
  Object.assign(network.weather, { jitter_s: 0.02, loss: 0.1, duplicates: 0.1 });
  for (let i = 0; i < 2000; i++) {
    one.socket.send(Uint8Array.of(i & 255, i >> 8), two.socket.address);
    await scheduler.elapse(0.001);
  }
  await scheduler.elapse(1);
  const different = new Set(got).size;
  expect(different / 2000).toBeCloseTo(0.9, 1);
  expect(got.length / different).toBeCloseTo(1.1, 1);
  expect(got.some((value, i) => i > 0 && value < got[i - 1]!)).toBe(true);
});

test("pieces of one byte arrive one by one; garbage changes bytes, never their number", async () => {
  const { scheduler, network, client, got, chunks } = await line();
  network.weather.pieces = 1;
  client.send(Uint8Array.of(1, 2, 3, 4, 5));
  await scheduler.elapse(0.01);
  expect(got).toEqual([1, 2, 3, 4, 5]);
  expect(chunks).toEqual([1, 1, 1, 1, 1]);
  network.weather.pieces = 0;
  network.weather.garbage = 1;
  for (let i = 0; i < 50; i++) client.send(new Uint8Array(20));
  await scheduler.elapse(0.01);
  expect(got).toHaveLength(1005);
  expect(got.slice(5).filter(value => value !== 0).length).toBeGreaterThan(40);
});

test("frozen: a stream delivers nothing and everything afterwards, a datagram is gone; nobody is told", async () => {
  const { scheduler, network, client, server, got } = await line();
  let ended = 0;
  server.onEnd(() => {
    ended++;
  });
  network.weather.frozen = true;
  client.send(Uint8Array.of(1));
  await scheduler.elapse(10);
  expect(got).toEqual([]);
  expect(client.waiting).toBe(1);
  network.weather.frozen = false;
  await scheduler.elapse(0.01);
  expect(got).toEqual([1]);
  expect(client.waiting).toBe(0);
  expect(ended).toBe(0);
});

test("a cut line is told to both sides; a half-open one to neither, and what is sent piles up", async () => {
  const told = await line();
  const endings: string[] = [];
  told.client.onEnd(({ sentence }) => {
    endings.push(sentence);
  });
  told.server.onEnd(({ sentence }) => {
    endings.push(sentence);
  });
  told.network.cut();
  expect(endings).toEqual(["The connection broke.", "The connection broke."]);

  const silent = await line();
  let ended = 0;
  silent.client.onEnd(() => {
    ended++;
  });
  silent.server.onEnd(() => {
    ended++;
  });
  silent.network.cut(true);
  silent.client.send(new Uint8Array(100));
  await silent.scheduler.elapse(5);
  expect(ended).toBe(0);
  expect(silent.got).toEqual([]);
  expect(silent.client.waiting).toBe(100);
});

test("while connections are refused nobody gets in", async () => {
  const { scheduler, network } = await line();
  network.weather.refusing = true;
  let kind = "";
  void network.connect(SERVER).then(answer => {
    kind = answer.kind;
  });
  await scheduler.elapse(0.01);
  expect(kind).toBe("refused");
});
