# SPDX-License-Identifier: MIT
"""Cases of an exam: experiments with something hidden, of which the asker sees setup.toml, experiment.toml and tables.

Two laboratories make them. exam.py, beside the project where it is, shares no code with the program. `shakedown hide` (soft
contacts, its own film) is part of the program and stands in where that is missing. Both leave the folders c000, c001 ... and
truth.sealed: base64 of deflated JSON, {case: {kind, hidden, laboratory, camera, damper}}, so that nobody reads it by accident."""
import base64, hashlib, json, math, pathlib, random, shutil, subprocess, sys, tempfile, time, zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
KINDS = dict(nothing=.12, parameters=.08, one=.45, two=.2, unlisted=.15)  # as often as exam.py draws them
INSIDE_THE_CONTACTS = .7  # of effects: what only ensembles of runs see, no balance of forces
# Times the typical strength. CI may not hang on what nobody can know, and weaker ones of what acts inside the contacts are
# that (bench/results/2026-11-24-what-the-exam-asks.md).
STRENGTHS = (1, 4)
PAPERS_DAMPER = .6        # of cases; the others have a damper of their own
USUAL_NOISE = "noise.box=0.2mm,noise.centre=0.5mm,fps=500"
CAMERAS = {  # name -> how often, and what `shakedown hide --camera` is told
    "perfect": (.15, USUAL_NOISE),
    "lab": (.15, "noise.box=0.1mm,noise.centre=0.3mm,fps=500,lens=0.1%,shutter=0.5ms,near=0.2%,wander=10um/0.3s,"
                 "trigger=0.3ms,release=0.1mm"),
    "good": (.35, USUAL_NOISE + ",missing=0.01,lens=0.3%,shutter=1.5ms,near=0.4%,wander=20um/0.3s,trigger=1ms,release=0.3mm"),
    "phone": (.35, "noise.box=0.4mm,noise.centre=1mm,fps=240,missing=0.03,lens=1%,shutter=6ms,near=1%,wander=50um/0.5s,"
                   "trigger=2ms,release=0.5mm")}
# How a run was made, not a law: no answer is asked for it.
NOT_PHYSICS = {"initial_packing", "initial_box_velocity", "blade_mass"}


def exam_script():
    """exam.py where it is beside the project, or beside the folder that holds it; None: the program's laboratory draws."""
    found = [p for p in (ROOT / "../shared/exam/exam.py", ROOT / "../../shared/exam/exam.py") if p.is_file()]
    return found[0].resolve() if found else None


def laboratory_line(script):
    """Which laboratory it is, for the record."""
    return f"exam.py, sha256 {hashlib.sha256(script.read_bytes()).hexdigest()[:12]}" if script else "shakedown hide --engine soft"


def read_truth(cases):
    return json.loads(zlib.decompress(base64.b64decode((cases / "truth.sealed").read_bytes())))


def write_truth(cases, truth):
    (cases / "truth.sealed").write_bytes(base64.b64encode(zlib.compress(json.dumps(truth).encode())))


def log_uniform(r, low, high):
    return math.exp(r.uniform(math.log(low), math.log(high)))


def draw_by_script(script, seed, count, cases, perfect):
    """Runs exam.py; a case is complete when the next one stands there or truth.sealed does."""
    words = [sys.executable, str(script), "draw", str(seed), str(count),
             str(cases)] + (["--perfect"] if perfect else [])
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)


# ---- the program's own laboratory ----


def drawn_damper(r):
    d = dict(M=434., f=1.23, D0=107.5, N=37, L=[40, 40, 65, 85, 104])
    if r.random() >= PAPERS_DAMPER:
        d = dict(M=round(log_uniform(r, 150, 1200), 1), f=round(log_uniform(r, .7, 2.5), 3),
                 D0=round(r.uniform(50, 140), 1), N=r.randint(12, 80))
        layers = math.ceil(d["N"] / 18)  # of 18 grains, 7.1 mm apart in the densest packing
        d["L"] = [round(10 + 7.1 * (layers - 1) + gap * d["D0"] + 2) for gap in (.2, .2, .42, .6, .78)]
    return d


