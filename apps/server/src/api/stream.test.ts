import { EventEmitter } from "node:events";
import type { IncomingMessage } from "node:http";
import { manualScheduler } from "@twincell/core";
import type { RobotServer } from "@twincell/protocol";
import type { WebSocket } from "ws";
import { expect, test } from "vitest";
import { streamRoute } from "./stream.ts";

function bench(query: string) {
  const scheduler = manualScheduler();
  let tell: (text: string) => void = () => undefined;
  let left = 0;
  const host: Pick<RobotServer, "join"> = {
    join(_, { send }) {
      tell = send;
      return { hear: () => undefined, leave: () => left++ };
    },
  };
  const sent: string[] = [];
  const closed: string[] = [];
  const socket = Object.assign(new EventEmitter(), {
    bufferedAmount: 0,
    send: (text: string | Buffer) => sent.push(String(text)),
    close: (_: number, why: string) => closed.push(why),
    terminate: () => undefined,
  });
  const request = { url: `/api/v1/stream?${query}` } as IncomingMessage;
  streamRoute(host, scheduler).welcome(socket as unknown as WebSocket, request);
  const samples = (from: number, count: number): void => {
    for (let i = from; i < from + count; i++) {
      tell(`{"type":"sample","station":"arm","sequence":${i}}`);
      scheduler.advance(0.002);
    }
  };
  return { scheduler, sent, closed, samples, socket, left: () => left };
}

test("a reader that asks for 60 messages a second gets every sample of 500 Hz in order in at most 60 arrays a second, and nothing after it has gone", () => {
  const { sent, samples, socket, scheduler, left } = bench("messages_per_s=60");
  samples(0, 500);
  scheduler.advance(0.02);
  expect(sent.length).toBeLessThanOrEqual(61);
  const heard = sent.flatMap(text => JSON.parse(text) as { sequence: number }[]);
  expect(heard.map(({ sequence }) => sequence)).toEqual(Array.from({ length: 500 }, (_, i) => i));
  socket.emit("close");
  const before = sent.length;
  scheduler.advance(1);
  expect([sent.length, left()]).toEqual([before, 1]);
});

test.each(["messages_per_s=0", "messages_per_s=x", "messages_per_s=5000", "rate_Hz=-1"])(
  "a reader that asks for %s is told what it wants instead",
  query => {
    expect(bench(query).closed[0]).toMatch(/wants a number above 0/);
  },
);

test("50 readers of one robot at one pace are sent the same bytes, made once; whoever reads slowly or another robot gets their own", () => {
  const scheduler = manualScheduler();
  const tells: ((text: string) => void)[] = [];
  const host: Pick<RobotServer, "join"> = {
    join(_, { send }) {
      tells.push(send);
      return { hear: () => undefined, leave: () => undefined };
    },
  };
  const route = streamRoute(host, scheduler);
  const readers = Array.from({ length: 50 }, (_, i) => {
    const sent: Buffer[] = [];
    const socket = Object.assign(new EventEmitter(), {
      // The last one does not read at all.
      bufferedAmount: i === 49 ? 1 << 30 : 0,
      send: (bytes: Buffer) => sent.push(bytes),
      close: () => undefined,
      terminate: () => undefined,
    });
    const query = i === 48 ? "robot=other&messages_per_s=60" : "robot=arm&messages_per_s=60";
    route.welcome(socket as unknown as WebSocket, { url: `/api/v1/stream?${query}` } as IncomingMessage);
    return sent;
  });
  for (let sequence = 0; sequence < 500; sequence++) {
    const text = `{"type":"sample","station":"arm","sequence":${sequence}}`;
    for (const tell of tells) tell(text);
    scheduler.advance(0.002);
  }
  const [first] = readers;
  expect(first!.length).toBeGreaterThan(55);
  for (const sent of readers.slice(1, 48)) expect(sent.every((bytes, i) => bytes === first![i])).toBe(true);
  expect([readers[48]!.length, readers[49]!.length]).toEqual([0, 0]);
});
