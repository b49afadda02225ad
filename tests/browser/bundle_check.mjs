// Plays a bundle's page as a student would, in headless Chromium: node bundle_check.mjs PLAYWRIGHT CHROMIUM FOLDER [SHOT]
// PLAYWRIGHT: the folder of npm's playwright-core. With SHOT, a screenshot is left there. Exit status 0 when all holds.
import { createRequire } from "node:module";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [playwright, chromium, folder, shot] = process.argv.slice(2);
const { chromium: browserType } = createRequire(import.meta.url)(path.resolve(playwright));
const root = pathToFileURL(path.resolve(folder)).href + "/";
const problems = [];

function expect(what, found, wanted) {
  if (JSON.stringify(found) !== JSON.stringify(wanted))
    problems.push(`${what}: ${JSON.stringify(found)}, wanted ${JSON.stringify(wanted)}`);
}

const browser = await browserType.launch({ executablePath: chromium, args: ["--no-sandbox", "--autoplay-policy=no-user-gesture-required"] });
const page = await browser.newPage({ viewport: { width: 900, height: 900 } });
page.on("console", message => { if (message.type() === "error") problems.push(`console: ${message.text()}`); });
page.on("pageerror", error => problems.push(`page: ${error.message}`));
page.on("request", request => { if (!request.url().startsWith(root)) problems.push(`request to ${request.url()}`); });
await page.goto(root + "index.html");

expect("title", await page.title(), 'A "bundle" <b>');
await page.waitForFunction(() => video.readyState >= 2, null, { timeout: 20000 });
expect("size", await page.evaluate(() => [video.videoWidth, video.videoHeight]), [128, 96]);
expect("length", await page.evaluate(() => Math.round(video.duration * 10) / 10), 2);
const texts = id => page.$$eval(`#${id} li button`, buttons => buttons.map(button => button.textContent));
expect("chapters", await texts("chapters"), ["0:00Start", "0:01</script>"]);
expect("captions", await texts("captions"), ["0:00falls & falls", "0:00bounces"]);

// It plays, and shows each caption when its time has come.
await page.evaluate(() => video.play());
await page.waitForFunction(() => video.currentTime > 0.2, null, { timeout: 20000 });
const shown = () => page.evaluate(() =>
  [...video.textTracks].filter(track => track.mode === "showing").flatMap(track => [...track.activeCues].map(cue => cue.text)));
await page.evaluate(() => video.pause());
await page.evaluate(() => new Promise(done => { video.onseeked = done; video.currentTime = 0.5; }));
await page.waitForTimeout(300);
expect("the first caption", await shown(), ["falls &amp; falls"]);
await page.click("#chapters li:nth-child(2) button");
await page.waitForTimeout(500);
expect("a chapter's button goes there", await page.evaluate(() => video.currentTime), 1);
expect("the second caption", await shown(), ["bounces"]);
expect("the list marks the chapter", await page.getAttribute("#chapters li:nth-child(2) button", "aria-current"), "true");
expect("every link leads to a file", await page.$$eval("nav a", links => links.length), 7);
expect("there is sound", await page.evaluate(() => video.webkitAudioDecodedByteCount > 0), true);
if (shot) await page.screenshot({ path: shot, fullPage: true });

// The .webm alone plays too.
await page.evaluate(() => { document.querySelector("source").remove(); video.load(); });
await page.waitForFunction(() => video.readyState >= 2 && video.currentSrc.endsWith(".webm"), null, { timeout: 20000 });
await browser.close();
for (const problem of problems) console.error(problem);
process.exit(problems.length === 0 ? 0 : 1);
