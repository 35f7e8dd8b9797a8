// SPDX-License-Identifier: MIT
// Saves what the page shows as SVG: a plot as it is zoomed, bars as they stand, in the sizes of a journal's column (85 mm, letters of 8 pt),
// in the colours of paper whatever the theme. Letters stay text.
"use strict";

const on_paper = {
  width: 240.94, height: 147.4, letter: 8, ink: "#1d2024", pale: "#e0e0e0",
  looks: {
    measured: { colour: "#1d2024", dots: true }, model: { colour: "#0067a8", width: 0.9 }, as_given: { colour: "#c04a00", width: 0.8, dash: "3.5 2" },
    mine: { colour: "#0067a8", width: 1 }, best: { colour: "#00785a", width: 0.8, dash: "5 1.5 1 1.5" }, points: { colour: "#c04a00", dots: true },
  },
  others: [{ colour: "#00785a", width: 0.9 }, { colour: "#b07800", width: 0.9, dash: "1.2 1.2" }, { colour: "#c04a00", width: 0.9, dash: "3.5 2" }, { colour: "#737378", width: 0.9, dash: "7 2" }],
};
const for_xml = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;").replaceAll('"', "&quot;");
const svg_text = (x, y, words, anchor = "start", more = "") => `<text x="${x.toFixed(2)}" y="${y.toFixed(2)}" text-anchor="${anchor}"${more}>${for_xml(words)}</text>\n`;
const svg_line = (points, colour, width, dash = "", css = "") => `<polyline class="${css}" fill="none" stroke="${colour}" stroke-width="${width}"${dash ? ` stroke-dasharray="${dash}"` : ""} points="${points.map(([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`).join(" ")}"/>\n`;
/// Width of words in Helvetica, points, by an average letter.
const words_width = (words) => 0.53 * on_paper.letter * words.length;

function svg_document(height, body) {
  return `<?xml version="1.0" encoding="UTF-8"?>\n<svg xmlns="http://www.w3.org/2000/svg" width="85mm" height="${(height * 25.4 / 72).toFixed(2)}mm" viewBox="0 0 ${on_paper.width} ${height.toFixed(2)}" font-family="Helvetica, Arial, 'Liberation Sans', sans-serif" font-size="${on_paper.letter}" fill="${on_paper.ink}" stroke-linejoin="round">\n<rect width="100%" height="100%" fill="#ffffff"/>\n${body}</svg>\n`;
}

/// Numbers that stand at an axis: multiples of 1, 2 or 5 times a power of ten, about so many; of a logarithmic one the powers of ten.
function ticks_between(low, high, wanted, logarithmic) {
  if (logarithmic) {
    const powers = [];
    for (let power = Math.ceil(Math.log10(low)); power <= Math.log10(high) + 1e-9; ++power) powers.push([10 ** power, String(10 ** power)]);
    return powers;
  }
  const rough = (high - low) / wanted, power = 10 ** Math.floor(Math.log10(rough)), step = power * ([1, 2, 5].find((factor) => factor * power >= rough * 0.999999) ?? 10);
  const digits = Math.min(9, Math.max(0, Math.ceil(-Math.log10(step) - 1e-9))), ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k <= high / step + 1e-9; ++k) ticks.push([k * step, (k < 0 ? "\u2212" : "") + Math.abs(k * step).toFixed(digits)]);
  return ticks;
}

const ends_of = (lists) => {
  let low = Infinity, high = -Infinity;
  for (const list of lists) for (const value of list) if (value !== null && Number.isFinite(value)) { low = Math.min(low, value); high = Math.max(high, value); }
  return low < high ? [low, high] : low === high ? [low - 1, high + 1] : [0, 1];
};

/// The legend's rows; adds their height to `at.y`.
function svg_legend(entries, left, at) {
  let body = "", x = left;
  for (const { name, sample } of entries) {
    const width = 17 + words_width(name);
    if (x > left && x + width > on_paper.width - 6) { x = left; at.y += 1.4 * on_paper.letter; }
    body += sample(x, at.y - 2.6) + svg_text(x + 17, at.y, name);
    x += width + 8;
  }
  if (entries.length) at.y += 0.6 * on_paper.letter;
  return body;
}

