/** The page that tells a device how to trust this server: before the studio and its catalogues, a language a line. */
const TEXTS = {
  en: {
    title: "Trust this Twincell server",
    why:
      "Without it browsers warn, and do not keep the studio for use without a network. The authority was " +
      "made on the computer that runs Twincell; it can vouch for addresses of local networks only. Compare " +
      "its fingerprint with the one shown where Twincell was started.",
    get: "Download the authority",
    go: "Open the studio",
    steps: [
      [
        "iPhone, iPad",
        "Open the download, then Settings, Profile Downloaded, Install; then General, About, Certificate " +
          "Trust Settings, and switch Twincell on.",
      ],
      [
        "Vision Pro",
        "As on an iPad: Settings, Profile Downloaded, Install; General, About, Certificate Trust Settings.",
      ],
      [
        "Android phone",
        "Settings, Security, Encryption and credentials, Install a certificate, CA certificate; choose the download.",
      ],
      [
        "Quest, Pico",
        "Their systems take no authority from a person. Use adb reverse (docs/headsets.md), or go on past the warning.",
      ],
      ["Windows", "Open the download, Install Certificate, Local Machine, Trusted Root Certification Authorities."],
      ["macOS", "Open the download, add it to the System keychain, open it there, Trust: Always."],
      ["Linux, Chrome", "Settings, Privacy and security, Security, Manage certificates, Installed by you, Import."],
      ["Firefox", "Settings, Privacy and Security, View Certificates, Authorities, Import."],
    ],
  },
  de: {
    title: "Diesem Twincell-Server vertrauen",
    why:
      "Ohne das warnen Browser und behalten das Studio nicht für den Betrieb ohne Netz. Die Stelle wurde " +
      "auf dem Rechner erzeugt, auf dem Twincell läuft; sie kann nur für Adressen lokaler Netze bürgen. Den " +
      "Fingerabdruck mit dem vergleichen, der dort steht, wo Twincell gestartet wurde.",
    get: "Zertifizierungsstelle herunterladen",
    go: "Studio öffnen",
    steps: [
      [
        "iPhone, iPad",
        "Die Datei öffnen, dann Einstellungen, Profil geladen, Installieren; dann Allgemein, Info, " +
          "Zertifikatsvertrauenseinstellungen, und Twincell einschalten.",
      ],
      [
        "Vision Pro",
        "Wie auf einem iPad: Einstellungen, Profil geladen, Installieren; Allgemein, Info, " +
          "Zertifikatsvertrauenseinstellungen.",
      ],
      [
        "Android-Telefon",
        "Einstellungen, Sicherheit, Verschlüsselung und Anmeldedaten, Zertifikat installieren, CA-Zertifikat; " +
          "die Datei wählen.",
      ],
      [
        "Quest, Pico",
        "Deren Systeme nehmen von Personen keine Stelle an. adb reverse benutzen (docs/headsets.md) oder die " +
          "Warnung übergehen.",
      ],
      [
        "Windows",
        "Die Datei öffnen, Zertifikat installieren, Lokaler Computer, Vertrauenswürdige Stammzertifizierungsstellen.",
      ],
      ["macOS", "Die Datei öffnen, zum Schlüsselbund System hinzufügen, dort öffnen, Vertrauen: Immer."],
      ["Linux, Chrome", "Einstellungen, Datenschutz und Sicherheit, Sicherheit, Zertifikate verwalten, Importieren."],
      [
        "Firefox",
        "Einstellungen, Datenschutz & Sicherheit, Zertifikate anzeigen, Zertifizierungsstellen, Importieren.",
      ],
    ],
  },
} as const;
const isSpoken = (language: string): language is keyof typeof TEXTS => Object.hasOwn(TEXTS, language);

const STYLE = [
  "body{font:16px/1.45 system-ui;background:#101315;color:#e8edf0;margin:0}",
  "main{max-width:640px;margin:0 auto;padding:20px 16px;display:grid;gap:16px}",
  "h1{font-size:20px;margin:0}",
  "p,dl{margin:0}",
  "a{display:inline-block;min-height:48px;line-height:48px;padding:0 18px;margin:0 8px 8px 0;border-radius:10px}",
  "a{background:#3fb8b3;color:#04211f;font-weight:600;text-decoration:none}",
  "a.plain{background:#1e2428;color:#e8edf0}",
  "code{font-size:13px;overflow-wrap:anywhere;color:#a9b5bc}",
  "dt{font-weight:600;margin-top:10px}",
  "dd{margin:0;color:#a9b5bc}",
];

export const TRUST_PATH = "/trust/";
export const AUTHORITY_PATH = "/trust/twincell-authority.crt";

/**
 * The page, in the first language of the browser that it is written in.
 *
 * @param accepted    the Accept-Language header of the request
 * @param fingerprint of the authority, SHA-256, as it is shown on the computer
 */
export function trustPage(accepted: string, fingerprint: string): string {
  const wished = accepted.split(",").map(each => each.trim().slice(0, 2).toLowerCase());
  const language = wished.find(isSpoken) ?? "en";
  const { title, why, get, go, steps } = TEXTS[language];
  const list = steps.map(([device, how]) => `<dt>${device}</dt><dd>${how}</dd>`).join("");
  return [
    `<!doctype html><html lang="${language}"><meta charset="utf-8">`,
    `<meta name="viewport" content="width=device-width,initial-scale=1"><title>${title}</title>`,
    `<style>${STYLE.join("")}</style>`,
    `<main><h1>${title}</h1><p>${why}</p><p><code>SHA-256 ${fingerprint}</code></p>`,
    `<p><a href="${AUTHORITY_PATH}" download>${get}</a><a class="plain" href="/">${go}</a></p>`,
    `<dl>${list}</dl></main></html>`,
  ].join("\n");
}
