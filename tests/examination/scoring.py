# SPDX-License-Identifier: MIT
"""Answers of a diagnosis against what was hidden, counted as exam.py counts (a test holds the two together where exam.py is there).

Only what acts on box and grains is judged. Right: the physics named is the physics hidden. In set: it is among the answers that hold
95 % together. Log score: -ln of the probability that was given to the truth, at least one in a thousand (0 is perfect; a guess among
thirty is 3.4). Invented: something is named that is not there."""
import math

from drawing import CAMERAS, KINDS, NOT_PHYSICS

LEAST_PROBABILITY = .001  # of the log score: one answer that was sure and wrong must not outweigh all others
QUANTILE = 1.96           # of the normal distribution, two-sided 95 %
SAID = ((0, .5), (.5, .8), (.8, .95), (.95, 1.01))  # rows of the reliability table

# What share of the cases the program answers right in so little time: 17 of the 36 that it answered of seed 41017, a minute of one
# core each (bench/results/2026-11-25-exam-seed-41017.md). Raise it when the program is better.
SHARE_RIGHT = .47
# How often chance may stop such a program.
STOPPED_BY_CHANCE = .01


def fewest_right(asked):
    """The bar. The largest number of right answers that a program of SHARE_RIGHT falls short of at most once in a hundred times.

    Of eight cases it is one: none is right with 0.53^8 = 0.0062, fewer than two with 0.0504. At 0.6 it is two."""
    fewer = 0
    for bar in range(asked + 1):
        fewer += math.comb(asked, bar) * SHARE_RIGHT ** bar * (1 - SHARE_RIGHT) ** (asked - bar)
        if fewer > STOPPED_BY_CHANCE:
            return bar
    return asked


def physical(names):
    return tuple(sorted(n for n in set(names) if n not in NOT_PHYSICS and not n.startswith("camera_")))


def key_of(effects):
    return ("unknown",) if "unknown" in effects else physical(effects)


def broke_down(answer):
    return answer.get("verdict", "exit").startswith("exit")


def judged(case, truth, answer, seconds):
    """One row: what was hidden, what was answered, and how they compare."""
    want = tuple(truth["hidden"])
    got = ("unknown",) if answer.get("verdict") == "unknown" else physical(answer.get("missing", []))
    chance = {}
    for h in answer.get("hypotheses", []):
        chance[key_of(h["effects"])] = chance.get(key_of(h["effects"]), 0) + h["probability"]
    best = max(chance, key=chance.get) if chance else None
    lost = broke_down(answer)
    return dict(case=case, kind=truth["kind"], camera=truth["camera"], laboratory=truth["laboratory"],
                other=truth["damper"]["f"] != 1.23, want=want, got=got, right=got == want and not lost,
                among=want in {key_of(h["effects"]) for h in answer.get("answer_set", [])}, p=chance.get(want, 0),
                top=chance[best] if chance else 0, top_right=best is not None and best == want,
                verdict=answer.get("verdict", ""), lost=lost, seconds=seconds)


def log_score(row):
    return -math.log(max(row["p"], LEAST_PROBABILITY))


def invented(row):
    return bool(set(row["got"]) - set(row["want"]) - {"unknown"})


def mean(values):
    values = list(values)
    return sum(values) / len(values) if values else math.nan


