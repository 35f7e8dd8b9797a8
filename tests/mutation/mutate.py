#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Changes our own C++ in one place at a time and asks the tests whether they notice.

    tests/mutation/mutate.py --seed 4711 --mutants 60              # over the four rooms
    tests/mutation/mutate.py --rooms balance --mutants 20 --seed 2
    tests/mutation/mutate.py --again build/mutation/mutants.csv    # only those that survived

It works in a copy, build/mutation/tree, never in the sources themselves. Each mutant is built with the programs of its room's tests, whose
quick suites run until one fails, with a bound of three times their usual time; where none does, the slow ones of three of the rooms. A mutant
that does not build counts for nothing and another is drawn. A line a mutant goes to build/mutation/mutants.csv: room, place, operator, what became of it, seconds, the line before and after.
"""
import argparse, csv, os, random, shutil, subprocess, sys, time
from pathlib import Path

from mutants import Mutant, mutants_of

ROOT = Path(__file__).resolve().parents[2]
# Sources, and the test programs that hold them to what they promise, the cheapest first.
ROOMS = {
    "hardsphere": (["hardsphere/*.cpp", "hardsphere/*.hpp"], ["hardsphere", "bytes"]),
    "likelihood": (["harness/likelihood/*.cpp", "harness/likelihood/*.hpp"], ["likelihood"]),
    "evidence": (["harness/diagnose/evidence.cpp", "harness/diagnose/verdict.cpp"], ["diagnose"]),
    "balance": (["harness/balance/*.cpp", "harness/balance/*.hpp"], ["balance"]),
}
COLUMNS = ["room", "file", "line", "operator", "outcome", "seconds", "before", "after"]
LONGEST_BUILD = 900  # s
# By googletest's filter; whole diagnoses, the slow ones of the room evidence, would take a quarter of an hour a mutant.
QUICK, SLOW = "-Slow*:*/Slow*", "Slow*:*/Slow*"
HAS_SLOW = {"hardsphere", "likelihood", "balance"}


def run(words, folder, bound):
    """(exit code, output); None as the code where it took longer than the bound. The whole group ends with it."""
    process = subprocess.Popen(words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                               start_new_session=True)
    try:
        output, _ = process.communicate(timeout=bound)
        return process.returncode, output
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, 9)
        process.communicate()
        return None, ""


class Tree:
    """A copy of the sources with a build of its own."""

    def __init__(self, folder, parallel):
        self.folder, self.parallel = folder, parallel
        self.usual = {}  # s, of the quick and the slow suites of each test program
        files = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT, check=True,
                               capture_output=True, text=True).stdout.split("\0")
        for name in filter(None, files):
            source, copy = ROOT / name, folder / name
            if not source.is_file() or (copy.is_file() and copy.read_bytes() == source.read_bytes()):
                continue
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, copy)
        code, output = run(["cmake", "--preset", "release", "-DSHAKEDOWN_BENCH=OFF"], folder, LONGEST_BUILD)
        if code != 0:
            sys.exit(f"the copy cannot be configured:\n{output}")

    def build(self, tests, bound=LONGEST_BUILD):
        words = ["cmake", "--build", "--preset", "release", "--parallel", str(self.parallel), "--target"]
        return run(words + [f"test_{name}" for name in tests], self.folder, bound)

    def test(self, name, suites, bound):
        """None where these suites of the program pass, else how it was noticed."""
        program = self.folder / f"build/release/tests/{name}/test_{name}"
        code, output = run([program, f"--gtest_filter={suites}", "--gtest_fail_fast", "--gtest_brief=1"], self.folder, bound)
        if code is None:
            return "noticed: takes too long"
        return None if code == 0 else f"noticed: test_{name}" + ("" if "FAILED" in output else " ends early")

    def measure(self, tests):
        code, output = self.build(tests, 4 * LONGEST_BUILD)
        if code != 0:
            sys.exit(f"the sources cannot be built as they are:\n{output[-2000:]}")
        for name, suites in self.asked(tests):
            begin = time.monotonic()
            if noticed := self.test(name, suites, 1200):
                sys.exit(f"test_{name} fails before anything is changed ({noticed})")
            self.usual[name, suites] = time.monotonic() - begin

    @staticmethod
    def asked(tests):
        """(program, suites) in the order in which they are run."""
        return [(name, QUICK) for name in tests] + [(name, SLOW) for name in tests if name in HAS_SLOW]

    def outcome(self, mutant, tests):
        file = self.folder / mutant.file
        kept = file.read_text()
        lines = kept.split("\n")
        lines[mutant.line - 1] = mutant.after
        try:
            file.write_text("\n".join(lines))
            code, _ = self.build(tests)
            if code != 0:
                return "does not build"
            for name, suites in self.asked(tests):
                if noticed := self.test(name, suites, 3 * self.usual[name, suites] + 5):
                    return noticed
            return "survived"
        finally:
            file.write_text(kept)


def drawn(room, generator):
    """Mutants of a room in random order: an operator first, so that the many constants do not crowd out the rest."""
    found = {}
    for pattern in ROOMS[room][0]:
        for file in sorted(ROOT.glob(pattern)):
            name = str(file.relative_to(ROOT))
            for mutant in mutants_of(name, file.read_text()):
                found.setdefault(mutant.operator, []).append(mutant)
    for group in found.values():
        generator.shuffle(group)
    while found:
        operator = generator.choice(sorted(found))
        yield found[operator].pop()
        if not found[operator]:
            del found[operator]


def survivors(file):
    with open(file, newline="") as stream:
        rows = [row for row in csv.DictReader(stream) if row["outcome"] == "survived"]
    for row in rows:
        text = (ROOT / row["file"]).read_text().split("\n")
        line = int(row["line"])
        if line > len(text) or text[line - 1] != row["before"]:
            sys.exit(f"{row['file']}:{line}: is no longer what was changed; draw new mutants")
        yield row["room"], Mutant(row["file"], line, row["operator"], row["before"], row["after"])


def try_room(tree, room, mutants, wanted, record):
    """Returns how many were noticed, and how many built."""
    tests = ROOMS[room][1]
    tree.measure(tests)
    print(f"{room}: " + ", ".join(f"test_{name} takes {sum(tree.usual[one] for one in tree.asked([name])):.1f} s" for name in tests),
          flush=True)
    noticed = built = 0
    for mutant in mutants:
        if built == wanted:
            break
        begin = time.monotonic()
        outcome = tree.outcome(mutant, tests)
        seconds = time.monotonic() - begin
        record([room, mutant.file, mutant.line, mutant.operator, outcome, f"{seconds:.0f}", mutant.before, mutant.after])
        print(f"  {outcome} ({seconds:.0f} s)  {mutant.told()}", flush=True)
        built += outcome != "does not build"
        noticed += outcome.startswith("noticed")
    return noticed, built


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--rooms", nargs="+", choices=list(ROOMS), default=list(ROOMS))
    options.add_argument("--mutants", type=int, default=60, help="that build, over all rooms")
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--again", metavar="CSV", help="the survivors of an earlier record")
    options.add_argument("--parallel", type=int, default=2)
    options.add_argument("--record", default=ROOT / "build/mutation/mutants.csv", type=Path)
    asked = options.parse_args()
    tree = Tree(ROOT / "build/mutation/tree", asked.parallel)
    chosen = list(survivors(asked.again)) if asked.again else []
    fresh = not asked.record.exists() or asked.record.stat().st_size == 0  # a run may end before its first line
    total_noticed = total_built = 0
    with open(asked.record, "a", newline="") as stream:
        writer = csv.writer(stream)
        if fresh:
            writer.writerow(COLUMNS)

        def record(row):
            writer.writerow(row)
            stream.flush()
        for place, room in enumerate(asked.rooms):
            share = asked.mutants // len(asked.rooms) + (place < asked.mutants % len(asked.rooms))
            mutants = drawn(room, random.Random(f"{asked.seed} {room}"))
            if asked.again:
                mutants = [mutant for home, mutant in chosen if home == room]
                share = len(mutants)
            if not share:
                continue
            noticed, built = try_room(tree, room, mutants, share, record)
            print(f"{room}: {noticed} of {built} noticed", flush=True)
            total_noticed, total_built = total_noticed + noticed, total_built + built
    print(f"{total_noticed} of {total_built} noticed")


if __name__ == "__main__":
    main()
