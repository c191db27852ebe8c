import type { Refusal } from "@twincell/core";
import { LAST_BLOCK, SERVICE, refusalSentence, textBytes } from "../codec/index.ts";
import type { Answer, Client } from "./client.ts";

/** Of a packet of a transfer, said again when no answer came [s]. */
const PATIENCE_S = [0.5, 0.8, 1];
const BLOCK_BYTES = 400;
/** Bytes of a file that is received. */
const MOST_BYTES = 4_000_000;

export type FileOutcome<T> =
  | { readonly kind: "done"; readonly value: T }
  | { readonly kind: "refused"; readonly added: number; readonly why: Refusal };

const refusal = (
  what: string,
  answer: Answer,
): { readonly kind: "refused"; readonly added: number; readonly why: Refusal } =>
  answer.kind === "silent"
    ? {
        kind: "refused",
        added: 0,
        why: {
          code: "yaskawa.silent",
          sentence: `${what}: the controller did not answer for ${answer.after_s.toFixed(1)} s.`,
          hint: "Look at the cable and the file port (UDP 10041).",
        },
      }
    : {
        kind: "refused",
        added: answer.reply.added,
        why: {
          code: "yaskawa.refused",
          sentence: `${what}: ${refusalSentence(answer.reply.status, answer.reply.added)}`,
          hint: "Remote mode, command remote, no running job and no edit lock are needed for it.",
        },
      };
const isWell = (answer: Answer): answer is Extract<Answer, { kind: "answer" }> =>
  answer.kind === "answer" && answer.reply.status === 0;

/** Files of the controller, block by block: names as they are there, text one byte per letter. */
export interface FileClient {
  list(ending: string): Promise<FileOutcome<string[]>>;
  load(name: string): Promise<FileOutcome<string>>;
  save(name: string, text: string): Promise<FileOutcome<null>>;
  remove(name: string): Promise<FileOutcome<null>>;
}

export function fileClient(client: Client): FileClient {
  async function receive(what: string, service: number, asked: string): Promise<FileOutcome<string>> {
    let answer = await client.ask({ service, data: textBytes(asked), patience_s: PATIENCE_S });
    let text = "";
    for (let expected = 1; isWell(answer); expected++) {
      const { block, data } = answer.reply;
      if ((block & ~LAST_BLOCK) >>> 0 !== expected)
        return {
          kind: "refused",
          added: 0,
          why: {
            code: "yaskawa.block",
            sentence: `${what}: block ${(block & ~LAST_BLOCK) >>> 0} came instead of block ${expected}.`,
            hint: "Try the transfer again.",
          },
        };
      text += textAt0(data);
      if (text.length > MOST_BYTES)
        return {
          kind: "refused",
          added: 0,
          why: {
            code: "yaskawa.too-long",
            sentence: `${what}: more than ${MOST_BYTES} bytes came.`,
            hint: "Transfer it by another way.",
          },
        };
      if (block >= LAST_BLOCK) {
        client.say({ service, block });
        return { kind: "done", value: text };
      }
      answer = await client.ask({ service, block, patience_s: PATIENCE_S });
    }
    return refusal(what, answer);
  }
  return {
    async list(ending) {
      const got = await receive(`The list of *${ending}`, SERVICE.listFiles, `*${ending}`);
      return got.kind === "done" ? { kind: "done", value: got.value.split("\r\n").filter(name => name !== "") } : got;
    },
    load: name => receive(`Loading ${name}`, SERVICE.loadFile, name),
    async save(name, text) {
      const what = `Saving ${name}`;
      const bytes = textBytes(text);
      let answer = await client.ask({ service: SERVICE.saveFile, data: textBytes(name), patience_s: PATIENCE_S });
      for (let number = 1; isWell(answer); number++) {
        const isLast = number * BLOCK_BYTES >= bytes.length;
        const data = bytes.subarray((number - 1) * BLOCK_BYTES, number * BLOCK_BYTES);
        answer = await client.ask({
          service: SERVICE.saveFile,
          block: isLast ? (number | LAST_BLOCK) >>> 0 : number,
          data,
          patience_s: PATIENCE_S,
        });
        if (isLast && isWell(answer)) return { kind: "done", value: null };
      }
      return refusal(what, answer);
    },
    async remove(name) {
      const answer = await client.ask({ service: SERVICE.deleteFile, data: textBytes(name), patience_s: PATIENCE_S });
      return isWell(answer) ? { kind: "done", value: null } : refusal(`Deleting ${name}`, answer);
    },
  };
}

/** Every byte of a block as a letter, zeros too. */
function textAt0(data: Uint8Array): string {
  let text = "";
  for (const byte of data) text += String.fromCharCode(byte);
  return text;
}
