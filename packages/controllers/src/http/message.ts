/** Fields in the order in which they came; names in small letters. A name may come more than once. */
export type Fields = readonly (readonly [name: string, value: string])[];

export interface HttpRequest {
  readonly method: string /** As it stands in the first line: path and query, still encoded. */;
  readonly target: string;
  readonly fields: Fields;
  readonly body: Uint8Array;
}
export interface HttpResponse {
  readonly status: number;
  readonly reason: string;
  readonly fields: Fields;
  readonly body: Uint8Array;
}

/** The first value of that name, or "". */
export const fieldOf = ({ fields }: { readonly fields: Fields }, name: string): string =>
  fields.find(([is]) => is === name)?.[1] ?? "";
/** Whether a list such as that of `Connection` has the word. */
export const hasWord = (list: string, word: string): boolean =>
  list
    .toLowerCase()
    .split(",")
    .some(each => each.trim() === word);

/** One byte a letter: heads of messages, and bodies of the services here, which escape all else. */
export function latin1Bytes(text: string): Uint8Array {
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}
export function latin1Text(bytes: Uint8Array): string {
  let text = "";
  for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
  return text;
}
