import { seededRandom } from "@twincell/core";
import { expect, test } from "vitest";
import { axisConfig, readRsi, readRsiConfig, rsiAxes, rsiConfigText, rsiKeys, rsiNumber, rsiWriter } from "./rsi.ts";
import { readXml } from "./xml.ts";

/** Written out by hand after the facts, not by our encoder. */
const ROB =
  '<Rob Type="KUKA"><RIst X="445.000000" Y="0.000000" Z="810.000000" A="0.000000" B="90.000000" C="0.000000"/><AIPos A1="0.000000" A2="-90.000000" A3="90.000000" A4="0.000000" A5="0.000000" A6="0.000000"/><ASPos A1="1.500000" A2="0.000000" A3="0.000000" A4="0.000000" A5="0.000000" A6="0.000000"/><Delay D="3"/><IPOC>123645634563</IPOC></Rob>';
const SEN =
  '<Sen Type="Twincell"><AKorr A1="0.100000" A2="0.000000" A3="0.000000" A4="0.000000" A5="0.000000" A6="-0.000125"/><IPOC>4</IPOC></Sen>';
const CONFIG = `<ROOT>
  <CONFIG><IP_NUMBER>127.0.0.1</IP_NUMBER><!-- of the sensor --><PORT>64000</PORT><SENTYPE>ImFree</SENTYPE><ONLYSEND>FALSE</ONLYSEND></CONFIG>
  <SEND><ELEMENTS>
    <ELEMENT TAG="DEF_AIPos" TYPE="DOUBLE" INDX="INTERNAL" />
    <ELEMENT TAG="DEF_Tech.C1" TYPE="DOUBLE" INDX="INTERNAL"/>
    <ELEMENT TAG='Digout.o1' TYPE="BOOL" INDX="2" /><ELEMENT TAG="Digout.o2" TYPE="BOOL" INDX="3" />
    <ELEMENT TAG="Source1" TYPE="LONG" INDX="5" />
  </ELEMENTS></SEND>
  <RECEIVE><ELEMENTS><ELEMENT TAG="DEF_EStr" TYPE="STRING" INDX="INTERNAL" /><ELEMENT TAG="RKorr.X" TYPE="DOUBLE" INDX="1" HOLDON="1" /><ELEMENT TAG="FREE" TYPE="LONG" INDX="7" HOLDON="0"/></ELEMENTS></RECEIVE>
</ROOT>`;

test("telegrams of the robot and of the sensor, character by character, there and back", () => {
  const config = axisConfig("127.0.0.1", 49_152);
  const rob = new Map(
    Object.entries({
      "RIst.X": 445,
      "RIst.Z": 810,
      "RIst.B": 90,
      "AIPos.A2": -90,
      "AIPos.A3": 90,
      "ASPos.A1": 1.5,
      "Delay.D": 3,
    }),
  );
  expect(rsiWriter("Rob", "KUKA", config.send)(rob, 123_645_634_563)).toBe(ROB);
  expect(
    rsiWriter(
      "Sen",
      config.senType,
      config.receive,
    )(
      new Map([
        ["AKorr.A1", 0.1],
        ["AKorr.A6", -0.000125],
      ]),
      4,
    ),
  ).toBe(SEN);
  const read = readRsi(ROB, "Rob");
  const out = new Float64Array(6);
  expect(read).toMatchObject({ kind: "telegram", type: "KUKA", ipoc: 123_645_634_563 });
  if (read.kind !== "telegram") return;
  expect([rsiAxes(read.values, "AIPos", out), [...out]]).toEqual([true, [0, -90, 90, 0, 0, 0]]);
  expect([rsiNumber(read.values, "Delay.D"), rsiNumber(read.values, "Nobody")]).toEqual([3, NaN]);
  expect(rsiAxes(read.values, "AKorr", out)).toBe(false);
});

