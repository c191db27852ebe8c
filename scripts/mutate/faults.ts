import ts from "typescript";

/** One fault that could be made in an emitter: where, of what sort, and what stands there instead. */
export interface Fault {
  readonly file: string;
  readonly line: number;
  readonly sort: string;
  readonly from: string;
  readonly to: string;
  readonly start: number;
  readonly end: number;
}

const OPPOSITES: Readonly<Record<string, string>> = {
  "+": "-",
  "-": "+",
  "*": "/",
  "/": "*",
  "===": "!==",
  "!==": "===",
  "<": ">=",
  ">=": "<",
  ">": "<=",
  "<=": ">",
  "&&": "||",
  "||": "&&",
};
/** What turns metres and radians into what a controller counts in. */
const UNITS = new Set(["degrees", "millimetres", "mm", "radians", "inverse"]);
/** What is said to people moves no robot. */
const SAYINGS = new Set(["CannotSay", "warnings", "sentence", "hint", "title", "because", "RangeError"]);

/**
 * Every fault of these sorts in a source: wrong numbers, signs, conditions and units, swapped parts and dropped
 * statements.
 */
export function faultsIn(file: string, source: string): Fault[] {
  const tree = ts.createSourceFile(file, source, ts.ScriptTarget.ESNext, true);
  const faults: Fault[] = [];
  const put = (sort: string, node: ts.Node, to: string): void => {
    const start = node.getStart(tree);
    const end = node.end;
    faults.push({
      file,
      line: tree.getLineAndCharacterOfPosition(start).line + 1,
      sort,
      from: source.slice(start, end).slice(0, 120),
      to: to.slice(0, 120),
      start,
      end,
    });
    texts.set(faults.at(-1)!, to);
  };
  const text = (node: ts.Node): string => node.getText(tree);
  const swapped = (list: readonly ts.Node[], sort: string): void => {
    for (let i = 0; i + 1 < list.length; i++) {
      const [a, b] = [list[i]!, list[i + 1]!];
      if (text(a) === text(b) || ts.isSpreadElement(a) || ts.isSpreadElement(b) || ts.isArrowFunction(b)) continue;
      const start = a.getStart(tree);
      const between = source.slice(a.end, b.getStart(tree));
      faults.push({
        file,
        line: tree.getLineAndCharacterOfPosition(start).line + 1,
        sort,
        from: source.slice(start, b.end).slice(0, 120),
        to: `${text(b)}${between}${text(a)}`.slice(0, 120),
        start,
        end: b.end,
      });
      texts.set(faults.at(-1)!, `${text(b)}${between}${text(a)}`);
    }
  };
  const visit = (node: ts.Node): void => {
    if (
      ts.isTypeNode(node) ||
      ts.isImportDeclaration(node) ||
      ts.isInterfaceDeclaration(node) ||
      ts.isTypeAliasDeclaration(node)
    )
      return;
    if (ts.isNewExpression(node) && SAYINGS.has(text(node.expression))) return;
    if (ts.isPropertyAssignment(node) && SAYINGS.has(text(node.name))) return;
    if (ts.isExpressionStatement(node)) {
      if (/\b(?:warnings|warn)\b/.test(text(node)) || text(node).startsWith("super(")) return;
      if (ts.isCallExpression(node.expression)) put("dropped statement", node, ";");
    }
    if (ts.isNumericLiteral(node)) {
      const value = Number(node.text);
      put("wrong number", node, String(value + 1));
      if (value > 1) put("wrong number", node, String(value - 1));
    }
    if (ts.isBinaryExpression(node)) {
      const sign = text(node.operatorToken);
      const other = OPPOSITES[sign];
      if (other !== undefined)
        put(
          sign.length > 1 || sign === "<" || sign === ">" ? "wrong condition" : "wrong sign",
          node.operatorToken,
          other,
        );
    }
    if (ts.isPrefixUnaryExpression(node)) {
      if (node.operator === ts.SyntaxKind.MinusToken) put("wrong sign", node, text(node.operand));
      if (node.operator === ts.SyntaxKind.ExclamationToken) put("wrong condition", node, text(node.operand));
    }
    if (ts.isConditionalExpression(node))
      put("swapped branches", node, `${text(node.condition)} ? ${text(node.whenFalse)} : ${text(node.whenTrue)}`);
    if (ts.isCallExpression(node)) {
      if (UNITS.has(text(node.expression)) && node.arguments.length === 1)
        put("wrong unit", node, text(node.arguments[0]!));
      if (!/add|push|block|remark|includes|startsWith|endsWith|hasOwn|test$/.test(text(node.expression)))
        swapped(node.arguments, "swapped parts");
    }
    if (ts.isArrayLiteralExpression(node) && node.elements.length > 1 && node.elements.length <= 8)
      swapped(node.elements, "swapped parts");
    ts.forEachChild(node, visit);
  };
  visit(tree);
  return faults;
}

/** What stands in the place of a fault, whole. */
const texts = new WeakMap<Fault, string>();
export const withFault = (source: string, fault: Fault): string =>
  source.slice(0, fault.start) + texts.get(fault)! + source.slice(fault.end);
