# SPDX-License-Identifier: MIT
import json, math, os, pathlib, random, subprocess, sys, tempfile, unittest

import asking, drawing, record, scoring

PROGRAM = os.environ.get("SHAKEDOWN")

# Stands in for the program: hides nothing, gives every case the answer in answer.json, and breaks down at those named in breaks.
STAND_IN = """#!/bin/sh
here='FOLDER'
case "$1" in
--version) echo "stand-in 1" ;;
effects) cat "$here/effects.json" ;;
hide)
  while [ "$1" != --out ]; do shift; done
  mkdir -p "$2" && touch "$2/setup.toml" "$2/experiment.toml" ;;
diagnose)
  name=$(basename "$(dirname "$2")")
  echo "$name" >> "$here/asked"
  if grep -q "$name" "$here/breaks"; then echo "something broke" >&2; exit 70; fi
  while [ "$1" != --json ]; do shift; done
  cp "$here/answer.json" "$2"
  exit 1 ;;
esac
"""


def strength(parameters, typical, **more):
    return dict(strengths=[dict(parameters=parameters, typical=typical, levels=[], low=0, high=0, strongest=0) | more])


def number(name, unit, high):
    return dict(name=name, kind="number", unit=unit, low=0, high=high, typical=.6, required=False)


EFFECTS = [
    dict(name="push", acts_on="box", search=strength("size", 2), parameters=[number("size", "N", 5)]),
    dict(name="stick", acts_on="contact", parameters=[number("a", "", 1), number("b", "", 1)],
         search=strength("a&b", -.2, strongest=-.66, absent_key="restitution.grain_wall")),
    dict(name="lens", acts_on="camera", search=strength("size", 1), parameters=[number("size", "", 1)]),
    dict(name="law", acts_on="all", search=dict(not_searched="a formula"), parameters=[dict(name="force", kind="text")])]


def hypotheses(*pairs):
    return [dict(effects=list(effects), probability=p) for effects, p in pairs]


def sealed(kind, hidden, camera="lab", f=1.23):
    return dict(kind=kind, hidden=hidden, laboratory={}, camera=camera, damper=dict(f=f))


