// The triangles of a COLLADA file, enough for the drawn links beside the checkout: polygon lists, node matrices, unit,
// up axis.
import type { TriangleMesh } from "@twincell/core";

const numbers = (text: string): number[] => text.trim().split(/\s+/).map(Number);
const attribute = (tag: string, name: string): string => new RegExp(`\\b${name}="([^"]*)"`).exec(tag)?.[1] ?? "";

export function daeMesh(text: string): TriangleMesh {
  const unit = Number(attribute(/<unit[^>]*>/.exec(text)?.[0] ?? "", "meter") || 1);
  const yUp = /<up_axis>\s*Y_UP/.test(text);
  const shapes = new Map<string, number[]>();
  for (const [, id, body] of text.matchAll(/<geometry id="([^"]*)"[^>]*>([\s\S]*?)<\/geometry>/g)) {
    const corners: number[] = [];
    for (const [, tag, inner] of body!.matchAll(
      /<(?:triangles|polylist)([^>]*)>([\s\S]*?)<\/(?:triangles|polylist)>/g,
    )) {
      const inputs = [...inner!.matchAll(/<input [^>]*>/g)].map(([each]) => each);
      const vertex = inputs.find(each => attribute(each, "semantic") === "VERTEX")!;
      const stride = 1 + Math.max(...inputs.map(each => Number(attribute(each, "offset"))));
      const offset = Number(attribute(vertex, "offset"));
      const vertices = new RegExp(`<vertices id="${attribute(vertex, "source").slice(1)}"[\\s\\S]*?<\\/vertices>`).exec(
        body!,
      )![0];
      const source = attribute(
        [...vertices.matchAll(/<input [^>]*>/g)]
          .map(([each]) => each)
          .find(each => attribute(each, "semantic") === "POSITION")!,
        "source",
      ).slice(1);
      const places = numbers(new RegExp(`<source id="${source}"[\\s\\S]*?<float_array[^>]*>([^<]*)<`).exec(body!)![1]!);
      const p = numbers(/<p>([^<]*)<\/p>/.exec(inner!)?.[1] ?? "");
      const counts = /<vcount>([^<]*)</.exec(inner!)?.[1];
      const sides =
        counts === undefined ? Array.from({ length: Number(attribute(tag!, "count")) }, () => 3) : numbers(counts);
      let at = 0;
      for (const side of sides) {
        for (let k = 1; k + 1 < side; k++)
          for (const corner of [0, k, k + 1]) {
            const i = p[(at + corner) * stride + offset]!;
            corners.push(places[3 * i]!, places[3 * i + 1]!, places[3 * i + 2]!);
          }
        at += side;
      }
    }
    shapes.set(id!, corners);
  }
  const out: number[] = [];
  const stack: number[][] = [[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]];
  const scene = /<visual_scene[\s\S]*<\/visual_scene>/.exec(text)?.[0] ?? "";
  for (const [token, matrix, url] of scene.matchAll(
    /<node\b[^>]*>|<\/node>|<matrix[^>]*>([^<]*)<\/matrix>|<instance_geometry url="#([^"]*)"/g,
  )) {
    if (token === "</node>") stack.pop();
    else if (token.startsWith("<node")) stack.push([...stack.at(-1)!]);
    else if (matrix !== undefined) stack[stack.length - 1] = times(stack.at(-1)!, numbers(matrix));
    else {
      const m = stack.at(-1)!;
      const corners = shapes.get(url!) ?? [];
      for (let i = 0; i < corners.length; i += 3) {
        const [x, y, z] = [0, 1, 2].map(
          r =>
            unit *
            (m[4 * r]! * corners[i]! +
              m[4 * r + 1]! * corners[i + 1]! +
              m[4 * r + 2]! * corners[i + 2]! +
              m[4 * r + 3]!),
        ) as [number, number, number];
        if (yUp) out.push(x, -z, y);
        else out.push(x, y, z);
      }
    }
  }
  return { positions: Float64Array.from(out), indices: Uint32Array.from({ length: out.length / 3 }, (_, i) => i) };
}

const times = (a: readonly number[], b: readonly number[]): number[] =>
  Array.from({ length: 16 }, (_, i) =>
    [0, 1, 2, 3].reduce((sum, k) => sum + a[4 * (i >> 2) + k]! * b[4 * k + (i & 3)]!, 0),
  );