/// A plot; `u`: as it is drawn, for what is zoomed in.
function svg_of_plot(plot, u) {
  const x = numbers(plot.x), curves = plot.curves.map((curve) => ({ ...curve, y: numbers(curve.y) })), inside = (scale, low, high) => (u && Number.isFinite(u.scales[scale].min) ? [u.scales[scale].min, u.scales[scale].max] : [low, high]);
  const [left, right] = inside("x", ...ends_of([x])), [low, high] = inside("y", ...ends_of(curves.map((curve) => curve.y)));
  const y_ticks = ticks_between(low, high, 5, plot.log), margin = 22 + Math.max(0, ...y_ticks.map(([, label]) => words_width(label)));
  let others = 0;
  const looks = curves.map((curve) => (curve.r === "other" ? on_paper.others[others++ % 4] : on_paper.looks[curve.r]));
  const entries = [];
  curves.forEach((curve, k) => {
    if (curve.r === "band_high") entries.push({ name: curve.n, sample: (at, y) => `<rect x="${at}" y="${(y - 3).toFixed(2)}" width="14" height="6" fill="#0067a8" fill-opacity="0.18"/>\n` });
    else if (curve.r !== "band_low" && curve.n) entries.push({ name: curve.n, sample: (at, y) => (looks[k].dots ? `<circle cx="${at + 7}" cy="${y.toFixed(2)}" r="1.3" fill="${looks[k].colour}"/>\n` : svg_line([[at, y], [at + 14, y]], looks[k].colour, looks[k].width, looks[k].dash)) });
  });
  const at = { y: on_paper.letter };
  let body = svg_legend(entries, margin, at);
  const top = at.y + 4, bottom = top + on_paper.height, end = on_paper.width - 8, size = plot.log ? Math.log10 : (value) => value;
  const across = (value) => margin + ((value - left) / (right - left)) * (end - margin), up = (value) => bottom - ((size(value) - size(low)) / (size(high) - size(low))) * (bottom - top);
  for (const [value] of y_ticks) body += svg_line([[margin, up(value)], [end, up(value)]], on_paper.pale, 0.4, "", "grid");
  for (const level of plot.level === null ? [] : [plot.level, -plot.level]) body += svg_line([[margin, up(level)], [end, up(level)]], on_paper.ink, 0.4, "3 2");
  // A picture within the picture cuts off what lies outside.
  body += `<svg x="${margin}" y="${top}" width="${end - margin}" height="${bottom - top}" viewBox="${margin} ${top} ${end - margin} ${bottom - top}">\n`;
  const stretches = (y) => {
    const found = [[]];
    x.forEach((value, i) => { if (y[i] === null || !Number.isFinite(y[i]) || value < left || value > right) { if (found.at(-1).length) found.push([]); } else found.at(-1).push([across(value), up(y[i])]); });
    return found.filter((points) => points.length);
  };
  curves.forEach((curve, k) => {
    if (curve.r === "band_low") {
      const below = stretches(curve.y), above = stretches(curves[k + 1].y);
      below.forEach((points, i) => { if (above[i]) body += `<polygon fill="#0067a8" fill-opacity="0.18" points="${[...points, ...above[i].reverse()].map(([a, b]) => `${a.toFixed(2)},${b.toFixed(2)}`).join(" ")}"/>\n`; });
    } else if (curve.r !== "band_high" && looks[k].dots) {
      const points = stretches(curve.y).flat(), radius = points.length > 80 ? 0.65 : 1.3;
      body += `<g class="${curve.r}" fill="${looks[k].colour}">${points.map(([a, b]) => `<circle cx="${a.toFixed(2)}" cy="${b.toFixed(2)}" r="${radius}"/>`).join("")}</g>\n`;
    } else if (curve.r !== "band_high") {
      for (const points of stretches(curve.y)) body += svg_line(points, looks[k].colour, looks[k].width, looks[k].dash, curve.r);
    }
  });
  body += "</svg>\n";
  for (const [value, word] of plot.marks) if (value >= left && value <= right) body += svg_line([[across(value), top], [across(value), bottom]], on_paper.ink, 0.4, "3 2") + (word ? svg_text(across(value) + 3, top + 8, word) : "");
  body += svg_line([[margin, top], [margin, bottom], [end, bottom]], on_paper.ink, 0.6, "", "axis");
  for (const [value, label] of ticks_between(left, right, 5, false)) body += svg_line([[across(value), bottom], [across(value), bottom + 3]], on_paper.ink, 0.6) + svg_text(across(value), bottom + 11.4, label, "middle", ' class="x_tick"');
  for (const [value, label] of y_ticks) body += svg_line([[margin - 3, up(value)], [margin, up(value)]], on_paper.ink, 0.6) + svg_text(margin - 5, up(value) + 2.9, label, "end", ' class="y_tick"');
  body += svg_text((margin + end) / 2, bottom + 22, plot.xl || "time since release, s", "middle");
  body += svg_text(9, (top + bottom) / 2, plot.yl, "middle", ` transform="rotate(-90 9 ${((top + bottom) / 2).toFixed(2)})"`);
  return svg_document(bottom + 26, body);
}

