export { createCs7Face, type Cs7FaceOptions } from "./face.ts";
