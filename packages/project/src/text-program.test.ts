import fc from "fast-check";
import { expect, test } from "vitest";
import { emptyCell } from "./example/index.ts";
import { openDocument } from "./open.ts";
import { addProgram, removeProgram, selectedProgram, selectedText, withSelectedText } from "./programs.ts";
import { saveDocument } from "./save.ts";
import { bytesOfTextFile, mainFileOf, textFileOf, withFileText, type TextProgram } from "./text-program.ts";

const program = (files: TextProgram["files"]): TextProgram => ({
  format: "twincell.text-program",
  version: 1,
  name: "weld",
  robot: "kuka_kr6_2",
  language: "krl",
  main: files[0]!.name,
  files,
});

test("files of any bytes come back byte for byte from a saved and opened cell, and saving again gives the same text", () => {
  fc.assert(
    fc.property(fc.uint8Array({ maxLength: 200 }), fc.string({ unit: "binary" }), (bytes, characters) => {
      const utf8 = new TextEncoder().encode(characters);
      const cell = addProgram(emptyCell(), program([textFileOf("a.src", bytes), textFileOf("a.dat", utf8)]));
      const saved = saveDocument(cell);
      const opened = openDocument(saved);
      if (opened.kind !== "opened") throw new Error(JSON.stringify(opened));
      const files = selectedText(opened.document)!.files;
      expect(bytesOfTextFile(files[0]!)).toEqual(bytes);
      expect(bytesOfTextFile(files[1]!)).toEqual(utf8);
      expect(saveDocument(opened.document)).toBe(saved);
    }),
    { seed: 3, numRuns: 500 },
  );
});

test.each([
  ["UTF-8 with a byte order mark and CR LF", [0xef, 0xbb, 0xbf, 0xc3, 0xbc, 0x0d, 0x0a], "utf-8", "\ufeffü\r\n"],
  ["Latin-1", [0x3b, 0xfc, 0xb0, 0x0d, 0x0a], "latin-1", ";ü°\r\n"],
  ["Shift-JIS", [0x3b, 0x8e, 0xe8, 0x93, 0xae, 0x0a], "shift-jis", ";\x8eè\x93®\n"],
] as const)("%s is told from its bytes", (_what, bytes, encoding, text) => {
  const file = textFileOf("a.src", Uint8Array.from(bytes));
  expect(file.encoding ?? "utf-8").toBe(encoding);
  expect(file.text).toBe(text);
  expect([...bytesOfTextFile(file)]).toEqual([...bytes]);
});

test("a text program is selected, changed in one file and taken out like a program of steps", () => {
  const file = textFileOf("weld.src", new TextEncoder().encode("DEF weld( )\nEND\n"));
  const cell = addProgram(emptyCell(), program([file]));
  expect(selectedProgram(cell)).toBeUndefined();
  expect(mainFileOf(selectedText(cell)!)).toBe(file);
  expect(withSelectedText(cell, before => withFileText(before, "weld.src", file.text))).toBe(cell);
  const changed = withSelectedText(cell, before => withFileText(before, "weld.src", "DEF weld( )\n;\nEND\n"));
  expect(selectedText(changed)!.files[0]!.text).toBe("DEF weld( )\n;\nEND\n");
  expect(selectedProgram(removeProgram(cell, "weld"))!.name).toBe("Program");
});

test("a text program without its main file, with a file twice or with a character that is no byte is refused with its place", () => {
  const opens = (text: object): string => {
    const cell = { ...emptyCell(), programs: [text], program: "weld" };
    const opened = openDocument(JSON.stringify(cell));
    return opened.kind === "not-a-cell" ? opened.why.join("\n") : opened.kind;
  };
  const good = program([{ name: "weld.src", text: "" }]);
  expect(opens(good)).toBe("opened");
  expect(opens({ ...good, main: "other.src" })).toBe('programs[0].main: the program has no file called "other.src".');
  expect(opens({ ...good, files: [...good.files, ...good.files] })).toBe(
    'programs[0].files[1].name: "weld.src" is already the name of another file.',
  );
  expect(opens({ ...good, files: [{ name: "weld.src", encoding: "latin-1", text: "a→" }] })).toBe(
    "programs[0].files[0]: character 2 of the text is no byte (U+0000 … U+00FF).",
  );
  expect(opens({ ...good, files: [] })).toMatch(/^programs\[0\]\.files: /);
});