def scale_of(unit, d):
    """How forces on the box grow from the paper's damper to this one; what happens in contacts stays."""
    m, f, reach = d["M"] / 434, d["f"] / 1.23, d["D0"] / 107.5
    return {"N": m * f * f * reach, "N s/m": m * f, "N s^2/m^2": m / reach, "m/s^2": f * f * reach, "m/s": f * reach,
            "Hz": f, "m": reach}.get(unit, 1)


def parameter(effect, name):
    return next(p for p in effect["parameters"] if p["name"] == name.split(".")[0])


def hidden_strength(r, effect, d, walls):
    """NAME=parameter:value,... for `shakedown hide`: one to four times the typical strength of its record, log-uniform."""
    strength = r.choice(effect["search"]["strengths"])
    names, times = strength["parameters"].split("&"), log_uniform(r, *STRENGTHS)
    p = parameter(effect, names[0])
    typical = strength["typical"] or p["typical"]
    if effect["acts_on"] in ("box", "all"):
        typical *= scale_of(p["unit"], d)
    size = typical / times if strength.get("inverse") else typical * times
    if strength["strongest"] and not strength.get("inverse"):
        size = math.copysign(min(abs(size), abs(strength["strongest"])), size)
    if (p["low"] is None or p["low"] < 0) and not strength.get("absent_key"):
        size *= r.choice((-1, 1))
    value = size + (walls if strength.get("absent_key") else 0)
    low, high = p["low"], p["high"]
    value = max(value, low) if low is not None else value
    value = min(value, high) if high is not None else value
    parts = [f"{name}:{value:.6g} {p['unit']}".rstrip() for name in names]
    for q in effect["parameters"]:  # a length without which the law has no strength
        if q["required"] and q["kind"] == "number" and q["name"] not in names:
            parts.append(f"{q['name']}:{q['typical'] * log_uniform(r, 1 / 3, 3):.6g} {q['unit']}".rstrip())
    if {"Hz", "rad"} <= {q.get("unit") for q in effect["parameters"]}:  # it oscillates
        tone = {"Hz": d["f"] * log_uniform(r, .15, 1.6), "rad": r.uniform(0, 6.28)}
        parts += [f"{q['name']}:{tone[q['unit']]:.6g} {q['unit']}" for q in effect["parameters"] if q.get("unit") in tone]
    return effect["name"] + "=" + ",".join(parts)


def unlisted_force(r, effect, d):
    """A force on the box that no list has: a brake in one place, a stop, a saw-tooth push, a brake now and then."""
    reach, stiffness = d["D0"] * 1e-3, d["M"] * 1e-3 * (2 * math.pi * d["f"]) ** 2
    brake = d["M"] * 1e-3 * 2 * math.pi * d["f"] * log_uniform(r, .05, .25)
    push, stop, end = stiffness * reach * log_uniform(r, .01, .05), stiffness * log_uniform(r, .5, 3), reach * r.uniform(.5, .8)
    place, width = r.choice((-1, 1)) * reach * r.uniform(.2, .6), reach * r.uniform(.08, .2)
    period = r.uniform(.8, 3) / d["f"]
    law = r.choice((f"-{brake:.4g}*v/(1+((x-({place:.4g}))/{width:.4g})^4)", f"-{stop:.4g}*(x-{end:.4g})*(x>{end:.4g})",
                    f"{push:.4g}*(t/{period:.4g}-rint(t/{period:.4g}))", f"-{brake:.4g}*v*(sin({6.2832 / period:.4g}*t)>0)"))
    text = next(p["name"] for p in effect["parameters"] if p["kind"] == "text")
    return f"{effect['name']}={text}:{law}"


