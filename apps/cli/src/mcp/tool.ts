import type { z } from "zod";
import type { CellFolder } from "./cell-folder.ts";

/** One thing that an agent may ask for. What is wrong is thrown as a fault: one sentence and the way out. */
export interface Tool<Input extends z.ZodObject = z.ZodObject> {
  readonly name: string;
  readonly title: string;
  readonly description: string;
  readonly input: Input;
  /** Changes no file. */
  readonly readOnly: boolean;
  run(folder: CellFolder, asked: z.output<Input>): Promise<object>;
}

/** Keeps the input of one tool typed where tools of all kinds are listed. */
export const tool = <Input extends z.ZodObject>(described: Tool<Input>): Tool => ({
  ...described,
  run: (folder, asked) => described.run(folder, described.input.parse(asked)),
});
