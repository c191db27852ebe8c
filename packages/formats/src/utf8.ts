/** The text of UTF-8 bytes; a byte order mark is dropped, bytes that are no UTF-8 are taken as Latin-1 letters. */
export function utf8(bytes: Uint8Array): string {
  const parts: string[] = [];
  const units: number[] = [];
  let at = bytes[0] === 0xef && bytes[1] === 0xbb && bytes[2] === 0xbf ? 3 : 0;
  while (at < bytes.length) {
    const first = bytes[at]!;
    const length = first < 0x80 ? 1 : first >= 0xf0 && first < 0xf5 ? 4 : first >= 0xe0 ? 3 : first >= 0xc2 ? 2 : 0;
    let code = length === 1 ? first : first & (0x7f >> length);
    let whole = length > 0 && at + length <= bytes.length;
    for (let i = 1; i < length && whole; i++) {
      whole = (bytes[at + i]! & 0xc0) === 0x80;
      code = (code << 6) | (bytes[at + i]! & 0x3f);
    }
    if (whole && code > 0xffff) units.push(0xd800 + ((code - 0x10000) >> 10), 0xdc00 + ((code - 0x10000) & 0x3ff));
    else units.push(whole ? code : first);
    at += whole ? length : 1;
    if (units.length > 8000) parts.push(String.fromCharCode(...units.splice(0)));
  }
  return parts.join("") + String.fromCharCode(...units);
}
