import { seededRandom } from "@twincell/core";
import { describe, expect, test } from "vitest";
import {
  authorization,
  challengeText,
  digestOf,
  fieldOf,
  formText,
  isAuthorized,
  latin1Bytes,
  latin1Text,
  md5Hex,
  pathText,
  readChallenge,
  readDigest,
  readForm,
  readTarget,
  requestBytes,
  RequestReader,
  responseBytes,
  ResponseReader,
  type HttpRequest,
  type HttpResponse,
} from "./index.ts";

const LOGIN = { user: "Default User", password: "robotics" };
/** Everything in pieces of that size; what came, and why it ended. */
function read<T extends HttpRequest | HttpResponse>(
  reader: { push(bytes: Uint8Array, take: (message: T) => boolean): string | null },
  text: string,
  step = text.length,
): { readonly got: T[]; readonly why: string | null } {
  const got: T[] = [];
  const bytes = latin1Bytes(text);
  let why: string | null = null;
  for (let at = 0; at < bytes.length && !why; at += step)
    why = reader.push(bytes.subarray(at, at + step), message => {
      got.push(message);
      return true;
    });
  return { got, why };
}
const request = (text: string, step?: number) => read<HttpRequest>(new RequestReader(), text, step);
const response = (text: string, step?: number) => read<HttpResponse>(new ResponseReader(), text, step);

describe("HTTP/1.1 messages", () => {
  // As an IRC5's client sends them, byte by byte.
  const POST =
    "POST /rw/rapid/execution?action=stop&json=1 HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/x-www-form-urlencoded\r\nContent-Length: 13\r\n\r\nstopmode=stop";
  const CHUNKED =
    'HTTP/1.1 200 OK\r\nContent-Type: application/json\r\nTransfer-Encoding: chunked\r\n\r\n4\r\n{"a"\r\n3;x=1\r\n:1}\r\n0\r\nX-More: 1\r\n\r\n';

  test.each([1, 2, 7, 1000])("are read in pieces of %i bytes, one after the other", step => {
    const { got, why } = request(`${POST}GET / HTTP/1.0\r\n\r\n${POST}`, step);
    expect(why).toBeNull();
    expect(got.map(({ method, target, body }) => [method, target, latin1Text(body)])).toEqual([
      ["POST", "/rw/rapid/execution?action=stop&json=1", "stopmode=stop"],
      ["GET", "/", ""],
      ["POST", "/rw/rapid/execution?action=stop&json=1", "stopmode=stop"],
    ]);
    expect(fieldOf(got[0]!, "content-type")).toBe("application/x-www-form-urlencoded");
    const answers = response(
      `HTTP/1.1 204 No Content\r\n\r\n${CHUNKED}HTTP/1.1 200\r\ncontent-length: 0\r\n\r\n`,
      step,
    );
    expect(answers.got.map(({ status, body }) => [status, latin1Text(body)])).toEqual([
      [204, ""],
      [200, '{"a":1}'],
      [200, ""],
    ]);
  });

  test("are written as they are read", () => {
    expect(latin1Text(requestBytes({ method: "GET", target: "/rw", fields: [["host", "a"]] }))).toBe(
      "GET /rw HTTP/1.1\r\nhost: a\r\n\r\n",
    );
    expect(latin1Text(requestBytes({ method: "POST", target: "/x", body: latin1Bytes("a=1") }))).toBe(
      "POST /x HTTP/1.1\r\ncontent-length: 3\r\n\r\na=1",
    );
    expect(latin1Text(responseBytes({ status: 204, reason: "No Content" }))).toBe("HTTP/1.1 204 No Content\r\n\r\n");
    // A value with the end of a line in it does not make a second field.
    expect(latin1Text(responseBytes({ status: 200, reason: "OK", fields: [["a", "b\r\nc: d"]] }))).toBe(
      "HTTP/1.1 200 OK\r\na: b  c: d\r\ncontent-length: 0\r\n\r\n",
    );
  });

  test.each([
    ["GET /\r\n\r\n", "The first line is none of HTTP/1.1."],
    ["GET / HTTP/2.0\r\n\r\n", "The first line is none of HTTP/1.1."],
    ["GET / HTTP/1.1\r\nHost : a\r\n\r\n", "A field is none of HTTP/1.1."],
    ["GET / HTTP/1.1\r\nA: 1\r\n folded\r\n\r\n", "A field is none of HTTP/1.1."],
    ["POST / HTTP/1.1\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\n", "The length of a message is no number."],
    ["POST / HTTP/1.1\r\nContent-Length: -1\r\n\r\n", "The length of a message is no number."],
    ["POST / HTTP/1.1\r\nContent-Length: 5000000\r\n\r\n", "A body of more than 4000000 bytes was announced."],
    [
      "POST / HTTP/1.1\r\nContent-Length: 3\r\nTransfer-Encoding: chunked\r\n\r\n",
      "A message has a length and chunks as well.",
    ],
    [
      "POST / HTTP/1.1\r\nTransfer-Encoding: gzip, chunked\r\n\r\n",
      'The transfer coding "gzip, chunked" is not read here.',
    ],
    ["POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nxyz\r\n", "The size of a chunk is no number."],
    ["POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n1\r\nab\r\n", "A chunk does not end where it should."],
    ["POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nFFFFFFF\r\n", "A body of more than 4000000 bytes came."],
    [`GET / HTTP/1.1\r\n${"A: 1\r\n".repeat(65)}\r\n`, "More than 64 fields came."],
    [`GET /${"a".repeat(20_000)}`, "A head of more than 16384 bytes came."],
  ])("what is none is one sentence: %#", (text, sentence) => {
    expect(request(text)).toEqual({ got: [], why: sentence });
  });
  test("an answer that ends with the connection is not read", () => {
    expect(response("HTTP/1.1 200 OK\r\n\r\n").why).toBe("A message has neither length nor chunks.");
  });

  test("any bytes, in any pieces: messages or one sentence, and never more held than the limits", () => {
    const random = seededRandom(7);
    const parts = [
      POST,
      CHUNKED,
      "GET / HTTP/1.1\r\n",
      "\r\n",
      "\r\n\r\n",
      "Content-Length: 9999\r\n",
      "Transfer-Encoding: chunked\r\n\r\n",
      "1\r\na\r\n",
      "0\r\n\r\n",
    ];
    for (let round = 0; round < 3000; round++) {
      let text = "";
      for (let i = 0; i < 6; i++)
        text +=
          random() < 0.8
            ? parts[Math.floor(random() * parts.length)]!
            : String.fromCharCode(...Array.from({ length: 20 }, () => Math.floor(random() * 256)));
      const at = Math.floor(random() * text.length);
      if (random() < 0.5)
        text = text.slice(0, at) + String.fromCharCode(Math.floor(random() * 256)) + text.slice(at + 1);
      const step = 1 + Math.floor(random() * 50);
      for (const of of [request, response]) {
        const { why } = of(text, step);
        if (why !== null) expect(why).toMatch(/^[A-Z].*\.$/);
      }
    }
  });
});

