export { abbFace, type AbbFaceOptions } from "./face.ts";
