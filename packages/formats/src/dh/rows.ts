import { Refusal } from "../refusal.ts";
import { numbersIn, shorten } from "../xml.ts";
import { conventionOf, DH_COLUMNS, unitsOf, type DhColumn, type WrittenRow, type WrittenTable } from "./written.ts";

/** Other names that columns have in books and data sheets. */
const SYNONYMS: Readonly<Record<string, DhColumn | "name" | "skip">> = {
  name: "name",
  joint: "name",
  i: "skip",
  "#": "skip",
  a_prev: "a",
  r: "a",
  α: "alpha",
  alpha_prev: "alpha",
  θ: "theta",
  offset: "theta",
  theta_offset: "theta",
  sign: "sense",
  min: "lower",
  max: "upper",
  velocity: "speed",
};

/** A table as text: what is said of all in lines that begin with #, then column names, then a line per joint. */
export function rowsFromText(text: string): WrittenTable {
  const said = new Map<string, { readonly value: string; readonly line: number }>();
  const rows: WrittenRow[] = [];
  let columns: (DhColumn | "name" | "skip")[] | undefined;
  text.split(/\r\n|\n|\r/).forEach((raw, i) => {
    const line = i + 1;
    const content = raw.trim();
    const statement = /^#\s*([a-z]+)\s*[:=]\s*(.*)$/i.exec(content);
    if (statement) said.set(statement[1]!.toLowerCase(), { value: statement[2]!.trim(), line });
    if (content === "" || content.startsWith("#")) return;
    const cells = cellsOf(content);
    if (!columns) {
      columns = cells.map(cell => columnOf(cell, line));
      return;
    }
    if (cells.length !== columns.length)
      throw new Refusal(`A row has ${cells.length} entries; there are ${columns.length} columns.`, line);
    const numbers: Partial<Record<DhColumn, number>> = {};
    let name: string | undefined;
    columns.forEach((column, k) => {
      if (column === "name") name = /^\d+$/.test(cells[k]!) ? `joint_${cells[k]}` : cells[k];
      else if (column !== "skip" && cells[k] !== "")
        numbers[column] = numbersIn(cells[k]!, 1, `The ${column}`, line)[0]!;
    });
    rows.push({ name, line, numbers });
  });
  if (!columns) throw new Refusal("The table has no line of column names, such as: name a alpha d theta.");
  const [length, angle] = (said.get("units")?.value ?? "").split(/[\s,;]+/);
  return {
    name: said.get("name")?.value,
    convention: conventionOf(said.get("convention")?.value),
    ...unitsOf(length, angle),
    rows,
    base: undefined,
    flange: undefined,
  };
}

function cellsOf(line: string): string[] {
  const separator = line.includes(";") ? ";" : line.includes(",") ? "," : line.includes("\t") ? "\t" : undefined;
  return separator === undefined ? line.split(/\s+/) : line.split(separator).map(cell => cell.trim());
}
function columnOf(cell: string, line: number): DhColumn | "name" | "skip" {
  const plain = cell.toLowerCase();
  const column =
    DH_COLUMNS.find(each => each === plain) ?? (Object.hasOwn(SYNONYMS, plain) ? SYNONYMS[plain] : undefined);
  if (column === undefined)
    throw new Refusal(`“${shorten(cell)}” is no column of a D-H table; ${DH_COLUMNS.join(", ")} and name are.`, line);
  return column;
}
