"use strict";
// The report's one script. Everything it shows stands in the page; it asks for nothing.

const report = JSON.parse(document.getElementById("data").textContent);
const element = id => document.getElementById(id);
const MODES = ["side by side", "slider", "blink", "overlay", "difference"];
const BLINK_MS = 600;

const state = {
  shown: [],          // indices of report.cases in the list's order
  current: -1,        // index of the case on show
  mode: 0,
  chosen: new Set(),  // indices whose accept command is wanted
  pictures: null,     // decoded pictures of the case on show
  view: { scale: 1, x: 0, y: 0, fit: true },
  mix: 0.5,
  blink: false,       // the actual one is on show
};

// ---- small helpers

function make(tag, properties, ...children) {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
}

function text(number) {
  const value = number.value;
  const plain = v => v === null ? "infinite" : typeof v === "number" && !Number.isInteger(v) ? String(Number(v.toPrecision(6))) : String(v);
  return (Array.isArray(value) ? value.map(plain).join(", ") : plain(value)) + (number.unit ? " " + number.unit : "");
}

// ---- pictures: PNGs as Offstage writes them (8-bit RGB or RGBA, no filter, one IDAT), read exactly: a canvas would
// round the colours of what is not opaque.

async function decode(base64) {
  if (!base64) return null;
  const bytes = Uint8Array.from(atob(base64), c => c.charCodeAt(0));
  const words = new DataView(bytes.buffer);
  const width = words.getUint32(16);
  const height = words.getUint32(20);
  const channels = bytes[25] === 6 ? 4 : 3;
  let data = null;
  for (let at = 8; at + 8 <= bytes.length; at += 12 + words.getUint32(at)) {
    const type = String.fromCharCode(...bytes.subarray(at + 4, at + 8));
    if (type === "IDAT") data = bytes.subarray(at + 8, at + 8 + words.getUint32(at));
  }
  const stream = new Blob([data]).stream().pipeThrough(new DecompressionStream("deflate"));
  const rows = new Uint8Array(await new Response(stream).arrayBuffer());
  const image = new ImageData(width, height);
  const pixels = image.data;
  for (let y = 0, from = 0, to = 0; y < height; ++y) {
    ++from; // the filter, always none
    for (let x = 0; x < width; ++x, to += 4) {
      pixels[to] = rows[from++];
      pixels[to + 1] = rows[from++];
      pixels[to + 2] = rows[from++];
      pixels[to + 3] = channels === 4 ? rows[from++] : 255;
    }
  }
  const canvas = make("canvas", { width, height });
  canvas.getContext("2d").putImageData(image, 0, 0);
  return { width, height, pixels, canvas };
}

function pixelOf(picture, x, y) {
  if (!picture || x < 0 || y < 0 || x >= picture.width || y >= picture.height) return null;
  return Array.from(picture.pixels.subarray(4 * (y * picture.width + x), 4 * (y * picture.width + x) + 4));
}

// ---- the stage

function panes() {
  const p = state.pictures;
  if (!p) return [];
  if (state.mode === 0) {
    return [["expected", [[p.expected, 1]]], ["difference", [[p.difference, 1]]], ["actual", [[p.actual, 1]]]]
      .filter(([, layers]) => layers[0][0]);
  }
  if (state.mode === 1) return [["expected | actual", [[p.expected, 1], [p.actual, 1, true]]]];
  if (state.mode === 2) return [[state.blink ? "actual" : "expected", [[state.blink ? p.actual : p.expected, 1]]]];
  if (state.mode === 3) return [["expected under actual", [[p.expected, 1], [p.actual, state.mix]]]];
  return [["difference: violet a little, red as much as can be, yellow forgiven", [[p.difference, 1]]]];
}

function wholeSize() {
  const all = state.pictures ? Object.values(state.pictures).filter(Boolean) : [];
  return [Math.max(1, ...all.map(p => p.width)), Math.max(1, ...all.map(p => p.height))];
}

function layOut() {
  const list = panes();
  element("stage").classList.toggle("many", list.length > 1);
  element("stage").replaceChildren(...list.map(([title], index) => {
    const canvas = make("canvas", { tabIndex: -1 });
    canvas.dataset.pane = index;
    watchPointer(canvas);
    return make("figure", {}, make("figcaption", { textContent: title }), canvas);
  }));
  element("mix-label").hidden = state.mode !== 1 && state.mode !== 3;
  element("mix-label").style.display = element("mix-label").hidden ? "none" : "";
  draw();
}

