// SPDX-License-Identifier: MIT
// The grains in their box, drawn as shaded discs with the depth of spheres (WebGL 2). Between two points of a track everything flies
// straight, so any moment, however slow the clock, is interpolated without inventing anything.
"use strict";

/// Tracks: for each grain, then the box, columns of zigzag 7-bit numbers: time step * 4 + class, then steps of x, y, z.
function read_tracks(bytes, replay) {
  let at = 0;
  const number = () => {
    let value = 0, scale = 1, byte;
    do { byte = bytes[at++]; value += (byte & 127) * scale; scale *= 128; } while (byte > 127);
    return value;
  };
  const signed = () => { const n = number(); return n % 2 ? -(n + 1) / 2 : n / 2; };
  return replay.points.map((count) => {
    const track = { t: new Float64Array(count), x: new Float32Array(count), y: new Float32Array(count), z: new Float32Array(count), c: new Uint8Array(count), at: 0 };
    let time = 0;
    for (let i = 0; i < count; ++i) {
      const n = number();
      track.c[i] = n % 4;
      time += Math.floor(n / 4);
      track.t[i] = time * replay.tq;
    }
    for (const axis of ["x", "y", "z"]) {
      let sum = 0;
      for (let i = 0; i < count; ++i) track[axis][i] = (sum += signed()) * replay.xq;
    }
    return track;
  });
}

/// Index of the last point at or before t.
function find(track, t) {
  let i = track.at;
  if (track.t[i] > t || t - track.t[i] > 0.5) {
    let low = 0, high = track.t.length - 1;
    while (low < high) { const middle = (low + high + 1) >> 1; if (track.t[middle] <= t) low = middle; else high = middle - 1; }
    i = low;
  }
  while (i + 1 < track.t.length && track.t[i + 1] <= t) ++i;
  return (track.at = i);
}

const sphere_vertex = `#version 300 es
layout(location=0) in vec2 corner; layout(location=1) in vec4 centre; layout(location=2) in vec4 tint;
uniform mat3 turn; uniform vec3 scale; uniform vec2 shift; out vec2 at; out vec3 colour; out float depth; out float thick;
void main() { vec3 p = turn * centre.xyz; at = corner; colour = tint.rgb; thick = centre.w * scale.z; depth = p.z * scale.z;
  gl_Position = vec4((p.xy + corner * centre.w) * scale.xy + shift, 0.0, 1.0); }`;
const sphere_fragment = `#version 300 es
precision highp float; in vec2 at; in vec3 colour; in float depth; in float thick; out vec4 result;
void main() { float r2 = dot(at, at); if (r2 > 1.0) discard; float h = sqrt(1.0 - r2);
  gl_FragDepth = 0.5 - 0.5 * (depth + h * thick);
  float light = 0.42 + 0.58 * max(0.0, dot(vec3(at, h), normalize(vec3(-0.35, 0.6, 0.75))));
  float edge = smoothstep(1.0, 0.86, r2); result = vec4(colour * light * mix(0.62, 1.0, edge), 1.0); }`;
const line_vertex = `#version 300 es
layout(location=0) in vec3 point; uniform mat3 turn; uniform vec3 scale; uniform vec2 shift; uniform vec3 offset;
void main() { vec3 p = turn * (point + offset); gl_Position = vec4(p.xy * scale.xy + shift, -p.z * scale.z, 1.0); }`;
const line_fragment = `#version 300 es
precision highp float; uniform vec4 colour; out vec4 result; void main() { result = colour; }`;

function program(gl, vertex, fragment) {
  const made = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
  return { made, uniform: (name) => gl.getUniformLocation(made, name) };
}

