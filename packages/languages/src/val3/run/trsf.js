export const NOTHING = { mm: [0, 0, 0], wxyz: [1, 0, 0, 0] };
const product = ([a, b, c, d], [e, f, g, h]) => [a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e];
const turned = (q, [x, y, z]) => {
    const [, i, j, k] = product(product(q, [0, x, y, z]), [q[0], -q[1], -q[2], -q[3]]);
    return [i, j, k];
};
/** Turned by rx about x, then by ry about the new y, then by rz about the newest z. */
export function fromSix([x, y, z, rx, ry, rz]) {
    const half = (angle_deg) => [Math.cos(angle_deg * Math.PI / 360), Math.sin(angle_deg * Math.PI / 360)], [cx, sx] = half(rx), [cy, sy] = half(ry), [cz, sz] = half(rz);
    return { mm: [x, y, z], wxyz: product(product([cx, sx, 0, 0], [cy, 0, sy, 0]), [cz, 0, 0, sz]) };
}
export function times(a, b) {
    const [x, y, z] = turned(a.wxyz, b.mm);
    return { mm: [a.mm[0] + x, a.mm[1] + y, a.mm[2] + z], wxyz: product(a.wxyz, b.wxyz) };
}
export function inverted({ mm, wxyz: [w, x, y, z] }) {
    const back = [w, -x, -y, -z], [a, b, c] = turned(back, mm);
    return { mm: [-a, -b, -c], wxyz: back };
}
export const toPose = ({ mm, wxyz: [w, x, y, z] }) => ({ position: [mm[0] / 1000, mm[1] / 1000, mm[2] / 1000], quaternion: [x, y, z, w] });
export const fromPose = ({ position: [x, y, z], quaternion: [a, b, c, d] }) => ({ mm: [x * 1000, y * 1000, z * 1000], wxyz: [d, a, b, c] });