class Scoring(unittest.TestCase):
    def row(self, hidden, answer, kind="one"):
        return scoring.judged("c000", sealed(kind, hidden), answer, 3)

    def test_the_bar_stops_a_good_program_once_in_a_hundred(self):
        def falls_short(bar, n):
            share = scoring.SHARE_RIGHT
            return sum(math.comb(n, k) * share ** k * (1 - share) ** (n - k) for k in range(bar))
        self.assertEqual(scoring.fewest_right(8), 1)
        for n in range(1, 30):
            bar = scoring.fewest_right(n)
            self.assertLessEqual(falls_short(bar, n), .01)
            self.assertGreater(falls_short(bar + 1, n), .01)

    def test_intervals_are_wilsons(self):
        low, high = scoring.wilson(9, 10)
        self.assertAlmostEqual(low, .596, 3)
        self.assertAlmostEqual(high, .982, 3)
        self.assertEqual(scoring.wilson(0, 0), (0, 1))

    def test_physics_alone_is_judged(self):
        row = self.row(["a"], dict(verdict="missing", missing=["camera_lens", "a", "initial_packing"],
                                   hypotheses=hypotheses((["a", "camera_scale"], .5), (["a"], .3),
                                                         ([], .2)), answer_set=[dict(effects=["a"])]))
        self.assertTrue(row["right"] and row["among"] and row["top_right"])
        self.assertAlmostEqual(row["p"], .8)
        self.assertFalse(scoring.invented(row))

    def test_an_error_of_the_camera_is_no_physics(self):
        self.assertTrue(self.row([], dict(verdict="measurement", missing=["camera_lens"]), "nothing")["right"])

    def test_unknown_is_an_answer_and_never_invented(self):
        row = self.row(["unknown"], dict(verdict="unknown", missing=["a"], hypotheses=hypotheses((["unknown"], 1))),
                       "unlisted")
        self.assertTrue(row["right"])
        self.assertFalse(scoring.invented(row))
        self.assertTrue(scoring.invented(self.row(["unknown"], dict(verdict="missing", missing=["a"]), "unlisted")))

    def test_a_program_that_breaks_down_is_never_right(self):
        row = self.row([], dict(verdict="exit 70: bug"), "nothing")
        self.assertTrue(row["lost"])
        self.assertFalse(row["right"])
        self.assertAlmostEqual(scoring.log_score(row), math.log(1000))

    def test_two_programs_are_compared_case_by_case(self):
        yes, no = (self.row(["a"], dict(verdict="missing", missing=[name],
                                        hypotheses=hypotheses((["a"], p), ([], 1 - p)))) for name, p in (("a", .9),
                                                                                                         ("b", .1)))
        text = "\n".join(scoring.paired_table([yes] * 6, [no] * 6))
        self.assertIn("| now: right | 0 | 6 |", text)
        self.assertIn("p = 0.031", text)  # 2 / 2^6
        self.assertIn("-2.20", text)      # ln(.1 / .9)

    def test_the_score_is_that_of_the_script_beside_the_project(self):
        script = drawing.exam_script()
        if not script:
            self.skipTest("exam.py is not here")
        names, r = ["a", "b", "camera_lens", "initial_packing"], random.Random(5)
        rows = []
        with tempfile.TemporaryDirectory() as scratch:
            folder, truth = pathlib.Path(scratch), {}
            for number in range(60):
                name, kind = f"c{number:03}", r.choice(list(drawing.KINDS))
                truth[name] = sealed(kind, {"nothing": [], "parameters": [], "one": ["a"], "two": ["a", "b"],
                                            "unlisted": ["unknown"]}[kind], r.choice(list(drawing.CAMERAS)), r.choice((1.23, 2.)))
                sets = [sorted(r.sample(names, r.randrange(3))) for _ in range(3)] + [["unknown"]]
                answer = dict(verdict=r.choice(["missing", "missing", "unknown", "refit"]), missing=sets[0],
                              hypotheses=hypotheses(*[(s, .25) for s in sets]), answer_set=hypotheses(*[(s,
                                                                                                         .25) for s in sets[:2]]))
                (folder / name).mkdir()
                (folder / name / "answer.json").write_text(json.dumps(answer))
                (folder / name / "seconds").write_text(str(number))
                rows.append(scoring.judged(name, truth[name], answer, number))
            drawing.write_truth(folder, truth)
            text = subprocess.run([sys.executable, str(script), "score", str(folder)], check=True, capture_output=True,
                                  text=True).stdout
        for name, some in scoring.groups(rows):
            if some:
                n, share = len(some), lambda key: sum(r[key] for r in some) / len(some)
                label, score = name.replace("camera:", "camera"), scoring.mean(map(scoring.log_score, some))
                wrong, seconds = scoring.mean(map(scoring.invented, some)), scoring.median([r["seconds"] for r in some])
                expected = (f"{label:28} n {n:3}  right {share('right'):4.0%}  in set {share('among'):4.0%}  "
                            f"log score {score:4.2f}  invented {wrong:4.0%}  median {seconds:.0f} s")
                self.assertIn(expected, text)


