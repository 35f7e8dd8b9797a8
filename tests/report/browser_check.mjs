// SPDX-License-Identifier: MIT
// Opens a report in headless Chromium and fails with a sentence for each thing that is not as it should be:
//   node browser_check.mjs REPORT.html [FOLDER FOR SCREENSHOTS]
// playwright-core is looked for beside this file and where BROWSER_MODULES says.
import { createRequire } from "node:module";
import { mkdtempSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const require = createRequire(process.env.BROWSER_MODULES ? join(process.env.BROWSER_MODULES, "x.js") : import.meta.url);
const { chromium } = require("playwright-core");
const [file, shots] = process.argv.slice(2);
const url = pathToFileURL(resolve(file)).href;
const wrong = [];
const expect = (good, sentence) => { if (!good) wrong.push(sentence); };
const figures = { bytes: statSync(file).size };

const context = await chromium.launchPersistentContext(mkdtempSync(join(tmpdir(), "report-check-")), {
  executablePath: process.env.CHROMIUM || "/usr/bin/chromium", headless: true, acceptDownloads: true, hasTouch: true, viewport: { width: 1280, height: 900 }, colorScheme: "light",
  args: ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
await context.setOffline(true);
context.setDefaultTimeout(240000);  // of clicks and pictures on a busy machine; the page itself is timed below

async function open(options = {}) {
  const page = await context.newPage();
  page.requests = [];
  page.complaints = [];
  page.on("request", (request) => { if (!/^(data|blob):/.test(request.url())) page.requests.push(request.url()); });
  page.on("console", (message) => { if (["error", "warning"].includes(message.type()) && !/GPU stall|GL Driver/.test(message.text())) page.complaints.push(message.text()); });
  page.on("pageerror", (error) => page.complaints.push(String(error)));
  await page.setViewportSize({ width: options.width || 1280, height: options.width === 390 ? 844 : 900 });
  await page.emulateMedia({ colorScheme: options.theme || "light" });
  if (options.before) await page.addInitScript(options.before);
  // CPU time beside the wall's: on a machine busy with other things only the first tells about the page.
  const cdp = await context.newCDPSession(page);
  await cdp.send("Performance.enable", { timeDomain: "threadTicks" });
  const start = Date.now();
  await page.goto(url);
  await page.waitForFunction(() => document.documentElement.dataset.ready, null, { timeout: 240000 });
  page.seconds = (Date.now() - start) / 1000;
  page.own_seconds = (await page.evaluate(() => report.ready)) / 1000;  // by the page's own clock, from navigation to plots drawn
  page.cpu_seconds = (await cdp.send("Performance.getMetrics")).metrics.find((metric) => metric.name === "TaskDuration").value;
  return page;
}

/// Every knob moves curves, what is drawn, errors and the setup's lines; the buttons bring back what the program has printed. One knob is
/// turned by key and one by touch, the others by the events that these make.
async function check_knobs(page) {
  if (!(await page.locator("[data-knobs]").count())) return;
  const found = await page.evaluate(() => {
    for (const fold of document.querySelectorAll("[data-knobs] details")) fold.open = true;
    const knobs = report.knobs, { data } = knobs, wrong = [];
    const expect = (good, sentence) => { if (!good) wrong.push(sentence); };
    const press = (mode) => document.querySelector(`[data-mode="${mode}"]`).click();
    const state = () => ({
      sums: knobs.answers.flatMap((run) => run.curves.map((curve) => curve.reduce((sum, x, i) => sum + x * Math.sin(i), 0))), chi2: knobs.answers.map((run) => run.chi2),
      drawn: report.plots.filter((entry) => entry.u && entry.mine !== undefined).map((entry) => entry.u.data[entry.mine + 1].reduce((sum, x, i) => sum + (x ?? 0) * Math.cos(i), 0)).join(),
      error: report.knob_error, lines: document.querySelector("[data-knobs] pre").textContent, said: document.querySelector(".knob-error").textContent });
    const told = (name) => {
      const answers = data.runs.map((run) => ({ curves: run.curves.map((curve) => curve[name].map((x) => x ?? NaN)) }));
      return knob_model.error_of(data, answers, "box", data.kind !== "swing");
    };
    for (const mode of ["given", "best"]) {
      press(mode);
      const page_says = state().error, program_says = told(mode);
      expect(!(Math.abs(page_says - program_says) > 0.01 * program_says), `${mode}: the page says ${page_says} mm, the program ${program_says}`);
    }
    const inputs = [...document.querySelectorAll("[data-knobs] input[type=range]")];
    expect(inputs.length === data.numbers.length, "not every number has a slider");
    let slowest = 0;
    for (const input of inputs.filter((one) => !one.disabled)) {
      press("best");
      const before = state(), key = input.dataset.key;
      input.value = Number(input.value) + 0.07 * (Number(input.max) - Number(input.value) > 0.1 * (input.max - input.min) ? input.max - input.min : input.min - input.max);
      input.dispatchEvent(new Event("input", { bubbles: true }));
      const begun = performance.now();
      knobs.show_place();
      slowest = Math.max(slowest, performance.now() - begun);
      const after = state();
      expect(after.sums.some((sum, i) => sum !== before.sums[i]), `${key} moves no curve`);
      expect(after.drawn !== before.drawn || after.sums.every((sum, i) => i === 0 || sum !== before.sums[i]), `${key} moves nothing that is drawn`);
      expect(after.chi2.some((x, i) => x !== before.chi2[i]), `${key} leaves chi squared as it is`);
      expect(after.lines !== before.lines, `${key} leaves the lines of the setup as they are`);
      expect(document.querySelector('[data-mode="own"]').getAttribute("aria-pressed") === "true", `${key} does not make the place one's own`);
    }
    const own = state().error;
    press("best");
    press("own");
    expect(state().error === own, "one's own place is not kept");
    press("best");
    expect(!/NaN|undefined/.test(document.querySelector("[data-knobs]").innerText), "a knob says what is no number");
    return { wrong, numbers: data.numbers.length, slowest };
  });
  for (const sentence of found.wrong) expect(false, sentence);
  figures.knobs = found.numbers;
  figures.milliseconds_a_move = found.slowest;
  const first = page.locator("[data-knobs] input[type=range]").first(), at = () => page.evaluate(() => report.knobs.place[0]), before = await at();
  await first.focus();
  await page.keyboard.press("ArrowLeft");
  const by_key = await at();
  expect(by_key !== before, "the arrow keys do not move a knob");
  const place = await first.boundingBox();
  await first.tap({ position: { x: 0.3 * place.width, y: place.height / 2 } });
  await page.waitForFunction((key) => report.knobs.place[0] !== key, by_key, { timeout: 60000 }).catch(() => expect(false, "a touch does not move a knob"));
}

const page = await open();
figures.seconds_to_ready = page.own_seconds;
figures.seconds_with_the_browser = page.seconds;
figures.cpu_seconds_to_ready = page.cpu_seconds;
expect(page.own_seconds < 2 || page.cpu_seconds < 0.5, `ready after ${page.own_seconds} s (${page.cpu_seconds} s of computing), not within 2 s`);
expect(/default-src 'none'/.test((await page.getAttribute("meta[http-equiv=Content-Security-Policy]", "content")) || ""), "no content-security policy that forbids the network");
expect(figures.bytes <= 1.8e6, `${figures.bytes} bytes, more than 1.8 MB`);
expect((await page.getAttribute("html", "data-ready")) === "yes", "the page did not become ready");
expect(page.requests.length === 1, `asked for ${page.requests.length} things: ${page.requests.join(" ")}`);
figures.requests = page.requests.length;

// Every plot of every group is drawn: it has a canvas, and something on it.
const tabs = await page.locator("[role=tab]").count();
figures.groups = tabs;
figures.plots = await page.locator(".plot").count();
for (let k = 0; k < Math.max(1, tabs); ++k) {
  if (tabs > 1) await page.locator("[role=tab]").nth(k).click();
  const empty = await page.evaluate(() => [...document.querySelectorAll(".plot")].filter((plot) => plot.offsetParent !== null).filter((plot) => {
    const canvas = plot.querySelector("canvas");
    if (!canvas) return true;
    const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
    return !pixels.some((value, i) => i % 4 === 3 && value > 0);
  }).length);
  expect(empty === 0, `${empty} plots of group ${k} are empty`);
}
if (tabs > 1) await page.locator("[role=tab]").first().click();

// The grains move with the cursor, and a click on a residual goes there.
const replay = page.locator("[data-replay] canvas >> visible=true").first();
if (await replay.count()) await page.waitForFunction(() => document.documentElement.dataset.grains, null, { timeout: 240000 });
const hash = () => replay.evaluate((canvas) => {
  const gl = canvas.getContext("webgl2"), pixels = new Uint8Array(4 * canvas.width * canvas.height);
  gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  let sum = 0, drawn = 0;
  for (let i = 0; i < pixels.length; i += 4) { sum = (sum * 31 + pixels[i] + pixels[i + 1] * 7 + pixels[i + 2] * 13) % 1e9; drawn += pixels[i + 3] > 0; }
  return { sum, drawn };
});
if (await replay.count()) {
  await page.evaluate(() => report.setTime(0.2));
  const before = await hash();
  await page.evaluate(() => report.setTime(0.35));
  const after = await hash();
  expect(before.drawn > 2000, "the grains are not drawn");
  expect(before.sum !== after.sum, "the grains do not move with the time cursor");
  const over = page.locator(".plot:visible .u-over").nth((await page.locator(".plot:visible .u-over").count()) > 1 ? 1 : 0), box = await over.boundingBox();
  await over.click({ position: { x: box.width * 0.5, y: box.height * 0.5 } });
  const clicked = await hash();
  const moved = await page.evaluate(() => report.time);
  expect(moved > 0.4 && clicked.sum !== after.sum, `a click on a plot does not move the grains (t = ${moved})`);
  await page.locator("[data-replay] canvas:visible").first().focus();
  await page.keyboard.press("Space");
  const plays = await page.waitForFunction((t) => report.time > t, moved, { timeout: 60000 }).then(() => true, () => false);
  expect(plays, "the space bar does not play");
  await page.keyboard.press("Space");
}
await check_knobs(page);
const [download] = await Promise.all([page.waitForEvent("download"), page.locator("[data-csv]:visible").first().click()]);
expect(download.suggestedFilename().endsWith(".csv"), "no CSV to download");
// Every plot that is shown, and all bars, as SVG: it parses, its axes have words and numbers, and what was measured or modelled is in it.
const saved = await page.evaluate(() => {
  const wrong = [];
  let count = 0;
  const check = (text, plot) => {
    const drawing = new DOMParser().parseFromString(text, "image/svg+xml"), words = [...drawing.querySelectorAll("text")].map((one) => one.textContent);
    ++count;
    if (drawing.querySelector("parsererror") || /NaN|undefined|Infinity/.test(text)) return wrong.push(`${plot?.yl ?? "bars"}: the SVG is broken`);
    if (drawing.documentElement.getAttribute("width") !== "85mm") wrong.push("an SVG is not 85 mm wide");
    if (plot && !(words.includes(plot.yl) && words.filter((word) => /^[\u2212\d.e-]+$/.test(word)).length > 3)) wrong.push(`${plot.yl}: an SVG without axes`);
  };
  for (const { plot, u } of report.plots) if (u) check(svg_of_plot(plot, u), plot);
  for (const bars of document.querySelectorAll(".bars")) check(svg_of_bars(bars.closest("figure")), null);
  if (document.querySelectorAll("button.save").length < report.plots.length) wrong.push("a plot has no button for its SVG");
  return { wrong, count };
});
for (const sentence of saved.wrong) expect(false, sentence);
figures.svgs = saved.count;
const [picture] = await Promise.all([page.waitForEvent("download"), page.locator("button.save:visible").first().click()]);
expect(picture.suggestedFilename().endsWith(".svg"), "no SVG to download");
if (shots) await picture.saveAs(join(shots, "figure.svg"));
expect(page.complaints.length === 0, `the console complains: ${page.complaints.join(" | ")}`);
expect(page.requests.length === 1, `asked for more later: ${page.requests.join(" ")}`);
await page.close();

for (const width of [1280, 390])
  for (const theme of ["light", "dark"]) {
    const view = await open({ width, theme });
    const wide = await view.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    expect(wide <= 0, `at ${width} px the page is ${wide} px too wide`);
    const overlaps = await view.evaluate(() => {
      const rows = [...document.querySelectorAll(".intervals > span:not(.track), .legend li, .fact dt, .fact dd")].filter((e) => e.offsetParent !== null);
      const boxes = rows.map((e) => { const r = document.createRange(); r.selectNodeContents(e); return [r.getBoundingClientRect(), e]; });
      const found = [];
      for (let i = 0; i < boxes.length; ++i)
        for (let k = i + 1; k < boxes.length && k < i + 12; ++k) {
          const [a] = boxes[i], [b] = boxes[k];
          if (a.right > b.left + 1 && b.right > a.left + 1 && a.bottom > b.top + 3 && b.bottom > a.top + 3) found.push(`${boxes[i][1].textContent} | ${boxes[k][1].textContent}`);
        }
      return found;
    });
    expect(overlaps.length === 0, `at ${width} px texts lie over each other: ${overlaps.slice(0, 3).join("; ")}`);
    if (shots) await view.screenshot({ path: join(shots, `report_${width}_${theme}.png`), fullPage: true });
    if (width === 1280 && theme === "dark") {
      await view.emulateMedia({ media: "print" });
      expect(!(await view.locator("nav.tools").isVisible()), "tools are printed");
      expect((await view.evaluate(() => getComputedStyle(document.body).backgroundColor)) === "rgb(255, 255, 255)", "the dark theme is printed");
      if (shots) await view.screenshot({ path: join(shots, "report_print.png"), fullPage: true });
    }
    await view.close();
  }

const plain = await open({ before: () => { const get = HTMLCanvasElement.prototype.getContext; HTMLCanvasElement.prototype.getContext = function (kind, ...rest) { return kind === "webgl2" ? null : get.call(this, kind, ...rest); }; } });
if (await plain.locator("[data-replay]").count()) await plain.waitForTimeout(1000);
if (await plain.locator("[data-replay]").count()) expect((await plain.locator(".replay .message:visible").count()) > 0, "without WebGL there is no message");
expect((await plain.locator(".plot canvas").count()) > 0, "without WebGL the plots are missing");
await context.close();

console.log(JSON.stringify(figures));
for (const sentence of wrong) console.error("report: " + sentence);
process.exit(wrong.length ? 1 : 0);
