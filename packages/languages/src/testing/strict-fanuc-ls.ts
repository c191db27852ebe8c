/**
 * A strict grammar of TP listings, written from the facts of the language; it has seen neither the writer nor the
 * reader.
 */
const COMMENT = "(?::[^\\]\\r\\n]{1,16})?";
const CONSTANT = "(?:[0-9]+(?:\\.[0-9]+)?|\\(-[0-9]+(?:\\.[0-9]+)?\\))";
const REGISTER = `R\\[[1-9][0-9]*${COMMENT}\\]`;
const POSITION = `PR\\[[1-9][0-9]*${COMMENT}\\]`;
const DIGITAL = `(?:DI|DO|RI|RO)\\[[1-9][0-9]*${COMMENT}\\]`;
const ANALOGUE = `(?:AI|AO)\\[[1-9][0-9]*${COMMENT}\\]`;
const CONDITION = `(?:${DIGITAL}(?:=|<>)(?:ON|OFF)|${ANALOGUE}(?:<|>)[0-9.]+)`;
const EXPRESSION = `\\((?:${REGISTER}|[0-9.]+|MOD|=|[-+*() ])+\\)`;
const STATEMENTS = [
  "![ -~]{0,32}",
  "WAIT [ 0-9]{3}\\.[0-9]{2}\\(sec\\)",
  `WAIT ${CONDITION}(?: TIMEOUT,LBL\\[[0-9]+\\])?`,
  `(?:DO|RO)\\[[1-9][0-9]*${COMMENT}\\]=(?:ON|OFF|PULSE,[0-9.]+sec)`,
  `AO\\[[1-9][0-9]*${COMMENT}\\]=[0-9.]+`,
  "MESSAGE\\[[ -~]{0,23}\\]",
  "LBL\\[[1-9][0-9]*\\]",
  "JMP LBL\\[[1-9][0-9]*\\]",
  "CALL [A-Z][A-Z0-9_]{0,35}",
  "END",
  "ABORT",
  `SKIP CONDITION ${CONDITION}`,
  "\\$WAITTMOUT=[0-9]+",
  "U(?:FRAME|TOOL)_NUM=[0-9]{1,2}",
  `U(?:FRAME|TOOL)\\[[1-9][0-9]?\\]=${POSITION}`,
  `${POSITION}=LPOS`,
  `${POSITION}=${POSITION}-${POSITION}`,
  `PR\\[[1-9][0-9]*,[1-6]\\]=(?:${CONSTANT}|${EXPRESSION})`,
  `${REGISTER}=(?:${CONSTANT}|${REGISTER}|${EXPRESSION})`,
].map(each => new RegExp(`^ {2}${each} ;$`));
const FOR = new RegExp(`^ {2}FOR ${REGISTER}=[0-9]+ TO (?:[0-9]+|${REGISTER}) ;$`);
const IF = new RegExp(`^ {2}IF \\((?:${CONDITION}|${EXPRESSION.slice(2, -2)})\\) THEN ;$`);
const OPTIONS = `(?:FINE|CNT(?:100|[0-9]{1,2}))(?: ACC[1-9][0-9]{0,2})?(?: Offset,${POSITION})?(?: Skip,LBL\\[[0-9]+\\])?    ;`;
const SPEED = "(?:2000|1[0-9]{3}|[1-9][0-9]{0,2})mm/sec";
const JOINT = new RegExp(`^J P\\[([0-9]+)\\] (?:100|[1-9][0-9]?)% ${OPTIONS}$`);
const STRAIGHT = new RegExp(`^L P\\[([0-9]+)\\] ${SPEED} ${OPTIONS}$`);
const ARC = new RegExp(`^C P\\[([0-9]+)\\](?: Offset,${POSITION})?    $`);
const ARC_END = new RegExp(`^    :  P\\[([0-9]+)\\] ${SPEED} ${OPTIONS}$`);
const NUMBER = "-?[0-9]+\\.[0-9]{3}";
const HEAD = /^\tUF : [0-9], UT : (?:10|[1-9]),\t(?:\tCONFIG : '[FN] [UD] [TB], -?[01], -?[01], -?[01]',)?$/;
const of = (names: readonly string[], unit: string, last: boolean): RegExp =>
  new RegExp(`^${names.map(name => `\\t${name} = +${NUMBER} ${unit}`).join(",")}${last ? "" : ","}$`);
const CARTESIAN = [of(["X", "Y", "Z"], " mm", false), of(["W", "P", "R"], "deg", true)];
const JOINTS = [of(["J1", "J2", "J3"], "deg", false), of(["J4", "J5", "J6"], "deg", true)];

