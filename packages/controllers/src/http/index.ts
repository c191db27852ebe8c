export * from "./digest.ts";
export * from "./form.ts";
export * from "./message.ts";
export * from "./reader.ts";
export * from "./writer.ts";
