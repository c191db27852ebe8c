import { isTextProgram, type CellDocument } from "../../document.ts";
import { emptyCell } from "../../example/index.ts";

/** A cell whose one program is a vendor's text. */
export function textCell(text: string): CellDocument {
  const cell = emptyCell();
  return {
    ...cell,
    program: "main",
    programs: [
      {
        format: "twincell.text-program",
        version: 1,
        name: "main",
        robot: cell.robot.id,
        language: "krl",
        main: "main.src",
        files: [{ name: "main.src", text }],
      },
    ],
  };
}

/** The same with another text. */
export const importedText = (cell: CellDocument, text: string): CellDocument => ({
  ...cell,
  programs: cell.programs.map(each =>
    isTextProgram(each) ? { ...each, files: each.files.map(file => ({ ...file, text })) } : each,
  ),
});
