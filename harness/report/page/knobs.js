// SPDX-License-Identifier: MIT
// Sliders for the numbers of the model: curves, residuals, errors and the lines of the setup follow at once (model.js says how).
"use strict";

const made = (name, css = "", text = "") => {
  const element = document.createElement(name);
  if (css) element.className = css;
  if (text) element.textContent = text;
  return element;
};
const in_digits = (value, digits = 4) => (Number.isFinite(value) ? String(Number(value.toPrecision(digits))) : "–");

/// A number's value as people read it.
function spoken(number, place, digits) {
  const value = knob_model.value_at_place(number, place);
  if (!Number.isFinite(value)) return "none";
  if (number.role !== "parameter" && place === number.absent) return "none";
  return in_digits(value / number.factor, digits) + (number.unit ? " " + number.unit : "");
}

/// The lines of a setup that has the numbers at this place.
function setup_lines(knobs, place) {
  const tables = new Map(), effects = new Map(knobs.effects.map((effect) => [effect.name, { toml: effect.toml, present: false, more: [] }]));
  knobs.numbers.forEach((number, k) => {
    const value = knob_model.value_at_place(number, place[k]);
    const text = Number.isFinite(value) ? in_digits(value / number.factor, 9) : "0", written = number.unit ? `"${text} ${number.unit}"` : text;
    for (const key of number.key.split("&")) {
      const dot = key.indexOf("."), first = key.slice(0, dot), rest = key.slice(dot + 1), effect = effects.get(first);
      if (!effect) {
        if (!tables.has(first)) tables.set(first, []);
        tables.get(first).push(`${rest} = ${written}`);
        continue;
      }
      const none = Number.isFinite(number.absent) ? number.absent : 0;
      effect.present ||= place[k] !== none && Number.isFinite(value);
      const line = new RegExp(`^${rest} = .*$`, "m");
      if (line.test(effect.toml)) effect.toml = effect.toml.replace(line, `${rest} = ${written}`);
      else effect.more.push(`# ${key} = ${written}`);
    }
  });
  const parts = [...tables].map(([table, lines]) => `[${table}]\n${lines.join("\n")}\n`);
  for (const effect of effects.values()) if (effect.present) parts.push(effect.toml.trim() + "\n" + effect.more.map((line) => line + "\n").join(""));
  return parts.join("\n");
}

function read_knobs(raw) {
  for (const run of raw.runs)
    for (const curve of run.curves) {
      for (const name of ["time", "measured", "spread", "best", "given"]) curve[name] = numbers(curve[name]);
      curve.columns = curve.columns.map(numbers);
    }
  return raw;
}

/// One plot of a curve: entries of page.plots whose data follow the knobs.
function knob_plot(page, run, curve, kind, smooth) {
  const figure = made("figure"), legend = made("ul", "legend"), element = made("div", "plot");
  const error = kind === "error", what = curve.name === "box" ? "Box" : "Centre of the grains";
  figure.dataset.group = run.name;
  element.dataset.height = error ? 210 : 200;
  const curves = error
    ? [{ n: "", r: "band_low", y: curve.spread.map((s) => (s === null ? null : -2 * s)) }, { n: "two expected spreads", r: "band_high", y: curve.spread.map((s) => (s === null ? null : 2 * s)) },
      { n: "best", r: "best", y: curve.measured.map((m, i) => (m === null || curve.best[i] === null ? null : m - curve.best[i])) }, { n: "as the knobs stand", r: "mine", y: [] }]
    : [{ n: "as given", r: "as_given", y: curve.given }, { n: "best", r: "best", y: curve.best }, { n: "as the knobs stand", r: "mine", y: [] }, { n: "measured", r: "measured", y: curve.measured }];
  curves.forEach((one, k) => {
    if (one.r === "band_low") return;
    const item = made("li"), output = made("output");
    output.dataset.curve = k;
    item.append(made("i", one.r === "band_high" ? "band" : one.r), one.n + " ");
    if (one.r !== "band_high") item.append(output);
    legend.append(item);
  });
  figure.append(made("h3", "", error ? `${what}: measured less model` : what), legend, element);
  const plot = { group: run.name, time: true, smooth, log: false, level: null, xl: error ? "time since release, s" : "", yl: error ? "mm" : "position, mm", x: curve.time, curves, marks: [] };
  const entry = { plot, element, u: null, mine: curves.findIndex((one) => one.r === "mine") };
  page.plots.push(entry);
  return { figure, show(mean) {
    plot.curves[entry.mine].y = Array.from(mean, (m, i) => (!Number.isFinite(m) || (error && curve.measured[i] === null) ? null : error ? curve.measured[i] - m : m));
    if (!entry.u) return;
    const { min, max } = entry.u.scales.x;
    entry.u.setData([entry.u.data[0], ...plot.curves.map((one) => one.y)], false);
    entry.u.setScale("x", { min, max });
  } };
}

