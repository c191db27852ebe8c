import { z } from "zod";

export const cellFile = z.string().min(6).max(120).describe('File name of a cell of the folder, such as "cell.json".');
export const programName = z
  .string()
  .min(1)
  .max(200)
  .optional()
  .describe("Name of a program; the selected one when absent.");
/** SI units and radians, as the schemas of docs/ say. */
export const anyJson = z.record(z.string(), z.unknown());
