export const NOTHING = { rows: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], mm: [0, 0, 0] };
/** X, Y, Z, W, P, R: turned by W about x, then by P about the y and by R about the z that stay where they are. */
export function fromSix([x, y, z, w, p, r]) {
    const turn = (angle_deg) => { const angle = angle_deg * Math.PI / 180; return [Math.cos(angle), Math.sin(angle)]; };
    const [cw, sw] = turn(w), [cp, sp] = turn(p), [cr, sr] = turn(r);
    return {
        mm: [x, y, z],
        rows: [
            [cr * cp, cr * sp * sw - sr * cw, cr * sp * cw + sr * sw],
            [sr * cp, sr * sp * sw + cr * cw, sr * sp * cw - cr * sw],
            [-sp, cp * sw, cp * cw],
        ],
    };
}
/** X, Y, Z, W, P, R of a pose, W 0 where P is upright. */
export function toSix({ rows: [a, b, c], mm }) {
    const deg = (y, x) => Math.atan2(y, x) * 180 / Math.PI, flat = Math.hypot(a[0], b[0]), p = deg(-c[0], flat);
    return flat < 1e-9 ? [...mm, 0, p, deg(-a[1], b[1])] : [...mm, deg(c[1], c[2]), p, deg(b[0], a[0])];
}
const times3 = (rows, [x, y, z]) => {
    const [a, b, c] = rows;
    return [a[0] * x + a[1] * y + a[2] * z, b[0] * x + b[1] * y + b[2] * z, c[0] * x + c[1] * y + c[2] * z];
};
const column = (rows, i) => [rows[0][i], rows[1][i], rows[2][i]];
export function times(a, b) {
    const [x, y, z] = times3(a.rows, b.mm), [i, j, k] = [0, 1, 2].map(n => times3(a.rows, column(b.rows, n)));
    return { mm: [a.mm[0] + x, a.mm[1] + y, a.mm[2] + z], rows: [0, 1, 2].map(n => [i[n], j[n], k[n]]) };
}
export function inverted({ rows, mm }) {
    const back = [0, 1, 2].map(n => column(rows, n)), [x, y, z] = times3(back, mm);
    return { rows: back, mm: [-x, -y, -z] };
}
/** In metres with a quaternion, for the rest of the world. */
export function toPose({ rows: [a, b, c], mm: [x, y, z] }) {
    const [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = [a, b, c], four = [1 + xx + yy + zz, 1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz], most = four.indexOf(Math.max(...four));
    const s = 2 * Math.sqrt(four[most]);
    const wxyz = most === 0 ? [s / 4, (zy - yz) / s, (xz - zx) / s, (yx - xy) / s]
        : most === 1 ? [(zy - yz) / s, s / 4, (xy + yx) / s, (xz + zx) / s]
            : most === 2 ? [(xz - zx) / s, (xy + yx) / s, s / 4, (yz + zy) / s] : [(yx - xy) / s, (xz + zx) / s, (yz + zy) / s, s / 4];
    return { position: [x / 1000, y / 1000, z / 1000], quaternion: [wxyz[1], wxyz[2], wxyz[3], wxyz[0]] };
}
export function fromPose({ position: [x, y, z], quaternion: [i, j, k, w] }) {
    return {
        mm: [x * 1000, y * 1000, z * 1000],
        rows: [
            [1 - 2 * (j * j + k * k), 2 * (i * j - k * w), 2 * (i * k + j * w)],
            [2 * (i * j + k * w), 1 - 2 * (i * i + k * k), 2 * (j * k - i * w)],
            [2 * (i * k - j * w), 2 * (j * k + i * w), 1 - 2 * (i * i + j * j)],
        ],
    };
}
