import { meshBounds } from "@twincell/core";
import { readObj, readPly, readStl } from "@twincell/formats";
import { encodeMesh } from "@twincell/project";
import type { FromReader, ToReader } from "./mesh-messages.ts";

const READERS = { stl: readStl, obj: readObj, ply: readPly } as const;

addEventListener("message", ({ data: { kind, bytes } }: MessageEvent<ToReader>) => {
  let answer: FromReader;
  try {
    const read = READERS[kind](bytes);
    if (read.kind === "read") {
      const { likelyScale } = read.report;
      const mesh = { positions: read.mesh.positions.map(length => length * likelyScale), indices: read.mesh.indices };
      answer = { kind: "read", encoded: encodeMesh(mesh), report: read.report, lowest: meshBounds(mesh).lower };
    } else answer = { kind: "not-understood", sentence: read.sentence };
  } catch (trouble) {
    answer = { kind: "not-understood", sentence: trouble instanceof Error ? trouble.message : String(trouble) };
  }
  postMessage(answer);
});
