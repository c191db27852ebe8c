/*
 * Listings that a controller wrote with German texts: the same instructions under other words. Each is put back to the
 * English word, so that one grammar reads both; lines stay, columns of a German line may move.
 */

/** Words that begin a statement, or follow the option of a motion. Longer ones before shorter ones they begin with. */
const WORDS: readonly (readonly [german: RegExp, english: string])[] = [
  [/^(\s*)WKZ_NUM\b/, "$1UTOOL_NUM"],
  [/^(\s*)BENUTZER_NUM\b/, "$1UFRAME_NUM"],
  [/^(\s*)WKZ(?=\s*\[)/, "$1UTOOL"],
  [/^(\s*)BENUTZER(?=\s*\[)/, "$1UFRAME"],
  [/^(\s*)TRAGLST\b/, "$1PAYLOAD"],
  [/^(\s*)FB-PSPS\b/, "$1TC_ONLINE"],
  [/^(\s*)FREIG\.?(?=\s)/, "$1UNLOCK"],
  [/^(\s*)SPERR(?:E|EN)?\.?(?=\s)/, "$1LOCK"],
  [/^(\s*)IRQ BEDINGUNG\b/, "$1SKIP CONDITION"],
  [/^(\s*)VERSCHIEB(?:UNG)? BEDINGUNG\b/, "$1OFFSET CONDITION"],
  [/^(\s*)ENDE\b/, "$1END"],
  [/^(\s*)ABBRUCH\b/, "$1ABORT"],
  [/^(\s*)HALT\b/, "$1PAUSE"],
  [/^(\s*)(?:MELDUNG|NACHRICHT)(?=\s*\[)/, "$1MESSAGE"],
  [/^(\s*)WARTE\b/, "$1WAIT"],
  [/^(\s*)WENN\b/, "$1IF"],
  [/^(\s*)(?:AUSWAHL|WAHL)\b/, "$1SELECT"],
  [/^(\s*)SONST\b/, "$1ELSE"],
  [/(^|,)(\s*)AUFRUF\b/g, "$1$2CALL"],
  [/(^|,)(\s*)(?:SPRUNG|SPRNG) (?:LABEL|LBL)(?=\s*\[)/g, "$1$2JMP LBL"],
  [/(^|,)(\s*)LABEL(?=\s*\[)/g, "$1$2LBL"],
  [/\bInterrupt,(?=\s*LBL)/g, "Skip,"],
  [/\b(?:ZEIT VOR)\b/g, "TB"],
  [/\b(?:ZEIT NACH)\b/g, "TA"],
  [/\bWEG VOR\b/g, "DB"],
  [/\bVersch(?:ieb)?,(?=\s*PR)/gi, "Offset,"],
  [/\bWKZ_(?:Versch(?:ieb)?|Offset)\s*,(?=\s*PR)/gi, "Tool_Offset,"],
  [/\bmax_Geschw\./gi, "max_speed"],
  [/\bsek\b/g, "sec"],
  [/\[\+\]/g, " OR "],
  [/\[&\]/g, " AND "],
  [/(^|[^A-Za-z_$.\]])(gE|gA|aE|aA|rE|rA|uE|uA|sE|sA|E|A|i)(?=\s*\[)/g, ""],
  [/([=(,]\s*)AN\b/g, "$1ON"],
  [/([=(,]\s*)AUS\b/g, "$1OFF"],
  [/=\s*PULS\b/g, "=PULSE"],
  [/\bFEIN\b/g, "FINE"],
];
const LINES: Readonly<Record<string, string>> = {
  E: "DI",
  A: "DO",
  i: "R",
  gE: "GI",
  gA: "GO",
  aE: "AI",
  aA: "AO",
  rE: "RI",
  rA: "RO",
  uE: "UI",
  uA: "UO",
  sE: "SI",
  sA: "SO",
};

/** Whether the head of a listing was written with German texts. */
export const isGermanHead = (line: string): boolean =>
  /^\s*(?:EIGN\.|KOMMENTAR|SCHUTZ|ERSTELL|ZEILEN|DATEI_NAME)\s*=/.test(line);

/** A statement with its German words put back to the English ones; a remark and a message stay as they are. */
export function inEnglish(statement: string): string {
  if (/^\s*(?:!|--|\/\/)/.test(statement)) return statement;
  let text = statement;
  for (const [german, english] of WORDS)
    text =
      english === ""
        ? text.replace(german, (_, before: string, word: string) => before + LINES[word]!)
        : text.replace(german, english);
  return text;
}