def drawn_case(seed, number, effects, perfect, tried):
    """Arguments of `shakedown hide`, the damper, and what is to be sealed. Same arguments, same case."""
    r = random.Random(f"{seed} {number} {tried}")
    d = drawn_damper(r)
    kind = r.choices(list(KINDS), list(KINDS.values()))[0]
    camera = "perfect" if perfect else r.choices(list(CAMERAS), [c[0] for c in CAMERAS.values()])[0]
    known = [e for e in effects if e["acts_on"] != "camera" and "strengths" in e["search"] and not e.get("needs") and e["name"] not in NOT_PHYSICS]
    formula = next(e for e in effects if any(p["kind"] == "text" for p in e["parameters"]))
    sets, hidden, effect_words, walls = [f"soft.contact_time={log_uniform(r, .15, .4):.4g} ms"], [], [], .76
    if not perfect:
        sets.append(f"box.mass={d['M'] * (1 + r.gauss(0, .005)):.2f} g")
    if kind == "parameters" or (kind != "nothing" and r.random() < .5):
        walls = round(r.uniform(.6, .88), 3)
        sets += [f"restitution.grain_grain={r.uniform(.6, .9):.3f}", f"restitution.grain_wall={walls}",
                 f"spring.frequency={d['f'] * r.uniform(.992, 1.008):.4f} Hz"]
    if kind in ("one", "two"):
        inside = [e for e in known if e["acts_on"] in ("contact", "grains")]
        first = r.choice(inside if r.random() < INSIDE_THE_CONTACTS else [e for e in known if e not in inside])
        chosen = [first] + ([r.choice([e for e in known if e is not first])] if kind == "two" else [])
        hidden = sorted(e["name"] for e in chosen)
        effect_words = [hidden_strength(r, e, d, walls) for e in chosen]
    if kind == "unlisted":
        hidden, effect_words = ["unknown"], [unlisted_force(r, formula, d)]
    words = ["--engine", "soft", "--lengths", ",".join(f"{length}mm" for length in d["L"]), "--duration", "12 s",
             "--seed", str(r.randrange(10 ** 8)), "--camera", CAMERAS[camera][1]]
    for option, values in (("--effect", effect_words), ("--set", sets)):
        for value in values:
            words += [option, value]
    return words, d, dict(kind=kind, hidden=hidden, laboratory=dict(effects=effect_words, set=sets), camera=camera,
                          damper=d)


def setup_text(d):
    return (f'[box]\nmass = "{d["M"]} g"\nlength = "{d["L"][0]} mm"\nwidth = ["50 mm", "50 mm"]\n'
            f'[spring]\nfrequency = "{d["f"]} Hz"\n[grains]\ncount = {d["N"]}\ndiameter = "10 mm"\nmass = "4.04 g"\n'
            f'[restitution]\ngrain_grain = 0.75\ngrain_wall = 0.76\n[release]\ndisplacement = "{d["D0"]} mm"\n'
            f'[run]\nduration = "12 s"\nseed = 1\n')


def effects_of(program):
    return json.loads(subprocess.run([program, "effects", "--json", "-"], check=True, capture_output=True,
                                     text=True).stdout)


def draw_one(program, effects, seed, number, folder, perfect):
    """Makes the folder of one case and returns what is to be sealed. What does not fit (a grain that finds no place) is drawn again."""
    for tried in range(20):
        words, d, sealed = drawn_case(seed, number, effects, perfect, tried)
        with tempfile.TemporaryDirectory() as scratch:
            base, truth = pathlib.Path(scratch) / "base.toml", pathlib.Path(scratch) / "truth.json"
            base.write_text(setup_text(d))
            made = subprocess.run([program, "hide", str(base), "--out", str(folder), "--truth", str(truth), "--title",
                                   f"exam {seed}, {folder.name}", "--threads", "1"] + words, capture_output=True, text=True)
        if made.returncode == 0:
            return sealed
        shutil.rmtree(folder, ignore_errors=True)
        if made.returncode not in (2, 3):
            break
    raise RuntimeError(f"case {number} could not be made: shakedown hide {' '.join(words)}\n{made.stderr.strip()}")


def wait_until_drawn(cases, number, drawing):
    """Until the case is complete. `drawing`: whether somebody is still at it."""
    while not (cases / "truth.sealed").exists() and not (cases / f"c{number + 1:03}").exists():
        if not drawing():
            raise RuntimeError("the cases could not be drawn")
        time.sleep(.5)