function draw() {
  const canvases = document.querySelectorAll("#stage canvas");
  const list = panes();
  const [width, height] = wholeSize();
  canvases.forEach((canvas, index) => {
    const ratio = window.devicePixelRatio || 1;
    canvas.style.aspectRatio = `${width} / ${height}`; // a wide picture leaves no room below it
    const box = canvas.getBoundingClientRect();
    canvas.width = Math.max(1, Math.round(box.width * ratio));
    canvas.height = Math.max(1, Math.round(box.height * ratio));
    const view = state.view;
    if (view.fit) {
      view.scale = Math.min(box.width / width, box.height / height);
      if (view.scale > 1) view.scale = Math.floor(view.scale);
      view.x = width / 2;
      view.y = height / 2;
    }
    const [title, layers] = list[index];
    canvas.previousSibling.textContent = title;
    const context = canvas.getContext("2d");
    context.imageSmoothingEnabled = view.scale * ratio < 1;
    const scale = view.scale * ratio;
    const left = Math.round(canvas.width / 2 - view.x * scale);
    const top = Math.round(canvas.height / 2 - view.y * scale);
    for (const [picture, opacity, split] of layers) {
      if (!picture) continue;
      context.save();
      if (split) {
        const edge = left + state.mix * width * scale;
        context.beginPath();
        context.rect(edge, 0, canvas.width, canvas.height);
        context.clip();
        context.clearRect(0, 0, canvas.width, canvas.height);
      }
      context.globalAlpha = opacity;
      context.drawImage(picture.canvas, left, top, picture.width * scale, picture.height * scale);
      context.restore();
      if (split) {
        context.fillStyle = "#ff2d87";
        context.fillRect(Math.round(left + state.mix * width * scale) - 1, 0, 2, canvas.height);
      }
    }
  });
}

function placeOf(canvas, event) {
  const box = canvas.getBoundingClientRect();
  const { scale, x, y } = state.view;
  return [Math.floor((event.clientX - box.left - box.width / 2) / scale + x),
          Math.floor((event.clientY - box.top - box.height / 2) / scale + y)];
}

function showPixel(x, y) {
  const p = state.pictures;
  const line = element("pixel");
  const expected = p && pixelOf(p.expected, x, y);
  const actual = p && pixelOf(p.actual, x, y);
  if (!expected && !actual) return;
  const parts = [`${x}, ${y}`];
  for (const [name, color] of [["expected", expected], ["actual", actual]]) {
    const swatch = make("span", { className: "swatch" });
    if (color) swatch.style.background = `rgb(${color[0]} ${color[1]} ${color[2]} / ${color[3] / 255})`;
    parts.push(swatch, `${name} ${color ? color.join(" ") : "none"}`);
  }
  if (expected && actual) parts.push(`  off by ${Math.max(...expected.map((v, c) => Math.abs(v - actual[c])))}`);
  line.replaceChildren(...parts);
}

function watchPointer(canvas) {
  let drag = null;
  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    drag = { x: event.clientX, y: event.clientY, moved: false };
    const [x, y] = placeOf(canvas, event);
    showPixel(x, y);
    if (state.mode === 1) slideTo(canvas, event);
  });
  canvas.addEventListener("pointermove", event => {
    if (drag && state.mode === 1) {
      slideTo(canvas, event);
    } else if (drag) {
      state.view.x -= (event.clientX - drag.x) / state.view.scale;
      state.view.y -= (event.clientY - drag.y) / state.view.scale;
      state.view.fit = false;
      Object.assign(drag, { x: event.clientX, y: event.clientY });
      draw();
    }
    showPixel(...placeOf(canvas, event));
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => { drag = null; });
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    const before = placeExactly(canvas, event);
    zoom(event.deltaY < 0 ? 1.25 : 0.8);
    const after = placeExactly(canvas, event);
    state.view.x += before[0] - after[0];
    state.view.y += before[1] - after[1];
    draw();
  }, { passive: false });
}

function placeExactly(canvas, event) {
  const box = canvas.getBoundingClientRect();
  return [(event.clientX - box.left - box.width / 2) / state.view.scale + state.view.x,
          (event.clientY - box.top - box.height / 2) / state.view.scale + state.view.y];
}

function slideTo(canvas, event) {
  setMix(placeExactly(canvas, event)[0] / wholeSize()[0]);
}

