// SPDX-License-Identifier: MIT
// What the knobs of a page do to the model: two ways from the place of every number to the curves of every run. A box with grains answers
// by what simulations at some places have shown (mean_at); a box alone is integrated here (swing_at). No part of the page is touched.
"use strict";

/// Shares of the columns at this place: each a power of a sum of what the numbers were moved by, a product of that, or a hill about the
/// numbers as given.
function shares_at(response, place) {
  const moved = response.numbers.map((number, k) => place[k] - number.best);
  return response.terms.map((term) => {
    if (term.power === 0) return Math.max(0, 1 - term.weights.reduce((sum, [k, weight]) => sum + (weight * (place[k] - response.numbers[k].given)) ** 2, 0)) ** 2;
    if (term.power === -1) return term.weights.reduce((all, [k, weight]) => all * weight * moved[k], 1);
    return term.weights.reduce((sum, [k, weight]) => sum + weight * moved[k], 0) ** term.power;
  });
}

/// Mean of the model, mm, of each curve of each run, and chi2 of each run.
function response_at(response, place) {
  const shares = shares_at(response, place);
  return response.runs.map((run) => {
    const left = [1, ...shares.map((share) => -share)];
    const chi2 = left.reduce((sum, a, i) => sum + a * left.reduce((row, b, k) => row + b * run.square[i][k], 0), 0);
    const curves = run.curves.map((curve) => {
      const mean = Float64Array.from(curve.best);
      shares.forEach((share, j) => {
        if (share === 0) return;
        const column = curve.columns[j];
        for (let i = 0; i < mean.length; ++i) mean[i] += share * column[i];
      });
      return mean;
    });
    return { curves, chi2 };
  });
}

/// A path-dependent friction that comes up over a length (Dahl): the resistance between two turns is a closed form.
class Joint {
  constructor(force, travel) { this.force = force; this.travel = travel; this.loaded = 0; this.start = 0; this.direction = 0; }
  resistance(x) {
    if (this.direction === 0) return this.loaded;
    return this.loaded - (this.direction * this.force - this.loaded) * Math.expm1(-this.direction * (x - this.start) / this.travel);
  }
  turn(x, direction) { this.loaded = this.resistance(x); this.start = x; this.direction = direction; }
}

/// All that acts on a box alone, from the values of the setup's keys (SI).
function forces_of(value) {
  const at = (key) => value[key] ?? 0, omega = 2 * Math.PI * at("spring.frequency"), stiffness = at("box.mass") * omega * omega;
  const mass = at("box.mass") + at("blade_mass.mass"), dahl = at("clamp_dahl_friction.force") > 0, rigid = 1e-5;
  const slips = dahl && at("clamp_dahl_friction.travel") < rigid;
  const reference = at("spring_cubic.reference") > 0 ? at("spring_cubic.reference") : at("release.displacement");
  const one_side = at("spring_quadratic.coefficient") ? at("spring_quadratic.coefficient") / at("spring_quadratic.reference") : 0;
  const length = value["pendulum.length"];
  const swings = [[at("second_mode.amplitude"), at("second_mode.frequency"), at("second_mode.phase"), at("second_mode.rate")],
    [at("oscillating_acceleration.amplitude.x"), at("oscillating_acceleration.frequency"), at("oscillating_acceleration.phase"), 0]].filter((one) => one[0]);
  const cubic = at("spring_cubic.coefficient") ? at("spring_cubic.coefficient") / (reference * reference) : 0;
  const damping = at("blade_viscous_damping.damping"), drag = at("blade_quadratic_drag.drag"), steady = mass * at("constant_acceleration.acceleration.x");
  return {
    mass, stiffness, dry: at("clamp_dry_friction.force") + (slips ? at("clamp_dahl_friction.force") : 0),
    joint: dahl && !slips ? new Joint(at("clamp_dahl_friction.force"), at("clamp_dahl_friction.travel")) : null,
    newton(x, v, t) {
      let force = -stiffness * x * (1 + cubic * x * x) - damping * v - drag * v * Math.abs(v) + steady - stiffness * one_side * x * x;
      if (Number.isFinite(length) && length > 0) force += stiffness * (x - length * Math.sin(x / length));
      for (const [amplitude, frequency, phase, rate] of swings) force += mass * amplitude * Math.exp(-rate * t) * Math.sin(2 * Math.PI * frequency * t + phase);
      return force;
    },
  };
}

