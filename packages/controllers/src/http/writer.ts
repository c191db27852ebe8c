import { latin1Bytes, type HttpRequest, type HttpResponse } from "./message.ts";

type Partly<T> = Omit<T, "body" | "fields"> & Partial<T>;

/**
 * A message with its length; a field of that name, or the end of a line inside a value, would be somebody else's
 * message and is left out.
 */
function bytesOf(
  first: string,
  { fields = [], body }: { readonly fields?: HttpRequest["fields"]; readonly body?: Uint8Array },
  hasLength: boolean,
): Uint8Array {
  const lines = fields
    .filter(([name]) => name !== "content-length")
    .map(([name, value]) => `${name}: ${oneLine(value)}\r\n`);
  const head = latin1Bytes(
    `${oneLine(first)}\r\n${lines.join("")}${hasLength ? `content-length: ${body?.length ?? 0}\r\n` : ""}\r\n`,
  );
  if (!body || body.length === 0) return head;
  const whole = new Uint8Array(head.length + body.length);
  whole.set(head);
  whole.set(body, head.length);
  return whole;
}

const oneLine = (text: string): string => text.replace(/[\x00-\x1F\x7F]/g, " ");

export const requestBytes = (message: Partly<HttpRequest>): Uint8Array =>
  bytesOf(
    `${message.method} ${message.target} HTTP/1.1`,
    message,
    (message.body?.length ?? 0) > 0 || message.method !== "GET",
  );
export const responseBytes = (message: Partly<HttpResponse>): Uint8Array =>
  bytesOf(
    `HTTP/1.1 ${message.status} ${message.reason}`,
    message,
    message.status >= 200 && message.status !== 204 && message.status !== 304,
  );
