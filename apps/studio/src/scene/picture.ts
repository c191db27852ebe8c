/**
 * Where in the viewport the picture-in-picture is drawn [CSS pixels from its top left]. Written by the DOM, read by the
 * frame loop.
 */
export interface PictureFrame {
  visible: boolean;
  left: number;
  top: number;
  width: number;
  height: number;
}

export const hiddenPicture = (): PictureFrame => ({ visible: false, left: 0, top: 0, width: 1, height: 1 });
