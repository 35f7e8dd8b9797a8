#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""An outside code for `shakedown run SETUP --engine command:harness/outside/example/damper.py`: soft spheres in plain Python.
Usage: damper.py SETUP.json MOTION.csv. Exit code 2 with a sentence on standard error: it cannot model this setup."""
import json, math, sys

KNOWN = ("blade_viscous_damping",)  # effects that this code has


def spring_dashpot(restitution, mass, time):
    """Constants of a contact of this duration, N/m and N s/m (Schaefer, Dippel, Wolf 1996)."""
    decay = -math.log(max(restitution, 1e-4)) / time
    return mass * ((math.pi / time) ** 2 + decay**2), 2 * mass * decay


def forces(place, speed, box, setup, near, laws):
    """On grains (N, three each) and on the box (N, along x) by contacts and its spring."""
    (x, v), force = box, [[0.0, 0.0, 0.0] for _ in place]
    reach = setup["grains"][0]["radius"] if place else 0.0
    push = -setup["spring"]["stiffness"] * x - laws["viscous"] * v
    for i, j in near:
        d = [a - b for a, b in zip(place[i], place[j])]
        away = math.hypot(*d)
        if away < 2 * reach:
            n = [c / away for c in d]
            closing = -sum(c * (a - b) for c, a, b in zip(n, speed[i], speed[j]))
            f = laws["pair"][0] * (2 * reach - away) + laws["pair"][1] * closing
            for k in range(3):
                force[i][k] += f * n[k]
                force[j][k] -= f * n[k]
    for i, (p, u) in enumerate(zip(place, speed)):
        for k in range(3):
            shift, moves = (x, v) if k == 0 else (0.0, 0.0)
            beyond = abs(p[k] - shift) + reach - laws["half"][k]
            if beyond > 0:
                side, (stiff, damp) = math.copysign(1, p[k] - shift), laws["end" if k == 0 else "side"]
                f = -side * stiff * beyond - damp * (u[k] - moves)
                force[i][k] += f
                push -= f if k == 0 else 0.0
    return force, push


def run(setup, table):
    box, M = [setup["box"]["position"], setup["box"]["velocity"]], setup["box"]["mass"]
    place, speed = [[list(g[key]) for g in setup["grains"]] for key in ("position", "velocity")]
    count, m = len(place), setup["grains"][0]["mass"] if setup["grains"] else 1.0
    e, time = setup["restitution"], setup["contact_time"]
    laws = {"pair": spring_dashpot(e["grain_grain"], m / 2, time), "end": spring_dashpot(e["grain_wall"], m * M / (m + M), time)}
    laws |= {"side": spring_dashpot(e["grain_wall"], m, time), "half": [w / 2 for w in (setup["box"]["length"], *setup["box"]["width"])]}
    laws["viscous"] = sum(effect["parameters"]["damping"] for effect in setup["effects"])
    steps = math.ceil(setup["steps_per_contact"] / time / setup["sample_rate"]) if count else 20
    h, pairs = 1 / setup["sample_rate"] / steps, [(i, j) for i in range(count) for j in range(i)]
    near, force, push = [], *forces(place, speed, box, setup, pairs, laws)
    for row in range(setup["rows"]):
        centre = sum(p[0] for p in place) / count if count else 0.0
        table.write(f"{row / setup['sample_rate']:.9g},{box[0]:.17g},{box[1]:.17g},{centre:.17g}\n")
        for step in range(steps * (row + 1 < setup["rows"])):  # velocity Verlet
            if step % 10 == 0:  # grains slower than 4 m/s cannot meet sooner unless they are in this list
                wide = 2 * setup["grains"][0]["radius"] + 20 * 4 * h if count else 0.0
                near = [(i, j) for i, j in pairs if abs(place[i][0] - place[j][0]) < wide and math.dist(place[i], place[j]) < wide]
            box[1] += h / 2 * push / M
            box[0] += h * box[1]
            for p, u, f in zip(place, speed, force):
                for k in range(3):
                    u[k] += h / 2 * f[k] / m
                    p[k] += h * u[k]
            force, push = forces(place, speed, box, setup, near, laws)
            box[1] += h / 2 * push / M
            for u, f in zip(speed, force):
                for k in range(3):
                    u[k] += h / 2 * f[k] / m


def main(question, answer):
    setup = json.load(open(question))
    unknown = [effect["name"] for effect in setup["effects"] if effect["name"] not in KNOWN]
    if setup["format"] != 1 or setup["domain"] != "damper" or unknown:
        sys.exit(print("damper.py models a damper with", *KNOWN, "only, not", *unknown or [setup["domain"]], file=sys.stderr) or 2)
    with open(answer, "w") as table:
        table.write("t_s,x_box_m,v_box_m_s,x_com_m\n")
        run(setup, table)


main(*sys.argv[1:3])
