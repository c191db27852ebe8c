export { abbEgmFace, type AbbEgmFaceOptions } from "./egm-face.ts";
export { abbFace, type AbbFaceOptions } from "./face.ts";