function setMix(share) {
  state.mix = Math.min(1, Math.max(0, share));
  element("mix").value = Math.round(100 * state.mix);
  draw();
}

function zoom(factor) {
  state.view.fit = false;
  state.view.scale = Math.min(64, Math.max(0.02, state.view.scale * factor));
  draw();
}

function fit() {
  state.view.fit = true;
  draw();
}

function lookAt(x, y) {
  Object.assign(state.view, { fit: false, scale: 16, x: x + 0.5, y: y + 0.5 });
  draw();
  element("viewer").scrollIntoView({ block: "nearest" });
  showPixel(x, y);
}

function setMode(mode) {
  state.mode = mode;
  state.blink = false;
  document.querySelectorAll("#modes button").forEach((button, index) => {
    button.setAttribute("aria-pressed", String(index === mode));
  });
  layOut();
}

// ---- curves

function drawCurve(svg, curve, failed, here, choose) {
  const width = Math.max(200, svg.getBoundingClientRect().width || 600);
  const height = 130;
  const pad = { left: 62, right: 10, top: 10, bottom: 20 };
  const values = curve.values.filter(v => v !== null);
  const low = Math.min(0, ...values);
  const high = Math.max(low + 1e-12, ...values);
  const first = curve.times[0] ?? 0;
  const last = curve.times[curve.times.length - 1] ?? 1;
  const x = time => pad.left + (width - pad.left - pad.right) * (last > first ? (time - first) / (last - first) : 0.5);
  const y = value => height - pad.bottom - (height - pad.top - pad.bottom) * (value - low) / (high - low);
  const node = (tag, attributes, content = "") => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.textContent = content;
    return made;
  };
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  let path = "";
  curve.values.forEach((value, i) => {
    if (value === null) return;
    path += `${path && curve.values[i - 1] !== null ? "L" : "M"}${x(curve.times[i]).toFixed(1)} ${y(value).toFixed(1)}`;
  });
  const short = v => Number(v.toPrecision(4)).toString();
  svg.replaceChildren(
    node("text", { x: 4, y: pad.top + 8 }, short(high)), node("text", { x: 4, y: height - pad.bottom }, short(low)),
    node("text", { x: 4, y: (height - pad.bottom + pad.top + 8) / 2 }, curve.unit),
    node("text", { x: pad.left, y: height - 5 }, short(first)),
    node("text", { x: width - pad.right, y: height - 5, "text-anchor": "end" }, short(last)),
    node("path", { d: path, class: "values" }));
  for (const i of failed) {
    if (curve.values[i] === undefined) continue;
    svg.append(node("circle", { cx: x(curve.times[i]), cy: curve.values[i] === null ? pad.top : y(curve.values[i]),
                                r: 2.5, class: "failed" }));
  }
  if (here !== null && curve.times[here] !== undefined)
    svg.append(node("line", { x1: x(curve.times[here]), x2: x(curve.times[here]), y1: pad.top, y2: height - pad.bottom,
                              class: "here" }));
  svg.onclick = event => {
    const at = (event.clientX - svg.getBoundingClientRect().left) / svg.getBoundingClientRect().width * width;
    let nearest = 0;
    curve.times.forEach((time, i) => { if (Math.abs(x(time) - at) < Math.abs(x(curve.times[nearest]) - at)) nearest = i; });
    if (choose) choose(nearest);
  };
}

const frameOf = one => one.numbers.find(number => number.key === "frame")?.value ?? null;

function drawSequence() {
  if (!report.curves.length) return;
  const curve = report.curves[Number(element("curve-choice").value) || 0];
  const failed = report.cases.filter(one => !one.passed).map(frameOf).filter(frame => frame !== null);
  const here = state.current >= 0 ? frameOf(report.cases[state.current]) : null;
  drawCurve(element("curve"), curve, failed, here, chooseFrame);
}

/// The listed case nearest to a frame.
function chooseFrame(frame) {
  let best = -1;
  report.cases.forEach((one, index) => {
    if (best < 0 || Math.abs(frameOf(one) - frame) < Math.abs(frameOf(report.cases[best]) - frame)) best = index;
  });
  if (best >= 0) select(best);
}

// ---- the list

