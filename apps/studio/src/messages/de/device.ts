import type { Translation } from "../catalogue.ts";
import type { device as english } from "../en/device.ts";

/** German: what this device can do. */
export const device = {
  title: "Dieses Gerät",
  command: "Dieses Gerät prüfen …",
  checks: "Was dieses Gerät und diese Seite können",
  names: {
    secure: "Sichere Seite",
    certificate: "Vertrautes Zertifikat",
    headset: "Headset (WebXR)",
    camera: "Kamera",
    graphics: "3D-Grafik (WebGL 2)",
    socket: "Verbindung zum Server",
  },
  findings: { ok: "vorhanden", missing: "fehlt", unknown: "noch nicht bekannt" },
  missing: {
    secure:
      "Browser geben Headset, Kamera und Betrieb ohne Netz nur sicheren Seiten: über https öffnen (serve --lan) oder " +
      "als localhost (adb reverse).",
    certificate:
      "Die Seite arbeitet, bleibt aber ohne Netz nicht erhalten. adb reverse benutzen oder ein Zertifikat, dem " +
      "dieses Gerät vertraut.",
    headset: "Die Seite im Browser des Headsets öffnen.",
    camera: "Keine Kamera antwortet dieser Seite. Über https auf einem Gerät öffnen, das eine hat.",
    graphics:
      "Ohne sie wird die Zelle nicht gezeichnet. Hardwarebeschleunigung einschalten oder einen anderen Browser " +
      "nehmen.",
    socket: "Kein Server antwortet: die Seite arbeitet allein, ohne reale Steuerungen. npx twincell serve starten.",
  },
  latency: "Verzögerung, Stufe für Stufe",
  stages: { input: "Eingabe", render: "Zeichnen", link: "Verbindung", controller: "Takt der Steuerung" },
  notYet: {
    input: "Berühren oder Zeiger bewegen",
    render: "Noch nichts gezeichnet",
    link: "Kein Server, kein Roboter",
    controller: "Kein Roboter verbunden",
  },
  "ms(ms)": "{ms} ms",
} satisfies Translation<typeof english>;