const speed_colours = [[13, 47, 102], [63, 95, 143], [138, 134, 120], [209, 184, 90], [255, 233, 69]];
function colour_of_speed(fraction, to, k) {
  const f = Math.min(Math.max(fraction, 0), 1) * (speed_colours.length - 1), i = Math.min(Math.floor(f), speed_colours.length - 2);
  for (let c = 0; c < 3; ++c) to[k + c] = (speed_colours[i][c] + (speed_colours[i + 1][c] - speed_colours[i][c]) * (f - i)) / 255;
}
function rgb(text) {
  const digits = text.replace("#", "");
  return [0, 2, 4].map((i) => parseInt(digits.slice(i, i + 2), 16) / 255);
}

function box_edges(lx, ly, lz) {
  const points = [], corner = (k) => [(k & 1 ? lx : -lx) / 2, (k & 2 ? ly : -ly) / 2, (k & 4 ? lz : -lz) / 2];
  for (let a = 0; a < 8; ++a) for (const bit of [1, 2, 4]) if (!(a & bit)) points.push(...corner(a), ...corner(a | bit));
  return new Float32Array(points);
}

class Scene {
  constructor(canvas, replay, tracks) {
    this.canvas = canvas; this.replay = replay; this.tracks = tracks;
    this.yaw = 0.38; this.pitch = 0.36; this.by_class = false; this.follow = false;
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: true, preserveDrawingBuffer: true });
    if (!gl) throw new Error("no WebGL 2");
    this.gl = gl;
    this.spheres = program(gl, sphere_vertex, sphere_fragment);
    this.lines = program(gl, line_vertex, line_fragment);
    const grains = tracks.length - 1;
    this.instances = new Float32Array(grains * 8);
    const buffer = (data, usage) => { const b = gl.createBuffer(); gl.bindBuffer(gl.ARRAY_BUFFER, b); gl.bufferData(gl.ARRAY_BUFFER, data, usage); return b; };
    this.quad = gl.createVertexArray();
    gl.bindVertexArray(this.quad);
    buffer(new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0); gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
    this.instance_buffer = buffer(this.instances, gl.DYNAMIC_DRAW);
    for (const [place, offset] of [[1, 0], [2, 16]]) {
      gl.enableVertexAttribArray(place); gl.vertexAttribPointer(place, 4, gl.FLOAT, false, 32, offset); gl.vertexAttribDivisor(place, 1);
    }
    this.make_lines(buffer);
  }
  make_lines(buffer) {
    const gl = this.gl, { length, width, height, reach } = this.replay, rail = [];
    rail.push(-reach, -height / 2, 0, reach, -height / 2, 0);
    for (let mm = -Math.floor(reach / 0.05) * 50; mm / 1000 <= reach; mm += 50)
      rail.push(mm / 1000, -height / 2, -0.003, mm / 1000, -height / 2, mm === 0 ? 0.012 : 0.003);
    const array = (data) => { const a = gl.createVertexArray(); gl.bindVertexArray(a); buffer(data, gl.STATIC_DRAW); gl.enableVertexAttribArray(0); gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0); return { a, count: data.length / 3 }; };
    this.box = array(box_edges(length, height, width));
    this.rail = array(new Float32Array(rail));
  }
  /// Turn of the view; lab x to the right, z (height in the page) up.
  view() {
    const cy = Math.cos(this.yaw), sy = Math.sin(this.yaw), cp = Math.cos(this.pitch), sp = Math.sin(this.pitch);
    return new Float32Array([cy, sp * sy, -cp * sy, 0, cp, sp, sy, -sp * cy, cp * cy]);
  }
  draw(t, measured_x) {
    const { gl, canvas, replay, tracks } = this, ratio = Math.min(devicePixelRatio || 1, 2);
    const w = Math.round(canvas.clientWidth * ratio), h = Math.round(canvas.clientHeight * ratio);
    if (!w || !h) return;
    if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
    const classes = [0, 1, 2, 3].map((k) => rgb(getComputedStyle(document.documentElement).getPropertyValue("--c" + k).trim()));
    const n = tracks.length - 1;
    for (let g = 0; g < n; ++g) {
      const track = tracks[g], i = find(track, t), j = Math.min(i + 1, track.t.length - 1), dt = track.t[j] - track.t[i];
      const f = dt > 0 ? Math.min(Math.max((t - track.t[i]) / dt, 0), 1) : 0, k = 8 * g;
      const dx = track.x[j] - track.x[i], dy = track.y[j] - track.y[i], dz = track.z[j] - track.z[i];
      this.instances[k] = track.x[i] + f * dx; this.instances[k + 1] = track.z[i] + f * dz; this.instances[k + 2] = -(track.y[i] + f * dy);
      this.instances[k + 3] = replay.radius[g];
      if (this.by_class) this.instances.set(classes[track.c[i]], k + 4);
      else colour_of_speed(dt > 0 ? Math.hypot(dx, dy, dz) / dt / replay.top_speed : 0, this.instances, k + 4);
      this.instances[k + 7] = 1;
    }
    const box = tracks[n], i = find(box, t), j = Math.min(i + 1, box.t.length - 1), dt = box.t[j] - box.t[i];
    const x_box = box.x[i] + (dt > 0 ? Math.min(Math.max((t - box.t[i]) / dt, 0), 1) : 0) * (box.x[j] - box.x[i]);
    const dark = rgb(getComputedStyle(document.documentElement).getPropertyValue("--paper").trim())[0] < 0.5;
    const turn = this.view(), aspect = w / h, depth = 1 / (3 * replay.reach);
    // The whole way of the box fills the width; who follows the box looks at it alone.
    const half = this.follow ? 0.62 * replay.length + 0.5 * replay.width : replay.reach, tilt = Math.abs(Math.cos(this.yaw));
    const across = half * tilt + 0.5 * replay.width * Math.abs(Math.sin(this.yaw)), up = (0.5 * replay.height + half * Math.abs(Math.sin(this.yaw) * Math.sin(this.pitch))) * 1.12;
    const zoom = 0.97 / Math.max(across, up * aspect), shift = [this.follow ? -x_box * turn[0] * zoom : 0, this.follow ? -x_box * turn[1] * zoom * aspect : 0];
    const scale = [zoom, zoom * aspect, depth];
    gl.viewport(0, 0, w, h); gl.clearColor(0, 0, 0, 0); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT); gl.enable(gl.DEPTH_TEST);
    gl.useProgram(this.spheres.made);
    gl.uniformMatrix3fv(this.spheres.uniform("turn"), false, turn); gl.uniform3fv(this.spheres.uniform("scale"), scale); gl.uniform2f(this.spheres.uniform("shift"), ...shift);
    gl.bindVertexArray(this.quad); gl.bindBuffer(gl.ARRAY_BUFFER, this.instance_buffer); gl.bufferSubData(gl.ARRAY_BUFFER, 0, this.instances);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, n);
    gl.useProgram(this.lines.made);
    gl.uniformMatrix3fv(this.lines.uniform("turn"), false, turn); gl.uniform3fv(this.lines.uniform("scale"), scale); gl.uniform2f(this.lines.uniform("shift"), ...shift);
    const stroke = (shape, x, red, green, blue, alpha) => {
      gl.uniform3f(this.lines.uniform("offset"), x, 0, 0); gl.uniform4f(this.lines.uniform("colour"), red, green, blue, alpha);
      gl.bindVertexArray(shape.a); gl.drawArrays(gl.LINES, 0, shape.count);
    };
    const grey = dark ? 0.45 : 0.62;
    stroke(this.rail, 0, grey, grey, grey, 1);
    const model = dark ? [0.38, 0.71, 0.94] : [0, 0.40, 0.66];
    stroke(this.box, x_box, ...model, 1);
    if (measured_x !== null) stroke(this.box, measured_x, ...(dark ? [0.95, 0.94, 0.91] : [0.11, 0.12, 0.14]), 1);
  }
}

