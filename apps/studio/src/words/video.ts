const ms = (s: number): string => `${Math.round(s * 1000)} ms`;
const seconds = (s: number): string => `${s.toFixed(1)} s`;

/** What is said about cameras. */
export const videoWords = {
  title: "Cameras", command: "Cameras …", tip: "The real robot's picture beside the twin", none: "No camera shows itself yet.", show: "Show", shown: "Shown",
  here: "This computer's camera", hereSays: "The browser asks for it. The picture stays on this computer.", other: "Through the server", phone: "Add a phone or another computer",
  phoneSays: "Open this address there, allow the camera, and prop it at the robot. Browsers warn about the certificate, which was made here.",
  phoneAlone: "This studio is served to this computer alone. Start npx twincell serve --lan to add a phone.", sameMachine: "A camera of this computer can be shown to every studio of this server, too:", cameraPage: "Open the camera's page",
  server: { off: "The server is not asked yet.", connecting: "The server is asked …", open: "", gone: "The server does not answer." }, noneServer: "No camera shows itself through the server now.", qr: (address: string) => `QR code of ${address}`, copy: "Copy the address", copied: "The address was copied.",
  panel: (name: string) => `Picture of ${name}`, close: "Close the picture", full: "Full screen", leaveFull: "Leave full screen", move: "Move the picture: drag, or arrow keys", again: "Try again",
  asking: "The browser asks whether the camera may be used …", connecting: "Waiting for the server …", waiting: "Waiting for the first picture …", cameraGone: (name: string) => `The camera “${name}” is gone. The last picture stays until it comes back.`,
  takenAway: "The camera was taken away or its permission withdrawn.", unreadable: (why: string) => `A picture could not be unpacked: ${why}.`, noSafety: "A view, no safety device.",
  age: (s: number) => (Number.isNaN(s) ? "age unknown" : ms(s)), late: (s: number) => `Late: what you see was ${ms(s)} ago.`, still: (s: number) => `Picture stands still for ${seconds(s)}.`,
  ageTip: "From the light on the sensor to this screen, worked out for every picture from its time stamp and the clocks.", uncertain: (s: number) => `± ${ms(s)}`,
  stages: (taken: string, up: string, down: string, unpacked: string) => `camera ${taken} · to the server ${up} · to here ${down} · unpacked ${unpacked}`, ms,
  hold: "Hold the twin back to the picture", holdTip: "Draws every robot as it was when the picture was taken, so that both agree. Commands and STOP are never held back.", heldBack: (s: number) => `The twin is drawn ${ms(s)} late, as the picture is.`, heldNot: "The twin is not held back: the picture's time is not known, or too old.",
  measure: "Measure the latency", measureSays: "Point the camera at the pattern, so that it fills a third of the picture, and keep it steady for ten seconds. The pattern is a clock: it tells how long ago it was drawn when it comes back in the picture. The brighter the room, the more pictures count.",
  pattern: "Time code: black and white blocks that change ten times a second", sees: { read: "The pattern is read.", mixed: "Two patterns run into each other: more light, or a shorter exposure.", none: "The pattern is not found: nearer, straighter, all of the white in the picture.", nothing: "No picture comes." },
  figures: { median: "Median", p95: "95 % are within", spread: "Shortest … longest", n: "Pictures counted", estimate: "Estimated from time stamps" }, glass: "Glass to glass", glassSays: "From a change in front of the camera to the first picture on this screen that shows it: display, camera, packing, network, unpacking and half a picture's period.", anew: "Begin anew",
  camera: {
    title: "Twincell camera", says: "Shows this camera's picture to the studios of the same server.", name: "Name of this camera", start: "Show the picture", stop: "Stop", which: "Camera", back: "Back", front: "Front", named: "Phone",
    watched: (n: number) => (n === 0 ? "Nobody looks now." : n === 1 ? "One studio looks." : `${n} studios look.`), rate: (n: number, width: number, height: number) => `${n} pictures a second, ${width} × ${height}`, connecting: "Waiting for the server …", awake: "Keep this page open and in front.",
  },
} as const;