/** What is wrong with a listing, line by line; nothing when a controller would take it. */
export function flawsOfListing(text: string): string[] {
  const flaws: string[] = [];
  const lines = text.split("\r\n");
  const blocks: string[] = [];
  const used = new Set<string>();
  const defined = new Set<string>();
  const labels = new Set<string>();
  const jumps = new Set<string>();
  let section = "";
  let count = 0;
  let declared = -1;
  let sincePoint = 0;
  if (text.replaceAll("\r\n", "").includes("\n") || lines.pop() !== "") flaws.push("line ends");
  if (!/^\/PROG {2}[A-Z][A-Z0-9_]{0,35}$/.test(lines[0] ?? "")) flaws.push(`1: ${lines[0]}`);
  for (const [i, line] of lines.entries()) {
    const flaw = (what = line): void => {
      flaws.push(`${i + 1}: ${what}`);
    };
    if (i === 0) continue;
    if (["/ATTR", "/MN", "/POS", "/END"].includes(line)) {
      const order = ["", "/ATTR", "/MN", "/POS", "/END"];
      if (order.indexOf(line) !== order.indexOf(section) + 1) flaw("sections in another order");
      section = line;
      continue;
    }
    switch (section) {
      case "/ATTR":
        if (!/^[A-Z_]+\t+= [^;]*;$|^(?:TCD:)? +[A-Z_]+\t= [0-9]+[,;]$|^FILE_NAME\t= ;$/.test(line)) flaw();
        if (line.startsWith("LINE_COUNT")) declared = Number(/[0-9]+/.exec(line)![0]);
        if (/^COMMENT/.test(line) && !/"[^"]{0,16}"/.test(line)) flaw();
        break;
      case "/MN": {
        if (ARC_END.test(line)) {
          used.add(ARC_END.exec(line)![1]!);
          break;
        }
        const numbered = /^ *([0-9]+):(.*)$/.exec(line);
        if (
          numbered === null ||
          Number(numbered[1]) !== ++count ||
          numbered[1]!.padStart(4) !== line.slice(0, line.indexOf(":"))
        ) {
          flaw();
          break;
        }
        const statement = numbered[2]!;
        const point = JOINT.exec(statement) ?? STRAIGHT.exec(statement) ?? ARC.exec(statement);
        for (const [, to] of statement.matchAll(/(?:JMP |TIMEOUT,|Skip,)LBL\[([0-9]+)\]/g)) jumps.add(to!);
        if (point !== null) {
          used.add(point[1]!);
          if (ARC.test(statement) && !ARC_END.test(lines[i + 1] ?? "")) flaw("an arc without its end");
        } else if (FOR.test(statement)) blocks.push("FOR");
        else if (IF.test(statement)) blocks.push("IF");
        else if (statement === "  ELSE ;") {
          if (blocks.at(-1) !== "IF") flaw();
        } else if (statement === "  ENDFOR ;") {
          if (blocks.pop() !== "FOR") flaw();
        } else if (statement === "  ENDIF ;") {
          if (blocks.pop() !== "IF") flaw();
        } else if (!STATEMENTS.some(each => each.test(statement))) flaw();
        const label = /^ {2}LBL\[([0-9]+)\]/.exec(statement)?.[1];
        if (label !== undefined) {
          if (labels.has(label)) flaw("a label twice");
          labels.add(label);
        }
        break;
      }
      case "/POS": {
        const begins = /^P\[([1-9][0-9]*)\]\{$/.exec(line)?.[1];
        if (begins !== undefined) {
          defined.add(begins);
          sincePoint = 0;
          break;
        }
        sincePoint++;
        const isCartesian = /CONFIG/.test(lines[i - sincePoint + 2] ?? "");
        const expected = [undefined, /^ {3}GP1:$/, HEAD, ...(isCartesian ? CARTESIAN : JOINTS), /^\};$/][sincePoint];
        if (expected?.test(line) !== true) flaw();
        break;
      }
      default:
        flaw();
    }
  }
  if (section !== "/END") flaws.push("no end");
  if (declared !== count) flaws.push(`LINE_COUNT ${declared}, lines ${count}`);
  if (blocks.length > 0) flaws.push(`open: ${blocks.join()}`);
  for (const point of used) if (!defined.has(point)) flaws.push(`P[${point}] is used and not in /POS`);
  for (const label of jumps) if (!labels.has(label)) flaws.push(`LBL[${label}] is nowhere`);
  return flaws;
}