test("the file of the robot: keywords, own tags, channels, HOLDON; written and read again it is the same", () => {
  const read = readRsiConfig(CONFIG);
  if (read.kind !== "read") throw new Error(read.sentence);
  expect(read.config).toMatchObject({ ip: "127.0.0.1", port: 64_000, senType: "ImFree", onlySend: false });
  expect(rsiKeys(read.config.send).map(({ key }) => key)).toEqual([
    ...["A1", "A2", "A3", "A4", "A5", "A6"].map(axis => `AIPos.${axis}`),
    ...["C11", "C12", "C13", "C14", "C15", "C16", "C17", "C18", "C19", "C110"].map(part => `Tech.${part}`),
    "Digout.o1",
    "Digout.o2",
    "Source1",
  ]);
  expect(rsiKeys(read.config.receive)).toEqual([
    { key: "EStr", type: "STRING", holdOn: 0 },
    { key: "RKorr.X", type: "DOUBLE", holdOn: 1 },
    { key: "FREE", type: "LONG", holdOn: 0 },
  ]);
  expect(
    rsiWriter(
      "Rob",
      "KUKA",
      read.config.send.slice(2),
    )(
      new Map<string, boolean | number>([
        ["Digout.o1", true],
        ["Source1", 7],
      ]),
      1,
    ),
  ).toBe('<Rob Type="KUKA"><Digout o1="1" o2="0"/><Source1>7</Source1><IPOC>1</IPOC></Rob>');
  expect(readRsiConfig(rsiConfigText(read.config))).toEqual(read);
});

test("what is wrong in the file is named", () => {
  const sentence = (text: string): string => {
    const read = readRsiConfig(text);
    return read.kind === "read" ? "" : read.sentence;
  };
  expect(sentence(CONFIG.replace("64000", "0"))).toBe("PORT is 1 to 65535, not “0”.");
  expect(sentence(CONFIG.replace('INDX="5"', 'INDX="65"'))).toBe(
    "SEND: INDX of Source1 is INTERNAL or 1 to 64, not “65”.",
  );
  expect(sentence(CONFIG.replace('"LONG" INDX="5"', '"REAL" INDX="5"'))).toBe("SEND: Source1 has the type “REAL”.");
  expect(sentence(CONFIG.replace("ImFree", ""))).toBe("CONFIG has no SENTYPE.");
  expect(sentence("<ROOT></ROOT>")).toContain("CONFIG");
});

test("what is no telegram is refused: another root, no IPOC, elements too deep, documents, cut texts", () => {
  for (const text of [
    "",
    "<Rob/>",
    '<Sen Type="a"><IPOC>1</IPOC></Sen>',
    ROB.replace(/<IPOC>.*<\/IPOC>/, ""),
    ROB.replace("123645634563", "-1"),
    "<Rob><a><b/></a><IPOC>1</IPOC></Rob>",
    "<!DOCTYPE x><Rob/>",
    '<Rob a="1" a="2"><IPOC>1</IPOC></Rob>',
    "<Rob>&bomb;<IPOC>1</IPOC></Rob>",
  ]) {
    expect(readRsi(text, "Rob").kind, text).toBe("not-understood");
  }
  for (let cut = 0; cut < ROB.length; cut++) expect(readRsi(ROB.slice(0, cut), "Rob").kind).toBe("not-understood");
  expect(readXml(`${"<a>".repeat(100)}`).kind).toBe("not-understood");
  expect(readXml("<a>".repeat(100_000)).kind).toBe("not-understood");
});

test("any text, and telegrams with a few signs changed: an answer, never an exception (6,000 inputs)", () => {
  const random = seededRandom(5);
  const signs = "<>/=\"'& abIPOC019.-!?\t\né";
  for (let i = 0; i < 6_000; i++) {
    let text =
      i % 2 === 0
        ? SEN
        : Array.from({ length: Math.floor(random() * 50) }, () => signs[Math.floor(random() * signs.length)]).join("");
    for (let k = 0; k < 3; k++) {
      const at = Math.floor(random() * text.length);
      text = text.slice(0, at) + signs[Math.floor(random() * signs.length)]! + text.slice(at + 1);
    }
    expect(["telegram", "not-understood"]).toContain(readRsi(text, "Sen").kind);
    expect(["read", "not-understood"]).toContain(readRsiConfig(text).kind);
  }
});
