/** What this device can do, and how late things are. */
export const device = {
  title: "This device",
  command: "Check this device …",
  checks: "What this device and page can do",
  names: {
    secure: "Secure page",
    certificate: "Trusted certificate",
    headset: "Headset (WebXR)",
    camera: "Camera",
    graphics: "3D graphics (WebGL 2)",
    socket: "Connection to the server",
  },
  findings: { ok: "there", missing: "missing", unknown: "not known yet" },
  missing: {
    secure:
      "Browsers give headset, camera and offline use to secure pages only: open it by https (serve --lan), or as " +
      "localhost (adb reverse).",
    certificate:
      "The page works, but is not kept for use without a network. Use adb reverse, or a certificate that this device " +
      "trusts.",
    headset: "Open the page in the headset's own browser.",
    camera: "No camera answers this page. Open it by https on a device that has one.",
    graphics: "Without it the cell is not drawn. Switch hardware acceleration on, or use another browser.",
    socket: "No server answers: the page works by itself, without real controllers. Start npx twincell serve.",
  },
  latency: "Latency, stage by stage",
  stages: { input: "Input", render: "Render", link: "Link", controller: "Controller cycle" },
  notYet: {
    input: "Touch, or move the pointer",
    render: "Nothing drawn yet",
    link: "No server, no robot",
    controller: "No robot connected",
  },
  "ms(ms)": "{ms} ms",
};
