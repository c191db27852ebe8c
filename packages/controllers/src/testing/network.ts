import { describe, expect, test } from "vitest";
import type { Address, ByteStream, Ending, Network } from "../transport/index.ts";

export interface NetworkBench {
  readonly network: Network;
  /** Lets time pass until that is so; throws when it never is. */
  until(so: () => boolean): Promise<void>;
  close(): void;
}

const ANY: Address = { host: "127.0.0.1", port: 0 };
const bytes = (...values: number[]): Uint8Array => Uint8Array.from(values);

/** What drivers and virtual controllers rest on, whatever carries the bytes. */
export function describeNetwork(name: string, make: () => NetworkBench): void {
  describe(name, () => {
    const row = (title: string, body: (bench: NetworkBench) => Promise<void>): void => {
      test(title, async () => {
        const bench = make();
        try {
          await body(bench);
        } finally {
          bench.close();
        }
      });
    };
    const connected = async ({ network, until }: NetworkBench): Promise<readonly [ByteStream, ByteStream]> => {
      let server: ByteStream | null = null;
      const listening = await network.listen(ANY, stream => {
        server = stream;
      });
      if (listening.kind === "taken") throw new Error(listening.sentence);
      let client: ByteStream | null = null;
      void network.connect(listening.address).then(answer => {
        if (answer.kind === "connected") client = answer.stream;
      });
      await until(() => server !== null && client !== null);
      return [client!, server!];
    };
    const collected = (stream: ByteStream): number[] => {
      const all: number[] = [];
      stream.onBytes(lent => {
        all.push(...lent);
      });
      return all;
    };

    row("bytes arrive in order, both ways, and a sender may use its own again at once", async bench => {
      const [client, server] = await connected(bench);
      const there = collected(server);
      const back = collected(client);
      const buffer = new Uint8Array(3);
      for (let i = 0; i < 100; i++) {
        buffer.fill(i);
        client.send(buffer);
      }
      server.send(bytes(9, 8, 7));
      await bench.until(() => there.length === 300 && back.length === 3);
      expect(there).toEqual(Array.from({ length: 300 }, (_, i) => Math.floor(i / 3)));
      expect(back).toEqual([9, 8, 7]);
    });

    row("what comes before anybody listens is kept", async bench => {
      const [client, server] = await connected(bench);
      client.send(bytes(1, 2));
      const marker = collected(client);
      server.send(bytes(5));
      await bench.until(() => marker.length === 1);
      const there = collected(server);
      await bench.until(() => there.length === 2);
      expect(there).toEqual([1, 2]);
    });

    row("an end is told to the other side once, after the last byte, and never to who closed", async bench => {
      const [client, server] = await connected(bench);
      const there = collected(server);
      const ends: Ending[] = [];
      server.onEnd(ending => {
        ends.push(ending);
      });
      client.onEnd(ending => {
        ends.push({ ...ending, sentence: "told to who closed" });
      });
      client.send(bytes(1, 2, 3));
      client.close();
      client.close();
      client.send(bytes(4));
      await bench.until(() => ends.length > 0);
      expect(there).toEqual([1, 2, 3]);
      expect(ends).toHaveLength(1);
      expect(ends[0]).toMatchObject({ byPeer: true });
      expect(ends[0]!.sentence).toMatch(/^The .*\.$/);
      server.send(bytes(1));
      server.close();
    });

    row("nobody listens: refused with the address in the sentence; listened on already: taken", async bench => {
      const { network, until } = bench;
      const listening = await network.listen(ANY, () => {
        /* Nobody comes. */
      });
      if (listening.kind === "taken") throw new Error(listening.sentence);
      expect(
        await network.listen(listening.address, () => {
          /* Nobody comes. */
        }),
      ).toMatchObject({ kind: "taken" });
      listening.close();
      let answer: Awaited<ReturnType<Network["connect"]>> | null = null;
      void network.connect(listening.address).then(is => {
        answer = is;
      });
      await until(() => answer !== null);
      expect(answer).toMatchObject({ kind: "refused" });
      expect((answer as unknown as { sentence: string }).sentence).toContain(String(listening.address.port));
    });

    row("datagrams arrive whole, with who sent them; to nobody they are lost without a word", async bench => {
      const one = await bench.network.bind(ANY);
      const two = await bench.network.bind(ANY);
      if (one.kind === "taken" || two.kind === "taken") throw new Error("No port.");
      const got: { readonly data: number[]; readonly from: Address }[] = [];
      two.socket.onDatagram((lent, from) => {
        got.push({ data: [...lent], from });
      });
      one.socket.send(bytes(1, 2, 3), two.socket.address);
      one.socket.send(bytes(4), { host: "127.0.0.1", port: 9 });
      one.socket.send(bytes(5, 6), two.socket.address);
      await bench.until(() => got.length === 2);
      expect(got).toEqual([
        { data: [1, 2, 3], from: one.socket.address },
        { data: [5, 6], from: one.socket.address },
      ]);
      expect(await bench.network.bind(two.socket.address)).toMatchObject({ kind: "taken" });
      one.socket.close();
      one.socket.close();
      two.socket.close();
      one.socket.send(bytes(1), two.socket.address);
    });
  });
}