def median(values):
    return sorted(values)[len(values) // 2] if values else math.nan


def wilson(hits, trials):
    """95 % interval of a share (E. B. Wilson, J. Am. Stat. Assoc. 22, 209 (1927))."""
    if not trials:
        return 0., 1.
    share, z2 = hits / trials, QUANTILE ** 2
    centre = share + z2 / (2 * trials)
    half = QUANTILE * math.sqrt(share * (1 - share) / trials + z2 / (4 * trials ** 2))
    return (centre - half) / (1 + z2 / trials), (centre + half) / (1 + z2 / trials)


def share(hits, trials):
    low, high = wilson(hits, trials)
    return f"{hits} ({100 * low:.0f} to {100 * high:.0f} %)"


def groups(rows):
    """Names of groups of cases and those cases."""
    yield "all", rows
    for kind in KINDS:
        yield kind, [r for r in rows if r["kind"] == kind]
    for camera in CAMERAS:
        yield f"camera: {camera}", [r for r in rows if r["camera"] == camera]
    yield "the paper's damper", [r for r in rows if not r["other"]]
    yield "other dampers", [r for r in rows if r["other"]]
    for name in sorted({n for r in rows for n in r["want"]}):
        yield name, [r for r in rows if name in r["want"]]


def score_table(rows):
    lines = ["| | cases | right (95 %) | in set | log score | invented | median, s |", "|---|---|---|---|---|---|---|"]
    for name, some in groups(rows):
        if some:
            right, among, wrong = (sum(map(count, some)) for count in (lambda r: r["right"], lambda r: r["among"], invented))
            lines.append(f"| {name} | {len(some)} | {share(right, len(some))} | {among} | {mean(map(log_score, some)):.2f} | {wrong} | "
                         f"{median([r['seconds'] for r in some]):.0f} |")
    return lines


def reliability_table(rows):
    lines = ["| probability of the first answer | cases | mean said | true (95 %) |", "|---|---|---|---|"]
    for low, high in SAID:
        some = [r for r in rows if low <= r["top"] < high]
        if some:
            true = sum(r["top_right"] for r in some)
            bounds = wilson(true, len(some))
            lines.append(f"| {low:.2f} to {min(high, 1):.2f} | {len(some)} | {mean(r['top'] for r in some):.2f} | "
                         f"{true / len(some):.2f} ({bounds[0]:.2f} to {bounds[1]:.2f}) |")
    return lines


def sign_test(one, other):
    """Two-sided probability of so uneven a split of `one` + `other` cases where both are as likely."""
    n = one + other
    tail = sum(math.comb(n, k) for k in range(min(one, other) + 1)) / 2 ** n
    return min(1., 2 * tail)


def paired_table(rows, before):
    """Two programs on the same cases: rows of both, in the same order."""
    pairs = list(zip(rows, before))
    count = lambda a, b: sum(x["right"] == a and y["right"] == b for x, y in pairs)
    differences = [log_score(x) - log_score(y) for x, y in pairs]
    centre = mean(differences)
    error = math.sqrt(sum((d - centre) ** 2 for d in differences) / max(1, len(pairs) - 1) / max(1, len(pairs)))
    gained, lost = count(True, False), count(False, True)
    lines = ["| | before: right | before: wrong |", "|---|---|---|",
             f"| now: right | {count(True, True)} | {gained} |", f"| now: wrong | {lost} | {count(False, False)} |", "",
             f"Right by one program alone: {gained} now, {lost} before; so uneven by chance with p = {sign_test(gained, lost):.2g} "
             f"(sign test). Log score, now less before: {centre:+.2f} +- {error:.2f} (below zero is better). Median seconds: "
             f"{median([x['seconds'] for x in rows]):.0f} now, {median([y['seconds'] for y in before]):.0f} before.", ""]
    for x, y in pairs:
        if x["got"] != y["got"]:
            lines.append(f"- {x['case']}: {' + '.join(x['want']) or 'nothing'} hidden; now {described(x)}; "
                         f"before {described(y)}")
    return lines


def described(row):
    return f"{'right' if row['right'] else 'WRONG'} {row['verdict']} {' + '.join(row['got']) or '-'}"


def case_line(row):
    return (f"{row['case']} {'right' if row['right'] else 'WRONG'} {row['kind']} {row['camera']} {row['laboratory']} -> "
            f"{row['verdict']} {' + '.join(row['got']) or '-'} p(truth) {row['p']:.2f} {row['seconds']:.0f} s")