/// Runge-Kutta of fourth order in equal steps that end where a friction turns; between steps a cubic. Positions, m, at these times, or null
/// where the box runs away.
function swing_of(forces, start, times, farthest) {
  const { mass, stiffness, dry, joint } = forces, turns = dry !== 0 || joint !== null, h = 2 * Math.PI * Math.sqrt(mass / stiffness) / 64;
  let now = { t: start.time, x: start.place, v: start.speed }, direction = 0, resting = false;
  const driving = (s) => forces.newton(s.x, s.v, s.t) - (joint ? joint.resistance(s.x) : 0);
  const acceleration = (s) => (resting ? 0 : (driving(s) - direction * dry) / mass);
  const set_off = (speed) => {
    const force = driving(now);
    direction = Math.sign(speed !== 0 ? speed : force) || 1;
    resting = speed === 0 && dry > 0 && Math.abs(force) <= dry;
    if (!resting && joint) joint.turn(now.x, direction);
  };
  const stepped = (step) => {
    const along = (part, v, a) => ({ t: now.t + part * step, x: now.x + part * step * v, v: now.v + part * step * a });
    const a1 = acceleration(now), s2 = along(0.5, now.v, a1), a2 = acceleration(s2), s3 = along(0.5, s2.v, a2), a3 = acceleration(s3);
    const s4 = along(1, s3.v, a3), a4 = acceleration(s4);
    return { t: now.t + step, x: now.x + step / 6 * (now.v + 2 * s2.v + 2 * s3.v + s4.v), v: now.v + step / 6 * (a1 + 2 * a2 + 2 * a3 + a4) };
  };
  const advance = () => {
    if (resting) {
      now = { ...now, t: now.t + h };
      if (!(Math.abs(driving(now)) <= dry)) set_off(0);
      return;
    }
    const next = stepped(h);
    if (!turns || next.v * direction >= 0) { now = next; return; }
    let low = 0, high = h, v_low = now.v, v_high = next.v, turn = next;
    for (let i = 0; i < 4 && Math.abs(turn.v) > 1e-12 * Math.abs(v_high - v_low); ++i) {
      const at = low + (high - low) * v_low / (v_low - v_high);
      turn = stepped(at);
      if (turn.v * direction >= 0) { low = at; v_low = turn.v; } else { high = at; v_high = turn.v; }
    }
    now = { ...(turn.t > now.t + 1e-6 * h ? turn : next), v: 0 };
    set_off(0);
  };
  if (turns) set_off(now.v);
  const places = new Float64Array(times.length), most = 4 * (times[times.length - 1] - start.time) / h + 1000;
  let filled = 0;
  for (let taken = 0; taken < most; ++taken) {
    const before = now;
    while (filled < times.length && times[filled] <= before.t) places[filled++] = before.x;
    if (filled === times.length) return places;
    advance();
    if (!(Math.abs(now.x) <= farthest) || !Number.isFinite(now.v)) return null;
    for (; filled < times.length && times[filled] <= now.t; ++filled) {
      const u = (times[filled] - before.t) / (now.t - before.t), w = 1 - u;
      places[filled] = w * w * (1 + 2 * u) * before.x + u * u * (3 - 2 * u) * now.x + (now.t - before.t) * u * w * (w * before.v - u * now.v);
    }
  }
  return null;
}

/// What the camera makes of a position of the box, m.
function seen_by(value, x, t) {
  const at = (key) => value[key] ?? 0, relative = x / 0.2;
  return (1 + at("camera_scale.scale")) * x * (1 + at("camera_tilt.tilt") * relative + at("camera_lens.distortion") * relative * relative)
    + at("camera_drift.drift") * t + at("camera_origin.origin");
}

/// The value of a number at its place on the slider: a length stands there by its inverse square, so that "none" has a place.
function value_at_place(number, place) { return number.inverse ? (place > 0 ? 1 / Math.sqrt(place) : Infinity) : place; }

/// The recorded positions as the equation of motion has them, mm, of each run, and chi2 by the noise of its frames. `as_stated`: let go at
/// rest from where the setup says, else from where the fit has found the box.
function swing_at(swing, place, as_stated) {
  const value = { ...swing.values };
  swing.numbers.forEach((number, k) => { value[number.key] = value_at_place(number, place[k]); });
  return swing.runs.map((run) => {
    const forces = forces_of({ ...value, "release.displacement": run.displacement }), [curve] = run.curves;
    const begin = as_stated ? { time: run.start, place: run.displacement, speed: 0 } : { time: run.start, place: run.place, speed: run.speed };
    const x = swing_of(forces, begin, curve.time, 10 * run.amplitude), origin = as_stated ? 0 : run.origin;
    const mean = new Float64Array(curve.time.length).fill(NaN);
    let chi2 = 0;
    for (let i = 0; x && i < mean.length; ++i) {
      mean[i] = 1e3 * (seen_by(value, x[i], curve.time[i]) + origin);
      if (curve.measured[i] !== null) chi2 += ((curve.measured[i] - mean[i]) / curve.spread[i]) ** 2;
    }
    return { curves: [mean], chi2: x ? chi2 : NaN };
  });
}

/// Root mean square of measured less model over all curves of this name, mm: each run counts alike, as in the program's own table where
/// `each_alike`, else each number.
function error_of(knobs, answers, name, each_alike) {
  let squares = 0, count = 0;
  knobs.runs.forEach((run, r) => run.curves.forEach((curve, c) => {
    if (curve.name !== name) return;
    let sum = 0, n = 0;
    curve.measured.forEach((measured, i) => { if (measured !== null) { sum += (measured - answers[r].curves[c][i]) ** 2; ++n; } });
    if (n === 0) return;
    squares += each_alike ? sum / n : sum;
    count += each_alike ? 1 : n;
  }));
  return count > 0 ? Math.sqrt(squares / count) : NaN;
}

/// Of one curve, mm.
function error_of_curve(curve, mean) {
  let sum = 0, n = 0;
  curve.measured.forEach((measured, i) => { if (measured !== null) { sum += (measured - mean[i]) ** 2; ++n; } });
  return n > 0 ? Math.sqrt(sum / n) : NaN;
}

globalThis.knob_model = { response_at, swing_at, swing_of, forces_of, error_of, error_of_curve, value_at_place };