class Drawing(unittest.TestCase):
    def effects(self):
        return drawing.effects_of(PROGRAM) if PROGRAM else EFFECTS

    def drawn(self, count, perfect=False):
        effects = self.effects()
        return [drawing.drawn_case(7, number, effects, perfect, 0) for number in range(count)]

    def test_the_same_seed_draws_the_same(self):
        self.assertEqual(self.drawn(20), self.drawn(20))

    def test_kinds_come_as_often_as_they_should(self):
        count, kinds = 2000, [case[2]["kind"] for case in self.drawn(2000)]
        for kind, expected in drawing.KINDS.items():
            error = math.sqrt(expected * (1 - expected) / count)
            self.assertLess(abs(kinds.count(kind) / count - expected), 4 * error, kind)

    def test_what_is_hidden_is_physics_and_a_pair_has_two(self):
        names = {e["name"] for e in self.effects()}
        for _, _, case in self.drawn(500):
            self.assertEqual(len(case["hidden"]), dict(nothing=0, parameters=0, one=1, two=2, unlisted=1)[case["kind"]])
            for name in set(case["hidden"]) - {"unknown"}:
                self.assertIn(name, names)
                self.assertEqual(scoring.physical([name]), (name,))

    def test_strengths_stay_within_their_bounds(self):
        r = random.Random(1)
        for _ in range(300):
            words = drawing.hidden_strength(r, EFFECTS[0], drawing.drawn_damper(r), .76)
            self.assertTrue(0 <= float(words.split(":")[1].split()[0]) <= 5, words)
            parts = drawing.hidden_strength(r, EFFECTS[1], drawing.drawn_damper(r), .76).split("=")[1].split(",")
            self.assertEqual(parts[0].split(":")[1], parts[1].split(":")[1])
            self.assertTrue(.1 - 1e-9 <= float(parts[0].split(":")[1]) <= .76, parts)


class Ledger(unittest.TestCase):
    def test_a_seed_that_was_opened_is_known(self):
        with tempfile.TemporaryDirectory() as scratch:
            file = pathlib.Path(scratch) / "ledger.csv"
            self.assertEqual(record.opened_before(file, "exam", 5, "then"), [])
            record.tell_ledger(file, "exam", 5, "program, 1", "then")
            record.tell_ledger(file, "exam", 5, "program, 1", "then")
            self.assertEqual(len(record.read_ledger(file)), 1)
            self.assertEqual(record.opened_before(file, "exam", 5, "then"), [])
            self.assertEqual(len(record.opened_before(file, "exam", 5, "later")), 1)
            self.assertEqual(record.opened_before(file, "exam", 6, "later"), [])

    def test_the_ledger_of_the_project_reads(self):
        rows = record.read_ledger(drawing.ROOT / "bench/studies/ledger.csv")
        self.assertTrue(all(len(row) == 6 and row[1].isdigit() for row in rows))
        self.assertIn("9000", [row[1] for row in rows])

    def test_a_table_of_something_else_is_refused(self):
        with tempfile.TemporaryDirectory() as scratch:
            file = pathlib.Path(scratch) / "ledger.csv"
            file.write_text("a,b\n")
            with self.assertRaises(ValueError):
                record.read_ledger(file)


