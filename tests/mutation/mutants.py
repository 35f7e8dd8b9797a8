# SPDX-License-Identifier: MIT
"""Where our own C++ can be changed by one token or one statement, so that it still reads as C++."""
import re
from dataclasses import dataclass

# clang-format sets binary operators between spaces, and neither templates nor references.
SWAPS = {
    "relation": [(" < ", " <= "), (" <= ", " < "), (" > ", " >= "), (" >= ", " > "), (" == ", " != "), (" != ", " == ")],
    "arithmetic": [(" + ", " - "), (" - ", " + "), (" * ", " / "), (" / ", " * "), (" += ", " -= "), (" -= ", " += ")],
    "logic": [(" && ", " || "), (" || ", " && ")],
}
OPERATORS = [*SWAPS, "constant", "deletion", "negation"]
NUMBER = re.compile(r"(?<![\w.\"'])(\d+\.\d*(?:e[-+]?\d+)?|\d+e[-+]?\d+|\d+)(?![\w.'])")
# An assignment to something that exists, or a call for its effect; declarations have two words before their `=`.
STATEMENT = re.compile(r"^\s*(?!return\b|using\b|throw\b|break\b|continue\b|case\b|else\b|EXPECT\b)"
                       r"[\w.\[\]>:-]+(?:\(\))?(?:\s[-+*/|&^]?=\s.*|\(.*\));$")


@dataclass(frozen=True)
class Mutant:
    file: str  # from the project's root
    line: int  # from 1
    operator: str
    before: str
    after: str

    def told(self):
        return f"{self.file}:{self.line}: {self.operator}: {self.before.strip()}  ->  {self.after.strip()}"


def blank(text):
    """The text with comments, strings and characters filled with spaces, so that places stay."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<!\d)\'(?:\\.|[^\'\\\n])\'', re.S)
    return pattern.sub(lambda found: re.sub(r"[^\n]", " ", found.group()), text)


def with_condition_negated(line, code):
    """`if (c)` and `while (c)` of one line; None where there is none, or where it declares something."""
    found = re.search(r"\b(?:if|while) \(", code)
    if not found:
        return None
    depth, begin = 1, found.end()
    for at in range(begin, len(code)):
        depth += {"(": 1, ")": -1}.get(code[at], 0)
        if depth == 0:
            inside = code[begin:at]
            if ";" in inside or re.search(r"\s=\s", inside):
                return None
            return line[:begin] + "!(" + line[begin:at] + ")" + line[at:]
    return None


def another_number(number):
    if re.fullmatch(r"\d+", number):
        return str(int(number) + 1)
    return repr(float(number) * 2 if float(number) else 1.0)


def mutants_of(file, text):
    """Every mutant of one source, in order."""
    found = []
    lines = text.split("\n")
    for number, (line, code) in enumerate(zip(lines, blank(text).split("\n")), 1):
        if re.match(r"\s*(#|EXPECT\(|static_assert|template)", code) or not code.strip():
            continue

        def add(operator, after):
            if after != line:
                found.append(Mutant(file, number, operator, line, after))
        for operator, swaps in SWAPS.items():
            for old, new in swaps:
                for hit in re.finditer(re.escape(old), code):
                    add(operator, line[:hit.start()] + new + line[hit.end():])
        for hit in NUMBER.finditer(code):
            add("constant", line[:hit.start()] + another_number(hit.group()) + line[hit.end():])
        if STATEMENT.match(code):
            add("deletion", line[:len(line) - len(line.lstrip())] + ";")
        negated = with_condition_negated(line, code)
        if negated:
            add("negation", negated)
    return found
