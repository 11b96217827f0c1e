// Pictures of models without a browser: triangles of nodes into a depth buffer, edges dark, a PNG. One direction of view for
// all, from the front, the model's left and above; parts keep their colour from picture to picture by their name.
import { deflateSync } from 'node:zlib';

const azimuth = 0.62;
const elevation = 0.36;
/** Samples a pixel has along each side. */
const samples = 2;

const [sa, ca, se, ce] = [Math.sin(azimuth), Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation)];
/** → [right, up, towards the eye] */
const turned = ([x, y, z]) => {
  const depth = z * ca + x * sa;
  return [x * ca - z * sa, y * ce - depth * se, depth * ce + y * se];
};

/** The frame that holds all of `models` (Maps of readNodes()): {low: [right, up], size}. */
export function frameOf(models) {
  const all = models.flatMap((nodes) => [...nodes.values()].flatMap(({ points }) => points.map(turned)));
  const low = [0, 1].map((k) => all.reduce((best, p) => Math.min(best, p[k]), Infinity));
  const high = [0, 1].map((k) => all.reduce((best, p) => Math.max(best, p[k]), -Infinity));
  const size = Math.max(high[0] - low[0], high[1] - low[1]) * 1.06;
  return { low: [0, 1].map((k) => (low[k] + high[k] - size) / 2), size };
}

/** A colour by a name, its number aside: [red, green, blue] from 0 to 255. */
function colourOf(name) {
  let hash = 2166136261;
  for (const char of name.replace(/[ _.]\d+$/, '')) hash = Math.imul(hash ^ char.charCodeAt(0), 16777619) >>> 0;
  const hue = ((hash % 360) / 360) * 6;
  const channel = (shift) => Math.max(0, Math.min(1, Math.abs(((hue + shift) % 6) - 3) - 1));
  return [0, 4, 2].map((shift) => 128 + 110 * channel(shift));
}

/** @returns {colours, owners} of side² samples; whoever looks the same way of one node has one owner */
function rasterise(nodes, { low, size }, side) {
  const colours = new Uint8Array(side * side * 3).fill(250);
  const depths = new Float64Array(side * side).fill(-Infinity);
  const owners = new Int32Array(side * side).fill(-1);
  const scale = side / size;
  let owner = 0;
  for (const { name, points, triangles } of nodes.values()) {
    const colour = colourOf(name);
    const seen = points.map(turned).map(([x, y, z]) => [(x - low[0]) * scale, side - (y - low[1]) * scale, z * scale]);
    for (let t = 0; t < triangles.length; t += 3) {
      const [a, b, c] = [0, 1, 2].map((i) => seen[triangles[t + i]]);
      const u = b.map((v, k) => v - a[k]);
      const v = c.map((w, k) => w - a[k]);
      const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      const length = Math.hypot(...normal);
      if (Math.abs(normal[2]) < 1e-9 || length < 1e-12) continue;
      const towards = Math.sign(normal[2]) / length;
      // Light comes from above the left shoulder; up on the picture is -y here.
      const light = 0.55 + 0.45 * Math.max(0, (normal[2] * 0.72 - normal[1] * 0.6 - normal[0] * 0.34) * towards);
      // Faces that look elsewhere are told apart for the edges.
      const facing = Math.round(4 * normal[0] * towards) * 9 + Math.round(4 * normal[1] * towards);
      const [left, right] = [Math.min(a[0], b[0], c[0]), Math.max(a[0], b[0], c[0])];
      const [top, bottom] = [Math.min(a[1], b[1], c[1]), Math.max(a[1], b[1], c[1])];
      for (let y = Math.max(0, Math.floor(top)); y <= Math.min(side - 1, bottom); ++y) {
        for (let x = Math.max(0, Math.floor(left)); x <= Math.min(side - 1, right); ++x) {
          const [px, py] = [x + 0.5 - a[0], y + 0.5 - a[1]];
          const s = (px * v[1] - py * v[0]) / normal[2];
          const r = (u[0] * py - u[1] * px) / normal[2];
          if (s < 0 || r < 0 || s + r > 1) continue;
          const depth = a[2] + s * u[2] + r * v[2];
          const at = y * side + x;
          if (depth <= depths[at]) continue;
          depths[at] = depth;
          owners[at] = owner * 1000 + facing;
          for (let k = 0; k < 3; ++k) colours[3 * at + k] = colour[k] * light;
        }
      }
    }
    owner++;
  }
  return { colours, owners };
}

const crcTable = Int32Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let bit = 0; bit < 8; ++bit) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c;
});
const crc32 = (bytes) => ~bytes.reduce((crc, byte) => crcTable[(crc ^ byte) & 255] ^ (crc >>> 8), -1) >>> 0;

function chunk(type, body) {
  const out = Buffer.alloc(body.length + 12);
  out.writeUInt32BE(body.length, 0);
  out.write(type, 4, 'latin1');
  body.copy(out, 8);
  out.writeUInt32BE(crc32(out.subarray(4, body.length + 8)), body.length + 8);
  return out;
}

/** @param pixels width × height × 3 bytes. @returns a PNG */
export function png(pixels, width, height) {
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([8, 2, 0, 0, 0], 8);
  const rows = Buffer.alloc(height * (width * 3 + 1));
  for (let y = 0; y < height; ++y)
    rows.set(pixels.subarray(y * width * 3, (y + 1) * width * 3), y * (width * 3 + 1) + 1);
  const signature = Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]);
  const body = deflateSync(rows, { level: 9 });
  return Buffer.concat([signature, chunk('IHDR', header), chunk('IDAT', body), chunk('IEND', Buffer.alloc(0))]);
}

/** @param nodes of readNodes(). @param frame of frameOf(). @returns side² pixels of three bytes */
export function draw(nodes, frame, side) {
  const fine = side * samples;
  const { colours, owners } = rasterise(nodes, frame, fine);
  const pixels = new Uint8Array(side * side * 3);
  for (let y = 0; y < side; ++y) {
    for (let x = 0; x < side; ++x) {
      const sum = [0, 0, 0];
      for (let i = 0; i < samples * samples; ++i) {
        const at = (y * samples + Math.floor(i / samples)) * fine + x * samples + (i % samples);
        const [right, below] = [owners[at + 1] ?? -1, owners[at + fine] ?? -1];
        const isEdge = owners[at] !== right || owners[at] !== below;
        for (let k = 0; k < 3; ++k) sum[k] += colours[3 * at + k] * (isEdge ? 0.4 : 1);
      }
      for (let k = 0; k < 3; ++k) pixels[3 * (y * side + x) + k] = sum[k] / (samples * samples);
    }
  }
  return pixels;
}