/// Amplitude of what is left, mm, by frequency, Hz, and what white noise of the expected spread would have; up to four frames a period.
function spectrum_of(curve, mean) {
  const left = [];
  curve.measured.forEach((m, i) => { if (m !== null && Number.isFinite(mean[i])) left.push([curve.time[i], m - mean[i], curve.spread[i]]); });
  if (left.length < 8) return null;
  const length = left.at(-1)[0] - left[0][0], fastest = Math.min(12, left.length / length / 4), steps = 120, x = [], y = [];
  const noise = 2 * Math.sqrt(left.reduce((sum, [, , s]) => sum + s * s, 0)) / left.length;
  for (let k = 1; k <= steps; ++k) {
    const omega = (2 * Math.PI * fastest * k) / steps;
    let sine = 0, cosine = 0;
    for (const [t, r] of left) { sine += r * Math.sin(omega * t); cosine += r * Math.cos(omega * t); }
    x.push((fastest * k) / steps);
    y.push((2 * Math.hypot(sine, cosine)) / left.length);
  }
  return { x, y, noise: x.map(() => noise) };
}

/// rms of what is left, mm, in twenty-four stretches of the run, and of the expected spread.
function course_of(curve, mean) {
  const count = 24, begin = curve.time[0], length = (curve.time.at(-1) - begin) / count || 1, sums = Array.from({ length: count }, () => [0, 0, 0]);
  curve.measured.forEach((m, i) => {
    if (m === null || !Number.isFinite(mean[i])) return;
    const sum = sums[Math.min(count - 1, Math.floor((curve.time[i] - begin) / length))];
    sum[0] += (m - mean[i]) ** 2; sum[1] += curve.spread[i] ** 2; ++sum[2];
  });
  const root = (k) => sums.map((sum) => (sum[2] ? Math.sqrt(sum[k] / sum[2]) : null));
  return { x: sums.map((_, k) => begin + (k + 0.5) * length), y: root(0), noise: root(1) };
}

/// What is left of the box of one run, by frequency or by time: worked out where it is looked at.
function left_plot(page, run, curve, kind) {
  const figure = made("figure"), legend = made("ul", "legend"), element = made("div", "plot"), by_time = kind === "course";
  figure.dataset.group = run.name;
  element.dataset.height = 180;
  const first = by_time ? course_of(curve, curve.best) : spectrum_of(curve, curve.best);
  if (!first) return null;
  const curves = [{ n: "noise and spread as expected", r: "best", y: first.noise }, { n: "as the knobs stand", r: "mine", y: first.y }];
  for (const one of curves) { const item = made("li"); item.append(made("i", one.r), one.n); legend.append(item); }
  figure.append(made("h3", "", by_time ? "Left of the box, by time" : "Left of the box, by frequency"), legend, element);
  const plot = { group: run.name, time: by_time, smooth: false, level: null, log: false, xl: by_time ? "time since release, s" : "frequency, Hz", yl: by_time ? "rms, mm" : "amplitude, mm", x: first.x, curves, marks: [] };
  const entry = { plot, element, u: null };
  page.plots.push(entry);
  return { figure, show(mean) {
    if (!shown(element)) return;
    curves[1].y = (by_time ? course_of(curve, mean) : spectrum_of(curve, mean))?.y ?? [];
    if (entry.u) entry.u.setData([entry.u.data[0], ...curves.map((one) => one.y)]);
  } };
}

class Knobs {
  constructor(page, host, data) {
    Object.assign(this, { page, host, data, swing: data.kind === "swing", sliders: [], history: [], as_stated: false, mode: "best" });
    this.place = data.numbers.map((number) => number.best);
    this.own = null;
    this.build();
    this.show_place();
  }
  answers_at(place, as_stated = false) { return this.swing ? knob_model.swing_at(this.data, place, as_stated) : knob_model.response_at(this.data, place); }
  errors_of(answers) { return ["box", "centre"].map((name) => knob_model.error_of(this.data, answers, name, !this.swing)); }

