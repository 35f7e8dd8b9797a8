// SPDX-License-Identifier: MIT
// Draws the plots of a report, and keeps one moment of time common to all of them and to the replay.
"use strict";

const root = document.documentElement;
const all = (selector, within = document) => [...within.querySelectorAll(selector)];
const colour = (name) => getComputedStyle(root).getPropertyValue(name).trim();

const page = {
  data: null, plots: [], replays: [], group: "", time: 0, playing: false, pace: 1, duration: 0, ready: null,
  listeners: [], onTime(listener) { this.listeners.push(listener); },
  setTime(t) {
    this.time = Math.min(Math.max(t, 0), this.duration || t);
    for (const listener of this.listeners) listener(this.time);
  },
};

async function unpack(id) {
  const text = document.getElementById(id).textContent;
  const raw = Uint8Array.from(atob(text.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([raw]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/// Numbers are stored as differences in units of a quantum; null is a gap. What is unpacked stays as it is.
function numbers(packed) {
  if (Array.isArray(packed)) return packed;
  const values = new Array(packed.d.length);
  let last = 0;
  for (let i = 0; i < values.length; ++i) values[i] = packed.d[i] === null ? null : (last += packed.d[i]) * packed.q;
  return values;
}

const styles = {
  measured: { stroke: "--measured", width: 1.6, dash: [1.5, 3.5], cap: "round" },
  model: { stroke: "--model", width: 1.7 },
  as_given: { stroke: "--given", width: 1.4, dash: [6, 4] },
  mine: { stroke: "--mine", width: 1.9 }, best: { stroke: "--other", width: 1.2 },
  other: { stroke: "--other", width: 1.5 },
  points: { stroke: "--given", width: 0 },
  band_low: { stroke: null, width: 0 }, band_high: { stroke: null, width: 0 },
};
const more_colours = ["--other", "--c0", "--given", "--c3"];

function series_of(plot) {
  let others = 0;
  return plot.curves.map((curve) => {
    const style = styles[curve.r];
    const stroke = curve.r === "other" ? more_colours[others++ % more_colours.length] : style.stroke;
    // Moments a tenth of a second apart: what was measured there are dots, what a model has between them is smooth.
    if (plot.smooth && curve.r === "measured") return { label: curve.n, stroke: () => colour(stroke), width: 0, points: { show: true, size: 4, fill: () => colour(stroke) } };
    return {
      label: curve.n, stroke: stroke ? () => colour(stroke) : null, width: style.width, dash: style.dash, cap: style.cap,
      paths: plot.smooth && style.stroke ? uPlot.paths.spline() : undefined,
      points: { show: curve.r === "points" || (plot.x.length < 40 && style.width > 0), size: curve.r === "points" ? 7 : 5 }, spanGaps: false,
    };
  });
}

function bands_of(plot) {
  const bands = [];
  plot.curves.forEach((curve, i) => {
    if (curve.r === "band_low") bands.push({ series: [i + 2, i + 1], fill: () => colour("--band") });
  });
  return bands;
}

/// Tolerances across, marks with their words upright.
function guide_lines(plot) {
  return (u) => {
    const { ctx, bbox } = u, px = devicePixelRatio;
    const line = (x1, y1, x2, y2) => { ctx.beginPath(); ctx.moveTo(x1, y1); ctx.lineTo(x2, y2); ctx.stroke(); };
    ctx.save();
    ctx.strokeStyle = ctx.fillStyle = colour("--faint");
    ctx.lineWidth = px;
    ctx.setLineDash([4 * px, 4 * px]);
    for (const level of plot.level === null ? [] : [plot.level, -plot.level]) {
      const y = u.valToPos(level, "y", true);
      if (y >= bbox.top && y <= bbox.top + bbox.height) line(bbox.left, y, bbox.left + bbox.width, y);
    }
    ctx.font = `${12 * px}px system-ui, sans-serif`;
    for (const [value, word] of plot.marks) {
      const x = u.valToPos(value, "x", true);
      if (x < bbox.left || x > bbox.left + bbox.width) continue;
      line(x, bbox.top, x, bbox.top + bbox.height);
      const left = x + ctx.measureText(word).width + 8 * px > bbox.left + bbox.width;
      ctx.textAlign = left ? "right" : "left";
      ctx.fillText(word, x + (left ? -5 : 5) * px, bbox.top + 14 * px);
    }
    ctx.restore();
  };
}

function make_plot(element, plot) {
  plot.x = numbers(plot.x);
  const data = [plot.x, ...plot.curves.map((curve) => numbers(curve.y))];
  const axis = (label, size) => ({
    label: label || undefined, labelSize: 20, size, space: size > 40 ? 26 : 50, labelFont: "12px system-ui, sans-serif", font: "12px system-ui, sans-serif",
    stroke: () => colour("--soft"), grid: { stroke: () => colour("--hair"), width: 1 }, ticks: { stroke: () => colour("--line"), width: 1, size: 4 },
  });
  const marker = document.createElement("div");
  marker.className = "now";
  const place = (u, t) => {
    const at = u.valToPos(t, "x");
    marker.style.display = at >= 0 && at <= u.over.clientWidth ? "" : "none";
    marker.style.left = at + "px";
  };
  const outputs = all("output", element.parentElement);
  const options = {
    width: element.clientWidth, height: Number(element.dataset.height || 230), legend: { show: false },
    cursor: { sync: plot.time ? { key: "time" } : undefined, drag: { x: true, y: false }, points: { size: 6 } },
    scales: { x: { time: false }, y: plot.log ? { distr: 3 } : plot.level !== null ? { range: (u, low, high) => { const top = Math.max(1.3 * plot.level, Math.abs(low), Math.abs(high)); return [-top * 1.05, top * 1.05]; } } : {} },
    axes: [axis(plot.xl, 38), axis(plot.yl, 52)],
    series: [{}, ...series_of(plot)], bands: bands_of(plot),
    hooks: {
      drawAxes: [guide_lines(plot)],
      setCursor: [(u) => {
        const i = u.cursor.idx;
        outputs.forEach((output) => {
          const value = i === null || i === undefined ? null : u.data[Number(output.dataset.curve) + 1][i];
          output.textContent = value === null || value === undefined ? "" : value.toPrecision(4);
        });
      }],
      setScale: [(u, key) => {
        if (key !== "x" || !plot.time) return;
        place(u, page.time);
        const { min, max } = u.scales.x;
        for (const other of page.plots)
          if (other.u && other.u !== u && other.plot.time && other.plot.group === plot.group && (other.u.scales.x.min !== min || other.u.scales.x.max !== max))
            other.u.setScale("x", { min, max });
      }],
      ready: [(u) => {
        if (!plot.time) return;
        u.over.append(marker);
        place(u, page.time);
        let down = 0;
        u.over.addEventListener("mousedown", (event) => { down = event.clientX; });
        u.over.addEventListener("mouseup", (event) => { if (Math.abs(event.clientX - down) < 4) page.setTime(u.posToVal(u.cursor.left, "x")); });
      }],
    },
  };
  const u = new uPlot(options, data, element);
  if (plot.time) page.onTime((t) => place(u, t));
  return u;
}

function shown(element) { return element.offsetParent !== null || element.getClientRects().length > 0; }

function draw_what_is_shown() {
  for (const entry of page.plots)
    if (!entry.u && shown(entry.element)) entry.u = make_plot(entry.element, entry.plot);
}

/// Plots at once; the returned promise is kept when the grains stand there too.
function show_group(group) {
  page.group = group;
  for (const element of all("[data-group]")) element.classList.toggle("hidden", element.dataset.group !== group && element.dataset.group !== "");
  for (const tab of all("[role=tab]")) {
    tab.setAttribute("aria-selected", tab.dataset.tab === group);
    tab.tabIndex = tab.dataset.tab === group ? 0 : -1;
  }
  const replay = page.data.replays.find((r) => r.group === group);
  const ends = page.plots.filter((p) => p.plot.time && p.plot.group === group).map((p) => (Array.isArray(p.plot.x) ? p.plot.x : numbers(p.plot.x)).at(-1));
  page.duration = Math.max(0, replay ? replay.duration : 0, ...ends);
  draw_what_is_shown();
  page.setTime(page.time);
  return Promise.all(page.replays.map((r) => r.shown(r.group === group)));
}

function save_csv(plot, name) {
  const columns = [Array.isArray(plot.x) ? plot.x : numbers(plot.x), ...plot.curves.map((curve) => numbers(curve.y))];
  const quoted = (text) => `"${text.replaceAll('"', '""')}"`;
  const lines = [[plot.xl, ...plot.curves.map((c) => `${c.n} (${plot.yl})`)].map(quoted).join(",")];
  for (let i = 0; i < columns[0].length; ++i) lines.push(columns.map((c) => (c[i] === null ? "" : Number(c[i].toPrecision(7)))).join(","));
  save_text(lines.join("\n") + "\n", "text/csv", name);
}

function wire_tools() {
  for (const tab of all("[role=tab]")) tab.addEventListener("click", () => show_group(tab.dataset.tab));
  for (const list of all("[role=tablist]"))
    list.addEventListener("keydown", (event) => {
      const tabs = all("[role=tab]", list), step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (!step) return;
      const next = tabs[(tabs.findIndex((t) => t.dataset.tab === page.group) + step + tabs.length) % tabs.length];
      show_group(next.dataset.tab);
      next.focus();
      event.preventDefault();
    });
  for (const button of all("[data-csv]")) button.addEventListener("click", () => save_csv(page.plots[Number(button.dataset.csv)].plot, button.dataset.name));
  for (const cell of all(".strip [data-at]"))
    cell.addEventListener("click", () => {
      if (cell.dataset.show && cell.dataset.show !== page.group) show_group(cell.dataset.show);
      page.setTime(Number(cell.dataset.at));
    });
  const theme = document.getElementById("theme");
  theme?.addEventListener("click", () => {
    const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = dark ? "light" : "dark";
    redraw();
  });
  for (const query of ["(prefers-color-scheme: dark)", "print"]) matchMedia(query).addEventListener("change", redraw);
  let width = innerWidth;
  addEventListener("resize", () => {
    if (innerWidth === width) return;
    width = innerWidth;
    for (const { u, element } of page.plots) if (u && shown(element)) u.setSize({ width: element.clientWidth, height: u.height });
  });
  for (const fold of all("details")) fold.addEventListener("toggle", draw_what_is_shown);
}

function redraw() {
  for (const { u } of page.plots) u?.redraw(false, true);
  page.setTime(page.time);
}

async function start() {
  page.data = JSON.parse(new TextDecoder().decode(await unpack("data")));
  const elements = new Map(all(".plot").map((element) => [Number(element.dataset.plot), element]));
  page.plots = page.data.plots.map((plot, i) => ({ plot, element: elements.get(i), u: null }));
  wire_tools();
  page.replays = page.data.replays.map((replay, i) => start_replay(page, replay, i));
  const first = document.querySelector("[role=tab][aria-selected=true]");
  if (page.data.replays.length) page.time = page.data.replays[0].from;
  await start_knobs(page);
  add_svg_buttons(page);
  const grains = show_group(first ? first.dataset.tab : "");
  page.ready = performance.now();
  root.dataset.ready = "yes";
  await grains;
  root.dataset.grains = "yes";
}

globalThis.report = page;
if (!("DecompressionStream" in globalThis)) {
  for (const element of all(".plot")) element.textContent = "This browser is too old to draw the plots (it has no DecompressionStream); the tables hold the numbers.";
} else {
  start().catch((error) => { root.dataset.ready = "failed"; throw error; });
}