describe("digests", () => {
  test("are those of RFC 1321 and RFC 2617", () => {
    expect(md5Hex("")).toBe("d41d8cd98f00b204e9800998ecf8427e");
    expect(md5Hex("message digest")).toBe("f96b697d7cb7938d525a2f31aaf161d0");
    expect(
      digestOf(
        { user: "Mufasa", password: "Circle Of Life" },
        "testrealm@host.com",
        "dcd98b7102dd2f0e8b11d0f600bfb0c093",
        "GET",
        "/dir/index.html",
        "00000001",
        "0a4f113b",
      ),
    ).toBe("6629fae49393a05397450978507c4ef1");
    expect(
      digestOf(
        { user: "Mufasa", password: "CircleOfLife" },
        "testrealm@host.com",
        "dcd98b7102dd2f0e8b11d0f600bfb0c093",
        "GET",
        "/dir/index.html",
        "",
        "",
      ),
    ).toBe("1949323746fe6a43ef61f9606e7febea");
  });

  test("a challenge is answered, and the answer is that of this login, method and target only", () => {
    const challenge = { realm: "validusers@robapi.abb", nonce: "abc1", opaque: "8798", counted: true };
    expect(readChallenge(challengeText(challenge))).toEqual(challenge);
    for (const counted of [true, false]) {
      const answer = authorization(LOGIN, { ...challenge, counted }, "GET", "/rw?json=1", 3, "own");
      expect(isAuthorized(answer, LOGIN, challenge, "GET", "/rw?json=1")).toBe(true);
      expect(isAuthorized(answer, LOGIN, challenge, "POST", "/rw?json=1")).toBe(false);
      expect(isAuthorized(answer, LOGIN, challenge, "GET", "/rw")).toBe(false);
      expect(isAuthorized(answer, { ...LOGIN, password: "robotic" }, challenge, "GET", "/rw?json=1")).toBe(false);
    }
    for (const wrong of [
      "",
      "Basic abc",
      "Digest",
      "Digest a",
      'Digest a="b',
      "Digest =,=",
      `Digest ${"a=b,".repeat(2000)}`,
    ])
      expect(readDigest(wrong)).toBeNull();
    expect(readChallenge('Digest realm="a", nonce="b", algorithm=SHA-256')).toBeNull();
  });
});

test("forms and targets there and back; broken escapes are none", () => {
  expect(formText({ "ctrl-state": "motoron", value: '[[1,2],"a b"]' })).toBe(
    "ctrl-state=motoron&value=%5B%5B1%2C2%5D%2C%22a%20b%22%5D",
  );
  expect([...readForm("a=1&b=x+y%20z&c&1-p=2")!]).toEqual([
    ["a", "1"],
    ["b", "x y z"],
    ["c", ""],
    ["1-p", "2"],
  ]);
  expect(readTarget("/fileservice/$home/my%20file.mod?json=1")).toEqual({
    path: ["fileservice", "$home", "my file.mod"],
    query: new Map([["json", "1"]]),
  });
  expect(pathText(["fileservice", "$home", "a b/c"])).toBe("/fileservice/$home/a%20b%2Fc");
  for (const broken of ["/%", "/%2", "/%zz", "/a?b=%"]) expect(readTarget(broken)).toBeNull();
  expect(readForm("a=1&".repeat(2000))).toBeNull();
});