  build() {
    const body = made("div", "knob-body"), plots = made("div", "knob-plots"), side = made("div", "knob-side");
    this.drawn = this.data.runs.map((run) => run.curves.map((curve) => ["position", "error"].map((kind) => {
      const drawn = knob_plot(this.page, run, curve, kind, !this.swing);
      plots.append(drawn.figure);
      return drawn;
    })));
    side.append(this.head(), this.buttons(), ...this.groups());
    body.append(plots, side);
    this.host.append(body, this.table(), this.left(), this.lines());
  }
  head() {
    const head = made("div", "knob-head ui");
    this.error = made("output", "knob-error");
    this.misfit = made("p", "knob-note");
    this.word = made("p", "knob-note");
    this.word.setAttribute("aria-live", "polite");
    this.spark = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    this.spark.setAttribute("viewBox", "0 0 200 44");
    this.spark.setAttribute("class", "spark");
    this.spark.setAttribute("role", "img");
    this.spark.setAttribute("aria-label", "Error of the box over the moves so far");
    head.append(made("small", "", "Error of the box, rms over all runs"), this.error, this.spark, this.misfit, this.word);
    return head;
  }
  buttons() {
    const row = made("div", "knob-buttons");
    const add = (mode, text, go) => {
      const button = made("button", "", text);
      button.type = "button";
      button.dataset.mode = mode;
      button.addEventListener("click", go);
      row.append(button);
      return button;
    };
    const { numbers } = this.data;
    add("given", "As given", () => this.go("given", numbers.map((n) => n.given), this.swing));
    add("best", "Best", () => this.go("best", numbers.map((n) => n.best), false));
    for (const name of new Set(numbers.filter((n) => n.role === "effect").map((n) => n.effect)))
      add("without " + name, "Without " + name, () => this.go("without " + name, numbers.map((n) => (n.effect === name && n.role === "effect" && Number.isFinite(n.absent) ? n.absent : n.best)), false));
    this.back = add("own", "My own", () => this.own && this.go("own", this.own.place, this.own.as_stated));
    if (this.swing) {
      const label = made("label", "knob-start"), box = made("input");
      box.type = "checkbox";
      box.addEventListener("change", () => { this.as_stated = box.checked; this.moved(); });
      this.start = box;
      label.append(box, " let go at rest from where the setup says");
      row.append(label);
    }
    return row;
  }
  groups() {
    const titles = { parameter: "Parameters", effect: "Effects found", suspect: "Suspects", camera: "Camera and weights" };
    return Object.entries(titles).flatMap(([role, title]) => {
      const own = this.data.numbers.map((number, k) => [number, k]).filter(([number]) => number.role === role);
      if (!own.length) return [];
      const fold = made("details", "knob-group"), head = made("summary", "", title);
      fold.open = role === "parameter" || role === "effect" || (role === "suspect" && own.length <= 4);
      fold.append(head, ...own.map(([number, k]) => this.slider(number, k)));
      return [fold];
    });
  }
  slider(number, k) {
    const row = made("label", "knob"), name = made("span", "knob-name", number.label), track = made("span", "knob-track"), output = made("output"), input = made("input");
    const at = (value) => `${(100 * (value - number.low)) / (number.high - number.low)}%`;
    const inner = made("span", "knob-marks"), valid = made("i", "valid");
    valid.style.left = at(Math.max(number.from, number.low));
    valid.style.right = `calc(100% - ${at(Math.min(number.to, number.high))})`;
    inner.append(valid);
    for (const [which, value] of [["given", number.given], ["best", number.best]]) {
      const mark = made("i", which);
      mark.style.left = at(value);
      mark.title = which === "given" ? "as given" : "best";
      inner.append(mark);
    }
    Object.assign(input, { type: "range", min: number.low, max: number.high, step: "any" });
    input.dataset.key = number.key;
    input.setAttribute("aria-label", `${number.label} (${number.key})`);
    input.addEventListener("input", () => { this.place[k] = Number(input.value); this.moved(); });
    row.title = number.key;
    // Nothing was simulated of it: only "as given" knows another place.
    input.disabled = !this.swing && !this.data.terms.some((term) => term.weights.length === 1 && term.weights[0][0] === k);
    track.append(inner, input);
    row.append(name, output, track);
    this.sliders.push({ number, k, input, output });
    return row;
  }
  table() {
    const scroll = made("div", "scroll"), table = made("table", "knob-table"), head = table.createTHead().insertRow(), body = table.createTBody();
    scroll.tabIndex = 0;
    const centre = this.data.runs.some((run) => run.curves.length > 1);
    for (const title of ["run", "box, mm", ...(centre ? ["centre, mm"] : []), "misfit (chi squared a number)"]) { const cell = made("th", "", title); cell.scope = "col"; head.append(cell); }
    this.rows = this.data.runs.map((run) => {
      const row = body.insertRow();
      row.insertCell().textContent = run.name;
      return [...(centre ? [0, 1] : [0]), 2].map(() => row.insertCell());
    });
    scroll.append(table);
    return scroll;
  }
  left() {
    const fold = made("details", "plain"), pair = made("div", "pair");
    this.left_drawn = this.data.runs.map((run) => ["spectrum", "course"].map((kind) => left_plot(this.page, run, run.curves[0], kind)).filter(Boolean));
    pair.append(...this.left_drawn.flat().map((drawn) => drawn.figure));
    fold.append(made("summary", "", "What is left, by frequency and by time"), pair);
    fold.addEventListener("toggle", () => { draw_what_is_shown(); this.show_left(); });
    return fold;
  }
  show_left() { this.data.runs.forEach((run, r) => { for (const drawn of this.left_drawn[r]) drawn.show(this.answers[r].curves[0]); }); }
  lines() {
    const fold = made("details", "plain"), copy = made("button", "", "Copy");
    this.toml = made("pre");
    copy.type = "button";
    copy.addEventListener("click", () => {
      getSelection().selectAllChildren(this.toml);
      (navigator.clipboard?.writeText(this.toml.textContent) ?? Promise.reject()).catch(() => document.execCommand("copy")).then(() => { copy.textContent = "Copied"; });
      setTimeout(() => { copy.textContent = "Copy"; }, 1500);
    });
    fold.append(made("summary", "", "These numbers as lines of a setup"), this.toml, copy);
    return fold;
  }

