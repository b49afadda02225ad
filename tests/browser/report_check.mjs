// Looks at an HTML report as a person would, in headless Chromium: node report_check.mjs PLAYWRIGHT CHROMIUM FOLDER [SHOTS]
// PLAYWRIGHT: the folder of npm's playwright-core. With SHOTS, screenshots are left there. Exit status 0 when all holds.
import { createRequire } from "node:module";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [playwright, chromium, folder, shots] = process.argv.slice(2);
const { chromium: browserType } = createRequire(import.meta.url)(path.resolve(playwright));
const root = pathToFileURL(path.resolve(folder)).href + "/";
const problems = [];
let checks = 0;

function expect(what, found, wanted) {
  ++checks;
  if (JSON.stringify(found) !== JSON.stringify(wanted))
    problems.push(`${what}: ${JSON.stringify(found)}, wanted ${JSON.stringify(wanted)}`);
}

const browser = await browserType.launch({ executablePath: chromium, args: ["--no-sandbox"] });

async function open(options) {
  const context = await browser.newContext(options);
  const page = await context.newPage();
  page.on("console", message => { if (message.type() === "error") problems.push(`console: ${message.text()}`); });
  page.on("pageerror", error => problems.push(`page: ${error.message}`));
  page.on("request", request => {
    if (!request.url().startsWith(root) && !request.url().startsWith("data:")) problems.push(`request to ${request.url()}`);
  });
  await page.goto(root + "index.html");
  await page.waitForFunction(() => state.pictures !== null);
  return page;
}

const names = page => page.$$eval("#list li .label span:first-child", spans => spans.map(span => span.textContent));
const current = page => page.textContent("#name");
const pressed = page => page.textContent('#modes [aria-pressed="true"]');
/// The canvases' pixels as one number, to see that a picture changed.
const drawn = page => page.evaluate(() => [...document.querySelectorAll("#stage canvas")].map(canvas => {
  const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  let sum = 0;
  for (let i = 0; i < pixels.length; ++i) sum = (sum * 31 + pixels[i]) >>> 0;
  return sum;
}).join());

const page = await open({ viewport: { width: 1280, height: 900 }, colorScheme: "light" });
const report = await page.evaluate(() => report);
const bySeverity = await names(page);
expect("the list holds every case", bySeverity.length, report.cases.length);
const worst = [...report.cases].sort((a, b) => a.passed - b.passed || b.severity - a.severity)[0];
expect("worst first", bySeverity[0], worst.name);

// Keys.
await page.keyboard.press("ArrowDown");
expect("arrow down", await current(page), bySeverity[1]);
await page.keyboard.press("ArrowUp");
expect("arrow up", await current(page), bySeverity[0]);
await page.waitForFunction(() => state.pictures !== null);
const seen = [];
for (const [index, mode] of ["side by side", "slider", "blink", "overlay", "difference"].entries()) {
  await page.keyboard.press(String(index + 1));
  expect(`key ${index + 1}`, await pressed(page), mode);
  seen.push(await drawn(page));
}
expect("every view draws something else", new Set(seen).size, 5);

// Slider.
await page.keyboard.press("2");
const before = await drawn(page);
await page.$eval("#mix", slider => { slider.value = 90; slider.dispatchEvent(new Event("input")); });
expect("the slider moves", before !== await drawn(page), true);
const canvas = await page.$("#stage canvas");
await canvas.scrollIntoViewIfNeeded();
const box = await canvas.boundingBox();
await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
await page.mouse.down();
await page.mouse.move(box.x + box.width / 4, box.y + box.height / 2);
await page.mouse.up();
expect("the slider follows the pointer", await page.evaluate(() => state.mix < 0.5), true);

// Pixel values of both: those of the worst pixel.
const pixel = worst.worst[0];
await page.click("#worst tr[data-x]");
const line = await page.textContent("#pixel");
for (const values of [pixel.expected, pixel.actual])
  expect(`pixel values in "${line}"`, line.includes(values.join(" ")), true);
const scale = await page.evaluate(() => state.view.scale);
await page.keyboard.press("+");
expect("zoom", await page.evaluate(() => state.view.scale) > scale, true);
await page.keyboard.press("0");

// Filter and sort.
await page.fill("#filter", bySeverity[0]);
expect("filter by name", (await names(page)).every(name => name.includes(bySeverity[0])), true);
await page.fill("#filter", "");
await page.selectOption("#status", "failed");
expect("only failed ones", (await names(page)).length, report.cases.filter(one => !one.passed).length);
await page.selectOption("#status", "all");
await page.selectOption("#sort", "order");
expect("in order", await names(page), report.cases.map(one => one.name));
await page.selectOption("#sort", "severity");

// The curve leads to its frame.
if (report.curves.length > 0) {
  const svg = await page.$("#curve");
  await svg.scrollIntoViewIfNeeded();
  const curve = await svg.boundingBox();
  await page.mouse.click(curve.x + curve.width - 12, curve.y + curve.height / 2);
  expect("a click on the curve's end", await current(page), report.cases[report.cases.length - 1].name);
  await page.click("#list li button");
}

// Accepting.
const acceptable = report.cases.filter(one => one.accept);
if (acceptable.length > 1) {
  for (const input of (await page.$$("#list input")).slice(0, 2)) await input.check();
  const command = await page.textContent("#accept-command");
  const chosen = await page.evaluate(() => [...state.chosen].map(index => report.cases[index].accept.split(" ").pop()));
  expect(`both chosen ones in "${command}"`, chosen.every(word => command.includes(word)), true);
}

if (shots) {
  const shoot = async (which, file) => {
    await which.waitForFunction(() => state.pictures !== null);
    await which.screenshot({ path: path.join(shots, file), fullPage: file.includes("phone") });
  };
  await page.mouse.move(0, 0);
  await page.keyboard.press("Escape");
  await page.keyboard.press("1");
  await shoot(page, "light.png");
  await page.click("#worst tr[data-x]");
  await shoot(page, "zoom.png");
  await page.keyboard.press("0");
  for (const [key, name] of [["2", "slider"], ["4", "overlay"], ["5", "difference"]]) {
    await page.keyboard.press(key);
    await shoot(page, `${name}.png`);
  }
  await shoot(await open({ viewport: { width: 1280, height: 900 }, colorScheme: "dark" }), "dark.png");
}
// A phone: nothing is wider than the screen.
const phone = await open({ viewport: { width: 390, height: 844 }, colorScheme: "dark", hasTouch: true, isMobile: true, deviceScaleFactor: 2 });
expect("no sideways scrolling on a phone", await phone.evaluate(() => document.documentElement.scrollWidth), 390);
expect("dark when the system is", await phone.evaluate(() => document.documentElement.dataset.theme), "dark");
if (shots) await phone.screenshot({ path: path.join(shots, "phone.png"), fullPage: true });

await browser.close();
for (const problem of problems) console.error(problem);
console.log(`${checks} checks, ${problems.length} problems`);
process.exitCode = problems.length === 0 ? 0 : 1;