class Whole(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.scratch.name)
        self.addCleanup(self.scratch.cleanup)
        self.program = self.folder / "shakedown"
        self.program.write_text(STAND_IN.replace("FOLDER", str(self.folder)))
        self.program.chmod(0o755)
        (self.folder / "effects.json").write_text(json.dumps(EFFECTS))
        self.says([], "")

    def says(self, missing, breaks):
        answer = dict(verdict="missing" if missing else "adequate", missing=missing, answer_set=[dict(effects=missing)],
                      hypotheses=hypotheses((missing, 1)))
        (self.folder / "answer.json").write_text(json.dumps(answer))
        (self.folder / "breaks").write_text(breaks)

    def exam(self, *words):
        """Exit code and what is printed."""
        run = subprocess.run([str(drawing.ROOT / "tests/exam"), "--program", str(self.program), "--laboratory", "own",
                              "--folder", str(self.folder / "exam"), "--ledger", str(self.folder / "ledger.csv"),
                              "--record", str(self.folder / "records"), *words], capture_output=True, text=True)
        return run.returncode, run.stdout + run.stderr

    def asked(self):
        return (self.folder / "asked").read_text().split()

    def truth(self):
        return drawing.read_truth(self.folder / "exam" / "cases")

    def seed_with(self, nothings):
        """A seed of which so many of eight cases hide nothing."""
        for seed in range(10000):
            if sum(not drawing.drawn_case(seed, number, EFFECTS, False,
                                          0)[2]["hidden"] for number in range(8)) == nothings:
                return str(seed)

    def test_a_record_is_written_and_the_seed_is_spent(self):
        code, said = self.exam("--seed", "3", "--cases", "4")
        self.assertEqual(code, 0, said)
        text = next((self.folder / "records").glob("*-exam-seed-3.md")).read_text()
        for part in ("stand-in 1", "`tests/exam --seed 3 --cases 4", "| all | 4 |", "c003 "):
            self.assertIn(part, text)
        self.assertNotIn(str(self.folder), text)
        code, said = self.exam("--seed", "3", "--cases", "4")  # the same exam once more: nothing is asked again
        self.assertEqual((code, len(self.asked())), (0, 4), said)
        code, said = self.exam("--seed", "3", "--cases", "4", "--folder", str(self.folder / "another"))
        self.assertEqual(code, 1)
        self.assertIn("its cases are seen", said)

    def test_it_goes_on_where_it_was_interrupted(self):
        self.exam("--seed", "3", "--cases", "4")
        (self.folder / "exam/answers/now/c002.json").unlink()
        code, said = self.exam("--seed", "3", "--cases", "4")
        self.assertEqual(code, 0, said)
        self.assertEqual(sorted(self.asked()), ["c000", "c001", "c002", "c002", "c003"])

    def test_a_build_beside_it_changes_nothing(self):
        self.exam("--seed", "3", "--cases", "2")
        self.program.write_text(self.program.read_text().replace("stand-in 1", "stand-in 2"))
        (self.folder / "exam/answers/now/c001.json").unlink()
        code, said = self.exam("--seed", "3", "--cases", "2")
        self.assertEqual(code, 0, said)
        self.assertIn("- program: stand-in 1", said)

    def test_two_programs_are_asked_the_same(self):
        code, said = self.exam("--seed", "3", "--cases", "3", "--before", str(self.program))
        self.assertEqual(code, 0, said)
        self.assertIn("Beside the program before", said)
        self.assertEqual(sorted(self.asked()), ["c000", "c000", "c001", "c001", "c002", "c002"])

    def test_ci_lets_one_right_one_pass_and_none_not(self):
        for nothings, expected in ((1, 0), (0, 1)):
            with self.subTest(nothings=nothings):
                code, said = self.exam("--ci", "--seed", self.seed_with(nothings), "--folder",
                                       str(self.folder / f"ci{nothings}"))
                self.assertEqual(code, expected, said)
                self.assertIn(f"exam: {nothings} of 8 right, at least 1 are asked for", said)
        self.assertFalse((self.folder / "records").exists())
        self.assertFalse((self.folder / "ledger.csv").exists())

    def test_ci_fails_where_a_case_has_no_answer(self):
        self.says([], "c001")
        code, said = self.exam("--ci", "--seed", self.seed_with(4))
        self.assertEqual(code, 1, said)
        self.assertIn("exam FAILED: c001 has no answer (exit 70: something broke)", said)

    def test_what_works_without_end_is_ended(self):
        exam = asking.Exam(self.folder, {}, [], None, 1, .1 / asking.cores(), None, print)
        code, why = exam.answered_or_ended([sys.executable, "-c", "while True: pass"])
        self.assertEqual(code, 124)
        self.assertIn("of work", why)

    def test_what_waits_when_the_time_is_over_has_no_answer_and_is_no_failure(self):
        exam = asking.Exam(self.folder, {}, [], None, 1, 60, 1e-3, print)
        self.assertEqual(exam.answered_or_ended(["sleep", "100"]), (None, ""))

    def test_an_exam_asks_nothing_that_it_could_not_finish(self):
        exam = asking.Exam(self.folder, {}, [], None, 1, 60, 1.5, print)
        self.assertTrue(exam.time_is_over())  # 1.6 times 60 s is more than 90 s
        self.assertFalse(asking.Exam(self.folder, {}, [], None, 1, 60, 3, print).time_is_over())


if __name__ == "__main__":
    unittest.main()
