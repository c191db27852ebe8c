import { useThree } from "@react-three/fiber";
import { useEffect } from "react";
import { onDrawThumbnail, THUMBNAIL } from "../runtime/thumbnail.ts";

const TYPE = "image/webp";
const QUALITY = 0.82;

/**
 * Draws the cell once more when asked, and takes the middle of it as its small picture. Does nothing frame by frame.
 */
export function Thumbnail() {
  const gl = useThree(state => state.gl);
  const scene = useThree(state => state.scene);
  const camera = useThree(state => state.camera);
  useEffect(
    () =>
      onDrawThumbnail(() => {
        const source = gl.domElement;
        if (gl.xr.isPresenting || source.width === 0 || source.height === 0) return null;
        const canvas = document.createElement("canvas");
        canvas.width = THUMBNAIL.width;
        canvas.height = THUMBNAIL.height;
        const to = canvas.getContext("2d");
        if (!to) return null;
        // The drawing buffer is only readable in the task in which it was drawn.
        gl.render(scene, camera);
        const factor = Math.min(source.width / THUMBNAIL.width, source.height / THUMBNAIL.height);
        const width = THUMBNAIL.width * factor;
        const height = THUMBNAIL.height * factor;
        const colour = getComputedStyle(document.documentElement).getPropertyValue("--viewport-bottom").trim();
        to.fillStyle = colour || "#20262b";
        to.fillRect(0, 0, THUMBNAIL.width, THUMBNAIL.height);
        to.drawImage(
          source,
          (source.width - width) / 2,
          (source.height - height) / 2,
          width,
          height,
          0,
          0,
          THUMBNAIL.width,
          THUMBNAIL.height,
        );
        return canvas.toDataURL(TYPE, QUALITY);
      }),
    [gl, scene, camera],
  );
  return null;
}
