import { readFileSync } from "node:fs";
import fc from "fast-check";
import { describe, expect, test } from "vitest";
import { cellGeometry, edgeTraceCell, emptyCell, openDocument, saveDocument, type CellDocument } from "./index.ts";
import { NEWEST, STEPS, lift } from "./versions.ts";

const kept = (version: number): string =>
  readFileSync(new URL(`../../../fixtures/cells/v${version}.json`, import.meta.url), "utf8");

function why(text: string): readonly string[] {
  const opened = openDocument(text);
  return opened.kind === "not-a-cell" ? opened.why : [opened.kind];
}

interface Loose {
  objects: object[];
  programs: object[];
}

/** The example with one change made in its JSON. */
function changed(change: (cell: Loose) => void): string {
  const cell = JSON.parse(saveDocument(edgeTraceCell())) as Loose;
  change(cell);
  return JSON.stringify(cell);
}

describe("opening a cell", () => {
  test("what was saved is opened bit for bit, and saved again it is the same text", () => {
    for (const document of [edgeTraceCell(), emptyCell()]) {
      const text = saveDocument(document);
      const opened = openDocument(text);
      expect(opened).toEqual({ kind: "opened", document, lifted: [] });
      expect(opened.kind === "opened" && saveDocument(opened.document)).toBe(text);
    }
  });

  test("key order of the object in memory does not show in the file", () => {
    const turned = (value: unknown): unknown =>
      Array.isArray(value)
        ? value.map(turned)
        : typeof value === "object" && value !== null
          ? Object.fromEntries(
              Object.entries(value)
                .reverse()
                .map(([k, v]) => [k, turned(v)]),
            )
          : value;
    expect(saveDocument(turned(edgeTraceCell()) as CellDocument)).toBe(saveDocument(edgeTraceCell()));
  });

  test("every version has a step up and a kept file that opens", () => {
    for (let version = 1; version <= NEWEST; version++) {
      if (version < NEWEST) expect(STEPS[version], `step from version ${version}`).toBeDefined();
      const opened = openDocument(kept(version));
      expect(opened.kind, kept(version).slice(0, 200)).toBe("opened");
      if (opened.kind === "opened") expect(opened.lifted).toHaveLength(NEWEST - version);
    }
    expect(Object.keys(STEPS)).toHaveLength(NEWEST - 1);
  });

  test("steps are taken one after the other and said", () => {
    const steps = {
      1: { says: "One.", lift: (cell: Readonly<Record<string, unknown>>) => ({ ...cell, a: 1 }) },
      2: { says: "Two.", lift: (cell: Readonly<Record<string, unknown>>) => ({ ...cell, b: cell.a }) },
    };
    expect(lift({ version: 1 }, 1, steps, 3)).toEqual({ cell: { version: 3, a: 1, b: 1 }, says: ["One.", "Two."] });
    expect(lift({ version: 2, a: 5 }, 2, steps, 3)).toEqual({ cell: { version: 3, a: 5, b: 5 }, says: ["Two."] });
  });

  test("a newer file is an answer of its own", () => {
    expect(
      openDocument(
        changed(cell => {
          Object.assign(cell, { version: NEWEST + 4 });
        }),
      ),
    ).toEqual({ kind: "too-new", version: NEWEST + 4, newest: NEWEST });
  });

  test("what is not a cell says why and where", () => {
    expect(why("{")[0]).toMatch(/not JSON/);
    expect(why("[]")).toEqual(["The file holds no JSON object."]);
    expect(why('{"format":"twincell.program"}')).toEqual([
      'A cell says "format": "twincell.cell"; this file says "twincell.program".',
    ]);
    expect(why('{"format":"twincell.cell","version":0.5}')[0]).toMatch(/^version: a whole number/);
    const said = (change: Parameters<typeof changed>[0]): string => why(changed(change)).join("\n");
    expect(
      said(cell => {
        Object.assign(cell, {
          robot: { id: "nobody", worldFromBase: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] } },
        });
      }),
    ).toBe('robot.id: the library has no robot called "nobody".');
    expect(
      said(cell => {
        Object.assign(cell.objects[0]!, { worldFromObject: { position: [0, 0, null], quaternion: [0, 0, 0, 1] } });
      }),
    ).toMatch(/^objects\[0\]\.worldFromObject\.position\[2\]: .*number/);
    expect(
      said(cell => {
        Object.assign(cell.objects[1]!, { worldFromObject: { position: [0, 0, 0], quaternion: [0, 0, 0, 2] } });
      }),
    ).toMatch(/^objects\[1\]\.worldFromObject\.quaternion: the length of a quaternion is 1, this one's is 2\.000\.$/);
    expect(
      said(cell => {
        Object.assign(cell.objects[1]!, { id: "column" });
      }),
    ).toBe('objects[1].id: "column" is already the id of objects[0].');
    expect(
      said(cell => {
        Object.assign(cell, { tool: "gripper" });
      }),
    ).toBe('tool: the cell has no tool called "gripper".');
    expect(
      said(cell => {
        Object.assign(cell.programs[0]!, { steps: [{ id: "a", type: "move" }] });
      }),
    ).toMatch(/^programs\[0\]\.steps\[0\]/);
    expect(
      said(cell => {
        Object.assign(cell, { colour: 1 });
      }),
    ).toMatch(/colour/);
    expect(
      said(cell => {
        Object.assign(cell.objects[0]!, { shape: { kind: "mesh", file: "a.stl", positions: "AAAA", indices: "" } });
      }),
    ).toMatch(/^objects\[0\]\.shape: The positions of the mesh are 3 bytes long; a vertex takes 12\.$/);
  });

  test("NaN and infinity do not come in", () => {
    const text = saveDocument(edgeTraceCell());
    expect(why(text.replace("0.75", "NaN"))[0]).toMatch(/not JSON/);
    expect(why(text.replace("0.75", "1e999"))[0]).toMatch(/^robot\.worldFromBase\.position\[2\]/);
  });

  test("damaged text never throws and never hangs", () => {
    const text = saveDocument(edgeTraceCell());
    fc.assert(
      fc.property(fc.nat(text.length - 1), fc.nat(40), fc.string({ maxLength: 8 }), (at, cut, put) => {
        const opened = openDocument(text.slice(0, at) + put + text.slice(at + cut));
        if (opened.kind === "not-a-cell") expect(opened.why.length).toBeGreaterThan(0);
      }),
      { seed: 7, numRuns: 300 },
    );
    fc.assert(
      fc.property(fc.jsonValue(), value => {
        openDocument(
          JSON.stringify({ format: "twincell.cell", version: 1, ...(typeof value === "object" ? value : {}) }),
        );
      }),
      { seed: 8, numRuns: 200 },
    );
  });
});

test("X-09 what an object carries is kept, and is more than nothing", () => {
  const cell = edgeTraceCell();
  const carrying = (carries_kg: number): string =>
    saveDocument({
      ...cell,
      objects: cell.objects.map((object, i) => (i === 0 ? { ...object, carries_kg } : object)),
    });
  const opened = openDocument(carrying(250));
  if (opened.kind !== "opened") throw new Error(JSON.stringify(opened));
  expect(opened.document.objects[0]!.carries_kg).toBe(250);
  expect(cellGeometry(opened.document, []).objects[0]!.carries_kg).toBe(250);
  expect(openDocument(carrying(-1)).kind).toBe("not-a-cell");
});

test("a hundred thousand brackets are a sentence, not an overflow", () => {
  const deep = `{"format":${"[".repeat(100_000)}${"]".repeat(100_000)}}`;
  expect(openDocument(deep)).toMatchObject({ kind: "not-a-cell" });
});
