import { expect, test } from "vitest";
import { latin1Text } from "../../http/index.ts";
import {
  commTimeout_s,
  EGM_TEXT,
  errorJson,
  isAbbModel,
  isStreamed,
  readJoints,
  readRws,
  statesHtml,
  statesJson,
} from "./index.ts";

test("states and errors are read as the reference has them, and written so", () => {
  const text =
    '{"_links":{"base":{"href":"http://127.0.0.1/rw/panel/"}},"_embedded":{"_state":[{"_type":"pnl-ctrlstate","_title":"ctrlstate","ctrlstate":"motoron"}]}}';
  expect(readRws(text)).toEqual({
    kind: "states",
    states: [{ type: "pnl-ctrlstate", title: "ctrlstate", fields: { ctrlstate: "motoron" } }],
  });
  expect(
    latin1Text(
      statesJson(
        [{ type: "pnl-ctrlstate", title: "ctrlstate", fields: { ctrlstate: "motoron" } }],
        "http://127.0.0.1/rw/panel/",
      ),
    ),
  ).toBe(text);
  expect(readRws('{"_embedded":{"status":{"code":-1073445859,"msg":"no"}}}')).toEqual({
    kind: "error",
    code: -1073445859,
    msg: "no",
  });
  expect(readRws(latin1Text(errorJson(-1073445859, '90° – "no"')))).toEqual({
    kind: "error",
    code: -1073445859,
    msg: '90° – "no"',
  });
  for (const wrong of ["", "{", "[]", "null", '{"_embedded":[]}', '{"_embedded":{"_state":[1]}}', "[".repeat(100_000)])
    expect(readRws(wrong)).toBeNull();
  expect(latin1Text(statesHtml([{ type: "a", title: "<b>", fields: { c: '"&' } }], "/x"))).toContain(
    '<li class="a" title="&lt;b&gt;"><a href="/x" rel="self"/><span class="c">&quot;&amp;</span></li>',
  );
});

test("axes that are not there are left out, the seventh of an arm is the first external one", () => {
  const six = Object.fromEntries([..."123456"].map(i => [`rax_${i}`, `${Number(i) * 10}.5`]));
  const none = Object.fromEntries([..."abcdef"].map(i => [`eax_${i}`, "8.9999998E+09"]));
  const out = new Float64Array(7);
  expect([readJoints({ ...six, ...none }, out), [...out]]).toEqual([6, [10.5, 20.5, 30.5, 40.5, 50.5, 60.5, 0]]);
  expect([readJoints({ ...six, ...none, eax_a: "7" }, out), out[6]]).toEqual([7, 7]);
  for (const wrong of [{}, { ...six }, { ...six, ...none, rax_3: "x" }, { ...six, ...none, rax_3: " " }])
    expect(readJoints(wrong as Record<string, string>, out)).toBe(0);
});

test.each([
  ["ABB IRB 120-3/0.6", "IRB 120-3/0.6", true],
  ["ABB IRB 120-3/0.6", "IRB 120", true],
  ["ABB IRB 120", "IRB 120-3/0.6", true],
  ["ABB IRB 120-3/0.6", "IRB 1200-5/0.9", false],
  ["ABB IRB 120", "IRB 1200-5/0.9", false],
  ["ABB CRB 15000-5/0.95", "CRB 15000-10/1.52", false],
  ["ABB IRB 120", "", false],
])("%s and %s: %s", (name, said, is) => {
  expect(isAbbModel(name, said)).toBe(is);
});

test("the program that waits for targets is told by its instruction, and says how long it waits", () => {
  expect([
    isStreamed(EGM_TEXT),
    commTimeout_s(EGM_TEXT),
    isStreamed("MODULE a\n! EGMRunJoint\nENDMODULE"),
    commTimeout_s("\\CommTimeout:=0.25"),
    commTimeout_s(""),
  ]).toEqual([true, 1, false, 0.25, undefined]);
});