/// Bars, read off the page: labels above them, numbers behind.
function svg_of_bars(figure) {
  const at = { y: on_paper.letter }, first = (element) => element.firstChild?.textContent ?? "", end = on_paper.width - 46;
  const shape = (kind, x, y, width, tied) => (kind === 1 ? `<rect x="${x}" y="${y.toFixed(2)}" width="${width.toFixed(2)}" height="6" fill="none" stroke="#0067a8" stroke-width="0.8"/>\n` : `<rect x="${x}" y="${y.toFixed(2)}" width="${width.toFixed(2)}" height="6" fill="${["#0067a8", "", "#00785a", "#e69f00"][kind]}"${tied ? ' fill-opacity="0.45"' : ""}/>\n`);
  const keys = all(".key > span", figure).map((key) => ({ name: key.textContent, floor: !!key.querySelector(".floor"), kind: Number(/k(\d)/.exec(key.querySelector("i").className)?.[1] ?? 0) }));
  let body = svg_legend(keys.map(({ name, floor, kind }) => ({ name, sample: (x, y) => (floor ? svg_line([[x + 7, y - 4], [x + 7, y + 4]], "#c04a00", 0.8, "3 2") : shape(kind, x, y - 3, 14)) })), 4, at);
  const lane = 0.74, top = at.y;
  let floor = null;
  for (const label of all(".label", figure)) {
    body += svg_text(7, (at.y += 1.5 * on_paper.letter), first(label));
    for (const bar of all(".bar", label.nextElementSibling)) {
      const width = (Number.parseFloat(bar.querySelector("i")?.style.width ?? "0") / 100 / lane) * (end - 4);
      body += shape(Number(/k(\d)/.exec(bar.className)?.[1] ?? 0), 4, at.y + 2, width, bar.classList.contains("tied")) + svg_text(8 + width, at.y + 7.6, bar.querySelector("span").textContent);
      at.y += 7.5;
    }
    at.y += 2;
    const line = label.nextElementSibling.querySelector("b.floor");
    if (line) floor = 4 + (Number.parseFloat(line.style.left) / 100 / lane) * (end - 4);
  }
  if (floor !== null) body += svg_line([[floor, top], [floor, at.y]], "#c04a00", 0.8, "3 2");
  body += svg_line([[4, top], [4, at.y]], on_paper.ink, 0.6, "", "axis");
  return svg_document(at.y + 6, body);
}

function save_text(text, type, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/// A button at every plot and at all bars.
function add_svg_buttons(page) {
  const named = (figure, group) => `${(figure.querySelector("h3")?.textContent || figure.closest("section")?.querySelector("h2")?.textContent || "figure")} ${group ?? ""}`.trim().replaceAll(/[^A-Za-z0-9]+/g, "_");
  const add = (figure, group, draw) => {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "save";
    button.textContent = "SVG";
    button.setAttribute("aria-label", `Save as SVG: ${named(figure, group).replaceAll("_", " ")}`);
    button.addEventListener("click", () => save_text(draw(), "image/svg+xml", named(figure, group) + ".svg"));
    const head = figure.querySelector(".figure-head"), title = figure.querySelector("h3");
    if (head) return head.append(button);
    const row = document.createElement("div");
    row.className = "figure-head";
    if (title) { title.replaceWith(row); row.append(title, button); } else { row.append(document.createElement("span"), button); figure.prepend(row); }
  };
  for (const entry of page.plots) { const figure = entry.element.closest("figure"); add(figure, entry.plot.group, () => svg_of_plot(entry.plot, entry.u)); }
  for (const bars of all(".bars")) { const figure = bars.closest("figure"); add(figure, "", () => svg_of_bars(figure)); }
}
