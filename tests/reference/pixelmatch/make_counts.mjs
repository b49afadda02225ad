// Makes counts.csv: what npm's pixelmatch 7.2.0 says of pairs that this script and tests/support/picture_pairs.cpp make alike.
//   npm install pixelmatch@7.2.0 && node make_counts.mjs > counts.csv
import pixelmatch from "pixelmatch";

const PAIRS = 48;

/// Numerical Recipes' linear congruential generator; the upper 16 bits.
function generator(seed) {
  let state = seed >>> 0;
  return below => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return (state >>> 16) % below;
  };
}

/// A disc over a picture, antialiased with 4 × 4 samples; places and radius in quarters of a pixel.
function drawDisc(picture, disc) {
  const { width, height, pixels } = picture;
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      let hits = 0;
      for (let sy = 0; sy < 4; ++sy)
        for (let sx = 0; sx < 4; ++sx) {
          const dx = 4 * x + sx - disc.x;
          const dy = 4 * y + sy - disc.y;
          if (dx * dx + dy * dy <= disc.r * disc.r) ++hits;
        }
      if (hits === 0) continue;
      const at = 4 * (y * width + x);
      for (let c = 0; c < 4; ++c) pixels[at + c] += Math.trunc((disc.color[c] - pixels[at + c]) * hits / 16);
    }
  }
}

function makePair(number) {
  const random = generator(1000 + number);
  const width = 5 + random(60);
  const height = 5 + random(50);
  const picture = () => ({ width, height, pixels: new Uint8Array(4 * width * height) });
  const a = picture();
  const b = picture();
  const translucent = number % 4 === 3;
  const ground = [random(256), random(256), random(256), translucent ? random(256) : 255];
  for (const each of [a, b]) for (let i = 0; i < each.pixels.length; ++i) each.pixels[i] = ground[i % 4];
  const change = number % 6; // 0 moved, 1 recoloured, 2 noise, 3 missing, 4 lines, 5 alpha
  const discs = 1 + random(6);
  for (let i = 0; i < discs; ++i) {
    const disc = { x: random(4 * width), y: random(4 * height), r: 4 + random(48),
                   color: [random(256), random(256), random(256), translucent ? random(256) : 255] };
    drawDisc(a, disc);
    const other = { ...disc, color: [...disc.color] };
    if (change === 0) { other.x += random(9) - 4; other.y += random(9) - 4; }
    if (change === 1) for (let c = 0; c < 3; ++c) other.color[c] = Math.min(255, other.color[c] + random(80));
    if (change === 5) other.color[3] = Math.max(0, other.color[3] - random(128));
    if (change !== 3 || i > 0) drawDisc(b, other);
  }
  if (change === 2) for (let i = 0; i < b.pixels.length; ++i) b.pixels[i] = Math.min(255, b.pixels[i] + random(30));
  if (change === 4) {
    for (let line = 0; line < 6; ++line) {
      const y = random(height);
      for (let x = random(width); x < width; ++x)
        for (let c = 0; c < 3; ++c) b.pixels[4 * (y * width + x) + c] = 255 - b.pixels[4 * (y * width + x) + c];
    }
  }
  return [a, b];
}

/// FNV-1a of 32 bits, to see that both programs made the same pictures.
function hash(pixels) {
  let value = 2166136261;
  for (const byte of pixels) value = Math.imul(value ^ byte, 16777619) >>> 0;
  return value;
}

console.log("pair,width,height,hash_a,hash_b,threshold_0.1,threshold_0.1_includeAA");
for (let number = 0; number < PAIRS; ++number) {
  const [a, b] = makePair(number);
  const count = includeAA => pixelmatch(a.pixels, b.pixels, null, a.width, a.height, { threshold: 0.1, includeAA });
  console.log([number, a.width, a.height, hash(a.pixels), hash(b.pixels), count(false), count(true)].join(","));
}
