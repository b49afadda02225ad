// Writes two photograph-like PNGs (RGB, every pixel different from its neighbours, filter Paeth as photographs get it), the
// second a little brighter and noisier than the first: node make_photo.mjs SIZE A.png B.png
import { writeFileSync } from "node:fs";
import zlib from "node:zlib";

const [size, ...files] = process.argv.slice(2);
const n = Number(size);

function crc(bytes) {
  if (zlib.crc32) return zlib.crc32(bytes); // Node 20.15 and later
  let value = 0xffffffff;
  for (const byte of bytes) {
    value ^= byte;
    for (let bit = 0; bit < 8; ++bit) value = (value >>> 1) ^ (value & 1 ? 0xedb88320 : 0);
  }
  return (value ^ 0xffffffff) >>> 0;
}

function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type, "latin1"), data]);
  const out = Buffer.alloc(body.length + 8);
  out.writeUInt32BE(data.length, 0);
  body.copy(out, 4);
  out.writeUInt32BE(crc(body), body.length + 4);
  return out;
}

function picture(second) {
  const stride = 3 * n;
  const rows = Buffer.alloc((stride + 1) * n);
  let above = Buffer.alloc(stride);
  let state = 12345 + second;
  const noise = () => ((state = (Math.imul(state, 1664525) + 1013904223) >>> 0) >>> 24) % 12;
  for (let y = 0; y < n; ++y) {
    const row = Buffer.alloc(stride);
    for (let x = 0; x < n; ++x) {
      const wave = 60 * Math.sin(x / 37 + y / 91) + 40 * Math.sin(x / 7.3) * Math.cos(y / 11.1);
      for (let c = 0; c < 3; ++c) row[3 * x + c] = 110 + wave * (1 - 0.2 * c) + noise() + (second ? 3 : 0);
    }
    const at = y * (stride + 1);
    rows[at] = 4;
    for (let i = 0; i < stride; ++i) {
      const a = i >= 3 ? row[i - 3] : 0;
      const b = above[i];
      const c = i >= 3 ? above[i - 3] : 0;
      const p = a + b - c;
      const pa = Math.abs(p - a);
      const pb = Math.abs(p - b);
      const pc = Math.abs(p - c);
      rows[at + 1 + i] = row[i] - (pa <= pb && pa <= pc ? a : pb <= pc ? b : c);
    }
    above = row;
  }
  const header = Buffer.alloc(13);
  header.writeUInt32BE(n, 0);
  header.writeUInt32BE(n, 4);
  header.set([8, 2, 0, 0, 0], 8);
  return Buffer.concat([Buffer.from([0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10]), chunk("IHDR", header),
                        chunk("IDAT", zlib.deflateSync(rows, { level: 6 })), chunk("IEND", Buffer.alloc(0))]);
}

files.forEach((file, index) => writeFileSync(file, picture(index)));
