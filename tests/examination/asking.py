# SPDX-License-Identifier: MIT
"""Puts the cases of an exam to one or two programs. Each answer is kept as it comes: a second call goes on where the first stopped."""
import concurrent.futures, json, os, pathlib, shutil, subprocess, tempfile, threading, time

from drawing import draw_by_script, draw_one, effects_of, wait_until_drawn, write_truth

USUAL_SECONDS = 300  # of a diagnosis, with all cores: the program's own limit where nobody says another
PATIENCE = 1.6       # times its limit that a diagnosis may take beside other work (`shakedown diagnose --help`)
HANGS = 3            # times its limit, in work and not in waiting for cores, after which it is ended without an answer


def seconds_worked(process):
    """Processor time of a process that runs, s."""
    try:
        fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    except OSError:
        return 0.


def cores():
    return len(os.sched_getaffinity(0))


class Exam:
    """Folder: cases/ (made by a laboratory), answers/NAME/c000.json with c000.seconds."""

    def __init__(self, folder, plan, programs, script, at_a_time, seconds, minutes, tell):
        self.cases, self.answers, self.plan, self.programs = folder / "cases", folder / "answers", plan, programs
        self.script, self.tell = script, tell
        self.at_a_time, self.threads = at_a_time, max(1, cores() // at_a_time)
        # A diagnosis on a share of the cores may do as much work as one that has them all.
        self.limit = (seconds or USUAL_SECONDS) * cores() / self.threads
        self.began, self.end = time.monotonic(), time.monotonic() + 60 * minutes if minutes else None
        self.drawn, self.sealed, self.stopped, self.lock = False, {}, False, threading.Lock()

    def time_is_over(self):
        """A case is begun only where it can be finished."""
        return self.end is not None and time.monotonic() + PATIENCE * self.limit > self.end

    def draw_all_by_script(self):
        try:
            draw_by_script(self.script, self.plan["seed"], self.plan["cases"], self.cases, self.plan["perfect"])
        finally:
            self.drawn = True

    def run(self):
        """Draws what is missing and asks what has no answer. Raises KeyboardInterrupt; what is done is kept."""
        everything = range(self.plan["cases"])
        drawn_before = (self.cases / "truth.sealed").exists()
        if not drawn_before and self.cases.exists():
            shutil.rmtree(self.cases)  # an interrupted draw; the same seed draws the same again
        with concurrent.futures.ThreadPoolExecutor(self.at_a_time) as pool:
            jobs = []
            if self.script and not drawn_before:
                jobs.append(pool.submit(self.draw_all_by_script))
            effects = None if self.script or drawn_before else effects_of(self.programs[0][1])
            jobs += [pool.submit(self.one, number, effects) for number in everything]
            try:
                for job in concurrent.futures.as_completed(jobs):
                    job.result()
            except BaseException:
                self.stopped = True
                for job in jobs:
                    job.cancel()
                raise
        if not self.script and not drawn_before:
            write_truth(self.cases, dict(sorted(self.sealed.items())))

    def one(self, number, effects):
        """Draws a case where that is to be done, and asks every program."""
        name = f"c{number:03}"
        if effects is not None:
            if self.stopped or self.time_is_over():
                return
            sealed = draw_one(self.programs[0][1], effects, self.plan["seed"], number, self.cases / name,
                              self.plan["perfect"])
            with self.lock:
                self.sealed[name] = sealed
        elif self.script:
            wait_until_drawn(self.cases, number, lambda: not self.drawn)
        for label, program in self.programs:
            if not self.stopped and not self.time_is_over():
                self.ask(label, program, name)

    def ask(self, label, program, name):
        folder = self.answers / label
        folder.mkdir(parents=True, exist_ok=True)
        answer, fresh = folder / f"{name}.json", folder / f"{name}.json.part"
        if answer.exists():
            return
        case, start = self.cases / name, time.monotonic()
        words = [program, "diagnose", str(case / "setup.toml"), "--data", str(case / "experiment.toml"), "--json",
                 str(fresh), "--threads", str(self.threads), "--seconds", f"{self.limit:g}"]
        code, why = self.answered_or_ended(words)
        if code is None or code in (130, -2) or self.stopped:  # out of time; interrupted, by exit code or by signal
            fresh.unlink(missing_ok=True)
            return
        if code not in (0, 1) or not fresh.exists():
            fresh.write_text(json.dumps(dict(verdict=f"exit {code}: {why}")))
        seconds = time.monotonic() - start
        (folder / f"{name}.seconds").write_text(f"{seconds:.1f}")
        fresh.replace(answer)
        self.tell(f"{name} answered by {label}, {seconds:.0f} s")

    def answered_or_ended(self, words):
        """Exit code and the end of what was said; the code is None where the exam's time is over first."""
        with tempfile.TemporaryFile("w+") as said:
            process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=said)
            while True:
                try:
                    process.wait(timeout=.2)
                except subprocess.TimeoutExpired:
                    hangs = seconds_worked(process) > HANGS * self.limit * self.threads
                    late = self.end is not None and time.monotonic() > self.end
                    if not hangs and not late:
                        continue
                    process.kill()
                    process.wait()
                    return (124, f"no answer after {HANGS * self.limit:.0f} s of work") if hangs else (None, "")
                said.seek(0)
                return process.returncode, said.read().strip()[-200:]

    def answer(self, label, name):
        """The answer and its seconds, or None."""
        file = self.answers / label / f"{name}.json"
        if not file.exists():
            return None
        return json.loads(file.read_text()), float((self.answers / label / f"{name}.seconds").read_text())
