import { TAG_MODULES, tagModuleIsWhite } from "./tags.ts";

/** A tag printed on a sheet: its centre from the sheet's middle, x right, y up. */
export interface SheetTag {
  readonly id: number;
  readonly side_m: number;
  readonly x_m: number;
  readonly y_m: number;
}

/** A sheet of paper with tags. */
export interface MarkerSheet {
  readonly name: string;
  readonly width_m: number;
  readonly height_m: number;
  readonly tags: readonly SheetTag[];
}
const A4 = { width_m: 0.21, height_m: 0.297 };

/**
 * The marker that the robot's base is put on: one tag of 100 mm with id 0 in the middle of an A4 sheet.
 */
export const BASE_MARKER: MarkerSheet = { name: "marker", ...A4, tags: [{ id: 0, side_m: 0.1, x_m: 0, y_m: 0 }] };

const COLUMNS = 4;
const ROWS = 6;
const BOARD_SIDE_M = 0.032;
const BOARD_PITCH_M = 0.042;

/** The board a lens is calibrated with: tags 8 … 31, 32 mm each, in 4 columns and 6 rows 42 mm apart. */
export const LENS_BOARD: MarkerSheet = {
  name: "board",
  ...A4,
  tags: Array.from({ length: COLUMNS * ROWS }, (_, i) => ({
    id: 8 + i,
    side_m: BOARD_SIDE_M,
    x_m: ((i % COLUMNS) - (COLUMNS - 1) / 2) * BOARD_PITCH_M,
    y_m: ((ROWS - 1) / 2 - Math.floor(i / COLUMNS)) * BOARD_PITCH_M,
  })),
};

/**
 * A sheet as an SVG drawing in millimetres, to be printed at 100 %. A line of 100 mm shows whether it was.
 *
 * @param title and what is written below the line; nothing else is written
 */
export function sheetSvg(sheet: MarkerSheet, title: string, below: string): string {
  const mm = (metres: number): string => (Math.round(metres * 1e6) / 1e3).toString();
  const width = mm(sheet.width_m);
  const height = mm(sheet.height_m);
  const black: string[] = [];
  for (const { id, side_m, x_m, y_m } of sheet.tags) {
    const module = side_m / TAG_MODULES;
    const left = sheet.width_m / 2 + x_m - side_m / 2;
    const top = sheet.height_m / 2 - y_m - side_m / 2;
    for (let row = 0; row < TAG_MODULES; row++)
      for (let column = 0; column < TAG_MODULES; ) {
        // Neighbours are one rectangle: printers show hair lines between two.
        let run = 0;
        while (column + run < TAG_MODULES && !tagModuleIsWhite(id, row, column + run)) run++;
        if (run > 0)
          black.push(
            `M${mm(left + column * module)} ${mm(top + row * module)}h${mm(run * module)}v${mm(module)}h-${mm(run * module)}z`,
          );
        column += Math.max(1, run);
      }
  }
  const line = sheet.height_m - 0.02;
  const start = sheet.width_m / 2 - 0.05;
  const text = (value: string): string =>
    value.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" width="${width}mm" height="${height}mm" viewBox="0 0 ${width} ${height}">`,
    `<rect width="${width}" height="${height}" fill="#fff"/>`,
    `<path fill="#000" shape-rendering="crispEdges" d="${black.join("")}"/>`,
    `<path stroke="#000" stroke-width="0.3" fill="none" d="M${mm(start)} ${mm(line)}h100m-100 -2v4m100 -4v4"/>`,
    `<g font-family="sans-serif" font-size="4.2" text-anchor="middle" fill="#000">`,
    `<text x="${mm(sheet.width_m / 2)}" y="12">${text(title)}</text>`,
    `<text x="${mm(sheet.width_m / 2)}" y="${mm(line + 0.009)}">${text(below)}</text>`,
    `</g></svg>`,
  ].join("\n");
}