function value_at(times, values, t) {
  if (!times.length || t < times[0] || t > times[times.length - 1]) return null;
  let low = 0, high = times.length - 1;
  while (high - low > 1) { const middle = (low + high) >> 1; if (times[middle] <= t) low = middle; else high = middle; }
  if (values[low] === null || values[high] === null) return null;
  const f = times[high] > times[low] ? (t - times[low]) / (times[high] - times[low]) : 0;
  return values[low] + f * (values[high] - values[low]);
}

/// Nothing is unpacked before it is looked at.
function start_replay(page, replay, index) {
  let begun = null;
  return {
    group: replay.group,
    async shown(yes) {
      if (yes && !begun) begun = begin_replay(page, replay, index);
      if (begun) (await begun).shown(page.group === replay.group);
    },
  };
}

async function begin_replay(page, replay, index) {
  const host = document.querySelector(`[data-replay="${index}"]`), canvas = host.querySelector("canvas");
  const quiet = { shown() {} };
  let scene;
  try {
    scene = new Scene(canvas, replay, read_tracks(await unpack("replay-" + index), replay));
  } catch (error) {
    const message = document.createElement("p");
    message.className = "message";
    message.textContent = "The grains cannot be drawn here: this browser offers no WebGL 2 (" + error.message + "). Plots and tables are complete without it.";
    canvas.replaceWith(message);
    host.querySelector(".controls")?.classList.add("hidden");
    return quiet;
  }
  const times = numbers(replay.measured.t), places = numbers(replay.measured.x);
  const slider = host.querySelector("input[type=range]"), clock = host.querySelector("output"), play = host.querySelector("[data-play]");
  slider.max = replay.duration;
  let shown = false, last = 0;
  const draw = (t) => {
    if (!shown) return;
    scene.draw(t, value_at(times, places, t));
    slider.value = t;
    const pace = Number(host.querySelector("[data-pace]").value);
    clock.textContent = t.toFixed(pace < 0.05 ? 5 : 3) + " s";
  };
  page.onTime(draw);
  const step = (now) => {
    if (!page.playing || !shown) return;
    const next = page.time + Math.min((now - last) / 1000, 0.1) * Number(host.querySelector("[data-pace]").value);
    last = now;
    page.setTime(next >= replay.duration ? 0 : next);
    requestAnimationFrame(step);
  };
  const toggle = () => {
    page.playing = !page.playing;
    play.textContent = page.playing ? "Pause" : "Play";
    play.setAttribute("aria-pressed", page.playing);
    last = performance.now();
    if (page.playing) requestAnimationFrame(step);
  };
  play.addEventListener("click", toggle);
  slider.addEventListener("input", () => page.setTime(Number(slider.value)));
  host.querySelector("[data-colour]").addEventListener("change", (event) => {
    scene.by_class = event.target.value === "class";
    host.querySelector(".scale.of-speed").classList.toggle("hidden", scene.by_class);
    host.querySelector(".scale.of-class").classList.toggle("hidden", !scene.by_class);
    draw(page.time);
  });
  host.querySelector("[data-view]").addEventListener("change", (event) => { scene.follow = event.target.value === "box"; draw(page.time); });
  let grip = null;
  canvas.addEventListener("pointerdown", (event) => { grip = [event.clientX, event.clientY, scene.yaw, scene.pitch]; canvas.setPointerCapture(event.pointerId); });
  canvas.addEventListener("pointermove", (event) => {
    if (!grip) return;
    scene.yaw = grip[2] + (event.clientX - grip[0]) * 0.008;
    scene.pitch = Math.min(Math.max(grip[3] + (event.clientY - grip[1]) * 0.008, -1.5), 1.5);
    draw(page.time);
  });
  canvas.addEventListener("pointerup", () => { grip = null; });
  canvas.addEventListener("keydown", (event) => {
    const turn = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[event.key];
    if (event.key === " ") toggle();
    else if (turn) { scene.yaw += turn[0]; scene.pitch += turn[1]; draw(page.time); }
    else return;
    event.preventDefault();
  });
  new ResizeObserver(() => draw(page.time)).observe(canvas);
  return { shown(yes) { shown = yes; if (yes) draw(page.time); } };
}