function refreshList() {
  const words = element("filter").value.toLowerCase();
  const status = element("status").value;
  const order = element("sort").value;
  state.shown = report.cases.map((_, index) => index).filter(index => {
    const one = report.cases[index];
    return one.name.toLowerCase().includes(words) && (status === "all" || one.passed === (status === "passed"));
  });
  if (order === "severity")
    state.shown.sort((a, b) => report.cases[a].passed - report.cases[b].passed ||
                               report.cases[b].severity - report.cases[a].severity || a - b);
  if (order === "name") state.shown.sort((a, b) => report.cases[a].name.localeCompare(report.cases[b].name, "en", { numeric: true }));
  const failed = report.cases.filter(one => !one.passed).length;
  element("count").textContent = `${state.shown.length} of ${report.cases.length} listed, ${failed} failed`;
  const worst = Math.max(1e-9, ...report.cases.map(one => one.severity));
  element("list").replaceChildren(...state.shown.map(index => {
    const one = report.cases[index];
    const bar = make("div", { className: "bar" });
    bar.style.width = `${one.passed ? 0 : Math.max(2, 100 * one.severity / worst)}%`;
    const button = make("button", { type: "button", title: one.name },
      make("div", { className: "label" }, make("span", { textContent: one.name }),
        make("span", { className: `badge ${one.passed ? "good" : "bad"}`, textContent: one.verdict })), bar);
    button.addEventListener("click", () => select(index));
    const item = make("li", { className: index === state.current ? "here" : "" });
    item.dataset.index = index;
    if (one.accept) {
      const box = make("input", { type: "checkbox", checked: state.chosen.has(index), title: "choose for accepting" });
      box.setAttribute("aria-label", `choose ${one.name}`);
      box.addEventListener("change", () => choose(index, box.checked));
      item.append(box);
    }
    item.append(button);
    return item;
  }));
}

function step(by) {
  if (!state.shown.length) return;
  const at = state.shown.indexOf(state.current);
  select(state.shown[at < 0 ? 0 : Math.min(state.shown.length - 1, Math.max(0, at + by))]);
}

function choose(index, on) {
  if (on) state.chosen.add(index); else state.chosen.delete(index);
  showAccept();
}

