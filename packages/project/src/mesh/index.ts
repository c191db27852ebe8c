export { decodeMesh, encodeMesh, type DecodedMesh, type EncodedMesh } from "@twincell/core";
export * from "./shape.ts";
export * from "./connection-cell.ts";