  go(mode, place, as_stated) { this.mode = mode; this.place = [...place]; this.as_stated = as_stated; this.show_place(); }
  moved() {
    this.mode = "own";
    this.own = { place: [...this.place], as_stated: this.as_stated };
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => { this.waiting = false; this.show_place(); });
  }
  /// Names of what stands where nothing was simulated; the places of the buttons were.
  outside() {
    if (this.mode !== "own") return [];
    return this.data.numbers.filter((number, k) => { const slack = 1e-9 * (number.high - number.low); return this.place[k] < number.from - slack || this.place[k] > number.to + slack; }).map((number) => number.label);
  }
  show_place() {
    const answers = (this.answers = this.answers_at(this.place, this.as_stated)), [error] = this.errors_of(answers), outside = this.outside();
    root.classList.toggle("outside", outside.length > 0);
    this.error.textContent = Number.isFinite(error) ? `${in_digits(error, 3)} mm` : "the box runs away";
    this.page.knob_error = error;
    let chi2 = 0, count = 0;
    this.data.runs.forEach((run, r) => {
      const n = run.curves.reduce((sum, curve) => sum + curve.measured.filter((m) => m !== null).length, 0), cells = [...this.rows[r]];
      chi2 += answers[r].chi2;
      count += n;
      cells.pop().textContent = in_digits(answers[r].chi2 / n, 3);
      run.curves.forEach((curve, c) => {
        cells[c].textContent = in_digits(knob_model.error_of_curve(curve, answers[r].curves[c]), 3);
        for (const drawn of this.drawn[r][c]) drawn.show(answers[r].curves[c]);
      });
    });
    this.show_left();
    this.misfit.textContent = `chi squared ${in_digits(chi2, 4)} for ${count} numbers`;
    this.word.textContent = outside.length ? `Beyond what was simulated: ${outside.join(", ")}. The grey curve is a guess.` : "";
    for (const { number, k, input, output } of this.sliders) {
      input.value = this.place[k];
      output.textContent = spoken(number, this.place[k], 4);
      input.setAttribute("aria-valuetext", output.textContent);
    }
    for (const button of all("[data-mode]", this.host)) button.setAttribute("aria-pressed", button.dataset.mode === this.mode);
    this.back.disabled = !this.own;
    if (this.start) this.start.checked = this.as_stated;
    this.toml.textContent = setup_lines(this.data, this.place);
    this.draw_spark(error);
  }
  draw_spark(error) {
    if (Number.isFinite(error) && error > 0) this.history.push(error);
    this.history = this.history.slice(-80);
    const logs = this.history.map(Math.log), low = Math.min(...logs), high = Math.max(...logs, low + 0.05);
    const points = logs.map((l, i) => [4 + (192 * i) / Math.max(1, logs.length - 1), 40 - (36 * (l - low)) / (high - low)]);
    const [x, y] = points.at(-1) ?? [4, 40];
    const shape = (name, values) => { const element = document.createElementNS("http://www.w3.org/2000/svg", name); for (const [key, value] of Object.entries(values)) element.setAttribute(key, value); return element; };
    this.spark.replaceChildren(shape("polyline", { points: points.map((p) => p.map((v) => v.toFixed(1)).join(",")).join(" ") }), shape("circle", { cx: x.toFixed(1), cy: y.toFixed(1), r: 3 }));
  }
}

async function start_knobs(page) {
  const host = document.querySelector("[data-knobs]");
  if (!host) return;
  page.knobs = new Knobs(page, host, read_knobs(JSON.parse(new TextDecoder().decode(await unpack("knobs")))));
}