/// Commands that differ in their last word only become one.
function showAccept() {
  const one = report.cases[state.current];
  const chosen = [...state.chosen].sort((a, b) => a - b);
  const wanted = (chosen.length ? chosen : one && !one.passed ? [state.current] : []).filter(index => report.cases[index].accept);
  element("accept").hidden = wanted.length === 0;
  const parts = wanted.map(index => report.cases[index].accept.match(/^(.*\s)('[^']*'|\S+)$/s));
  const together = parts.every(part => part && part[1] === parts[0][1]);
  element("accept-what").textContent = wanted.length === 1 ? report.cases[wanted[0]].name : `${wanted.length} chosen ones`;
  element("accept-command").textContent =
    wanted.length === 0 ? "" : together ? parts[0][1] + parts.map(part => part[2]).join(" ")
                                        : wanted.map(index => report.cases[index].accept).join("\n");
}

// ---- one case

async function select(index) {
  state.current = index;
  const one = report.cases[index];
  document.querySelectorAll("#list li").forEach(item => {
    const here = Number(item.dataset.index) === index;
    item.classList.toggle("here", here);
    if (here) item.scrollIntoView({ block: "nearest" });
  });
  element("name").textContent = one.name;
  const own = one.tolerance && one.tolerance !== report.tolerance ? [`tolerance: ${one.tolerance}`] : [];
  element("lines").replaceChildren(...one.lines.concat(own).map(line => make("li", { textContent: line })));
  element("numbers").replaceChildren(...one.numbers.filter(number => number.label).map(number =>
    make("tr", {}, make("th", { scope: "row", textContent: number.label }), make("td", { textContent: text(number) }))));
  showWorst(one);
  element("case-curves").replaceChildren(...one.curves.map(curve => {
    const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    svg.setAttribute("class", "curve");
    requestAnimationFrame(() => drawCurve(svg, curve, [], null, null));
    return make("div", {}, make("p", { textContent: curve.name }), svg);
  }));
  showAccept();
  drawSequence();
  element("pixel").textContent = "Point at a pixel to read both of its values.";
  state.pictures = null;
  const set = one.pictures[0];
  element("viewer").hidden = !set;
  if (!set) return;
  const [expected, difference, actual] = await Promise.all([set.expected, set.difference, set.actual].map(decode));
  if (state.current !== index) return; // another one was chosen meanwhile
  state.pictures = { expected, difference, actual };
  state.view.fit = true;
  layOut();
}

function showWorst(one) {
  const color = values => values.slice(0, values[3] === 255 ? 3 : 4).map(v => Number(v.toPrecision(5))).join(" ");
  const rows = one.worst.map(pixel => {
    const row = make("tr", { title: "look at it" }, make("td", { textContent: `${pixel.x}, ${pixel.y}` }),
      make("td", { textContent: color(pixel.expected) }), make("td", { textContent: color(pixel.actual) }),
      make("td", { textContent: Number(pixel.difference.toPrecision(5)) }));
    row.dataset.x = pixel.x;
    row.addEventListener("click", () => lookAt(pixel.x, pixel.y));
    return row;
  });
  const head = make("tr", {}, ...["worst pixels", "expected", "actual", "off by"].map(textContent => make("th", { textContent })));
  element("worst").replaceChildren(...(rows.length ? [head, ...rows] : []));
}

// ---- keys and start

function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
}

function onKey(event) {
  const typing = ["INPUT", "SELECT", "TEXTAREA"].includes(event.target.tagName) && event.target.type !== "checkbox";
  if (event.key === "Escape") event.target.blur();
  if (typing || event.ctrlKey || event.metaKey || event.altKey) return;
  const actions = {
    ArrowDown: () => step(1), ArrowRight: () => step(1), ArrowUp: () => step(-1), ArrowLeft: () => step(-1),
    "+": () => zoom(1.5), "=": () => zoom(1.5), "-": () => zoom(1 / 1.5), 0: fit,
    o: () => zoom(1 / state.view.scale), t: () => element("theme").click(), "/": () => element("filter").focus(),
    " ": () => { state.blink = !state.blink; draw(); },
    x: () => {
      if (!report.cases[state.current]?.accept) return;
      choose(state.current, !state.chosen.has(state.current));
      refreshList();
    },
  };
  MODES.forEach((_, index) => { actions[index + 1] = () => setMode(index); });
  const action = actions[event.key];
  if (!action || (event.key === " " && event.target.tagName === "BUTTON")) return;
  event.preventDefault();
  action();
}

function start() {
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  setTheme(dark.matches ? "dark" : "light");
  dark.addEventListener("change", () => setTheme(dark.matches ? "dark" : "light"));
  element("theme").addEventListener("click", () => setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark"));
  element("title").textContent = report.title;
  element("verdict").textContent = report.verdict;
  element("verdict").className = report.passed ? "good" : "bad";
  element("tolerance").textContent = `Tolerance: ${report.tolerance}`;
  element("summary").replaceChildren(...report.lines.map(line => make("li", { textContent: line })));
  element("modes").replaceChildren(...MODES.map((name, index) => {
    const button = make("button", { type: "button", title: `key ${index + 1}`, textContent: name });
    button.setAttribute("aria-pressed", String(index === 0));
    button.addEventListener("click", () => setMode(index));
    return button;
  }));
  element("sequence").hidden = report.curves.length === 0;
  element("curve-choice").replaceChildren(...report.curves.map((curve, index) => make("option", { value: index, textContent: curve.name })));
  element("curve-choice").addEventListener("change", drawSequence);
  for (const id of ["filter", "status", "sort"]) element(id).addEventListener("input", refreshList);
  element("mix").addEventListener("input", () => setMix(element("mix").value / 100));
  element("zoom-in").addEventListener("click", () => zoom(1.5));
  element("zoom-out").addEventListener("click", () => zoom(1 / 1.5));
  element("zoom-fit").addEventListener("click", fit);
  element("zoom-one").addEventListener("click", () => zoom(1 / state.view.scale));
  element("accept-copy").addEventListener("click", copyCommand);
  document.addEventListener("keydown", onKey);
  window.addEventListener("resize", () => { draw(); drawSequence(); });
  const still = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
  setInterval(() => {
    if (state.mode !== 2 || still) return;
    state.blink = !state.blink;
    draw();
  }, BLINK_MS);
  refreshList();
  if (state.shown.length) select(state.shown[0]);
  drawSequence();
}

async function copyCommand() {
  const command = element("accept-command").textContent;
  try {
    await navigator.clipboard.writeText(command);
  } catch {
    // Pages from disk may not write to the clipboard: select it instead.
    getSelection().selectAllChildren(element("accept-command"));
    document.execCommand("copy");
  }
  element("accept-copy").textContent = "copied";
  setTimeout(() => { element("accept-copy").textContent = "copy"; }, 1500);
}

start();
