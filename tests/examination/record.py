# SPDX-License-Identifier: MIT
"""The dated record of an exam, and the ledger of seeds (bench/studies/ledger.hpp says what it is for)."""
import csv, time

from scoring import case_line, paired_table, reliability_table, score_table

HEADER = ["study", "seed", "program", "drawn", "answered", "opened"]


def now():
    return time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())


def study_of(script):
    """Two laboratories draw different cases of one seed."""
    return "exam" if script else "exam-own-laboratory"


def read_ledger(file):
    if not file.exists():
        return []
    with file.open(newline="") as stream:
        rows = list(csv.reader(stream))
    if not rows or rows[0] != HEADER:
        raise ValueError(f"{file}: is no ledger; its first line must read {','.join(HEADER)}")
    return rows[1:]


def opened_before(file, study, seed, drawn):
    """When others opened this seed; a line of this very exam (drawn at the same time) does not count."""
    return [row[5] for row in read_ledger(file) if row[:2] == [study, str(seed)] and row[3] != drawn and row[5]]


def tell_ledger(file, study, seed, program, drawn):
    """Adds the exam, answered and opened now, or nothing where it stands there."""
    rows = read_ledger(file)
    if any(row[:2] == [study, str(seed)] and row[3] == drawn for row in rows):
        return
    rows.append([study, str(seed), program.replace(",", ";"), drawn, now(), now()])
    file.write_text("\n".join(",".join(row) for row in [HEADER] + rows) + "\n")


def record_text(about, rows, before, unanswered):
    """Markdown: what was asked of whom, and how it went. `about`: seed, program, before, command, laboratory, date, how."""
    lines = [f"# Exam of seed {about['seed']}, {about['date']}", "", f"- program: {about['program']}"]
    if before:
        lines.append(f"- before: {about['before']}")
    lines += [f"- command: `{about['command']}`", f"- laboratory: {about['laboratory']}", f"- {about['how']}",
              "- unseen: nobody had opened the seed before it was answered", ""]
    lines += score_table(rows) + ["", "Reliability: the most probable answer, and how often it is the truth.",
                                  ""] + reliability_table(rows) + [""]
    lost = [row for row in rows if row["lost"]]
    lines.append(f"No answer: {len(lost)}." + "".join(f" {row['case']}: {row['verdict']}." for row in lost)
                 + (f" Not answered in the time: {unanswered}." if unanswered else ""))
    if before:
        lines += ["", "## Beside the program before", ""] + paired_table(rows, before)
    return "\n".join(lines + ["", "## Case by case", "", "```"] + [case_line(row) for row in rows] + ["```", ""])
