#!/usr/bin/env python3
"""Do the tests bite? Changes one comparison, sign, index or constant of the core at a time and runs
core_test.

A mutant that core_test fails on, or never ends on, is killed. One that passes survives: it wants a
test, or a line in tests/mutation/harmless.txt that says why it changes nothing that is promised.
What does not compile, or does so with the warnings of CI, does not count.

    scripts/mutate.py                      150 mutants, drawn at random from the files below
    scripts/mutate.py --seed 7 --mutants 20 --only 'plane_*'
    scripts/mutate.py --list               all places and what would be written there
    scripts/mutate.py --replay build/mutation/survivors.txt   those once more

Works on a copy of the tree in build/mutation, so nothing of the checkout changes. Needs what
test.sh installs. Takes some minutes to build and about half a minute per mutant.
"""

import argparse
import fnmatch
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass

ROOT = pathlib.Path(__file__).resolve().parent.parent
WORK = ROOT / "build" / "mutation"
TREE = WORK / "tree"
HARMLESS = ROOT / "tests" / "mutation" / "harmless.txt"

# What core_test is held against: rooms, and a file of another one.
PLACES = ["planes/*", "cells/*", "placement/*", "surface/*", "sampling/*", "mesh/quadric_patch.cpp"]

# Lines whose numbers promise nothing: shares of progress, room set aside, messages.
EXEMPT = re.compile(r"phases\.run\(|progress|reserve\(|prefetch|throw |Error\(|stopwatch"
                    r"|kGrain|grain")

# Test cases that take long run last: most mutants die before.
SLOW = ["instruction sets*", "every cell of a sphere*", "oracle: vertices of the genus*",
        "oracle: vertices of noise*", "the shared meshes*", "volumes against totals*",
        "spheres of random size*", "distances against a dense*",
        "overlaps of parts*", "a ball cut by a plane*"]

COMPARISONS = {"<": ["<=", ">"], "<=": ["<", ">="], ">": [">=", "<"], ">=": [">", "<="],
               "==": ["!="], "!=": ["=="]}
SITES = [
    ("comparison", re.compile(r"(?<= )(<=|>=|==|!=|<|>)(?= )")),
    ("sign", re.compile(r"(?<= )([+-]=?)(?= )|(?<=[(,={\[] )(-)(?=[\w(])|(?<=[({\[])(-)(?=[\w(])|"
                        r"(?<=return )(-)(?=[\w(])")),
    ("index", re.compile(r"(?<=\[)(\d)(?=\])")),
    ("constant", re.compile(r"(?<![\w.\['])(\d+\.\d*(?:e[+-]?\d+)?|\d+e[+-]?\d+|\d+)"
                            r"(?![\w.\]'>])")),
]


@dataclass(frozen=True)
class Mutant:
    file: str
    line: int
    column: int
    kind: str
    old: str
    new: str
    text: str  # the line as it is

    def mutated(self) -> str:
        return self.text[: self.column] + self.new + self.text[self.column + len(self.old):]

    def key(self) -> str:
        """Names the change without the line's number, which others' changes move."""
        return f"{self.file} | {self.text.strip()} | {self.mutated().strip()}"


def changed_constant(text: str) -> list[str]:
    if "." not in text and "e" not in text:
        return [str(int(text) + 1)]
    value = float(text)
    if value == 0.0:
        return ["0.1"]
    if value <= 1e-2:  # a tolerance: far off, as a slip of the hand is
        return [repr(min(value * 1e6, 0.3)), repr(value * 1e-6)]
    return [repr(round(value * 1.1, 12)), repr(round(value * 0.9, 12))]


def alternatives(kind: str, old: str) -> list[str]:
    if kind == "comparison":
        return COMPARISONS[old]
    if kind == "sign":
        return [{"+": "-", "-": "+", "+=": "-=", "-=": "+="}[old]]
    if kind == "index":
        return [str((int(old) + 1) % 3)]
    return changed_constant(old)


def code_only(source: str) -> list[str]:
    """The lines with comments and strings blanked, columns kept."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.S)
    return pattern.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), source).split("\n")


def mutants_of(path: pathlib.Path) -> list[Mutant]:
    source = path.read_text()
    found = []
    for number, (code, text) in enumerate(zip(code_only(source), source.split("\n")), 1):
        is_declaration = re.match(r"\s*(#|static_assert|using |template|namespace )", code)
        if is_declaration or EXEMPT.search(text):
            continue
        for kind, pattern in SITES:
            for match in pattern.finditer(code):
                group = next(k for k in range(1, pattern.groups + 1) if match.group(k))
                old, column = match.group(group), match.start(group)
                for new in alternatives(kind, old):
                    found.append(Mutant(str(path.relative_to(ROOT)), number, column, kind, old, new,
                                        text))
    return found


def all_mutants(only: str) -> list[Mutant]:
    found = []
    core = ROOT / "cxx" / "src"
    for path in sorted(core.rglob("*.[ch]pp")):
        place = str(path.relative_to(core))
        in_places = any(fnmatch.fnmatch(place, pattern) for pattern in PLACES)
        if in_places and fnmatch.fnmatch(path.stem, only):
            found += mutants_of(path)
    return found


def draw(found: list[Mutant], count: int, seed: int) -> list[Mutant]:
    """As many of each kind, and no two at one place."""
    shuffled = random.Random(seed).sample(found, len(found))
    by_kind = {kind: [m for m in shuffled if m.kind == kind] for kind, _ in SITES}
    chosen: list[Mutant] = []
    places: set[tuple[str, int, int]] = set()
    while len(chosen) < count and any(by_kind.values()):
        for queue in by_kind.values():
            while queue:
                mutant = queue.pop()
                place = (mutant.file, mutant.line, mutant.column)
                if place not in places:
                    places.add(place)
                    chosen.append(mutant)
                    break
    return chosen[:count]


def run(command: list[str], limit: float | None = None) -> bool:
    """True if it ends well within the limit."""
    quiet = subprocess.DEVNULL
    with subprocess.Popen(command, stdout=quiet, stderr=quiet, start_new_session=True) as child:
        try:
            return child.wait(limit) == 0
        except subprocess.TimeoutExpired:
            os.killpg(child.pid, 9)
            return False


def copy_tree() -> None:
    """Copies what has changed, and nothing else, for the sake of incremental builds."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, check=True,
                            capture_output=True, text=True).stdout
    for name in listed.splitlines():
        source, target = ROOT / name, TREE / name
        if not source.is_file():
            continue
        if not target.exists() or target.read_bytes() != source.read_bytes():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target)


class Judge:
    """Builds core_test and runs it. Most mutants show with the baseline's kernels alone, which
    compile in a third of the time; only those that survive there are held against all kernels."""

    def __init__(self, kernels: str) -> None:
        self.build_folder = WORK / f"build-{kernels}"
        options = [f"-DDIFMESH_WITH_{part}=OFF" for part in
                   ("IO", "ADAPTERS", "METRICS", "CAPI", "CGAL_TESTS", "CLI", "PAPER", "WORKFLOWS")]
        options.append(f"-DDIFMESH_WITH_AVX={'ON' if kernels == 'all' else 'OFF'}")
        configure = ["cmake", "-S", str(TREE), "-B", str(self.build_folder), "-G", "Ninja",
                     "-DCMAKE_BUILD_TYPE=Release", "-DDIFMESH_WARNINGS_AS_ERRORS=ON", *options]
        if not run(configure) or not self.build():
            sys.exit("mutate: the tree does not build as it is")
        slow = ",".join(SLOW)
        test = [str(self.build_folder / "tests" / "core_test"), "--abort-after=1"]
        self.stages = [test + [f"--test-case-exclude={slow}"], test + [f"--test-case={slow}"]]
        self.limits: list[float] = []
        for stage in self.stages:
            start = time.monotonic()
            if not run(stage):
                sys.exit("mutate: core_test fails without any change")
            self.limits.append(10 * (time.monotonic() - start) + 60)

    def build(self) -> bool:
        return run(["cmake", "--build", str(self.build_folder), "--target", "core_test"])

    def verdict(self) -> str:
        if not self.build():
            return "does not compile"
        passes = all(run(stage, limit) for stage, limit in zip(self.stages, self.limits))
        return "SURVIVES" if passes else "killed"


def harmless() -> dict[str, str]:
    """The changes known to promise nothing, and why: file | line | changed line | reason."""
    if not HARMLESS.exists():
        return {}
    rows = [line.rsplit(" | ", 1) for line in HARMLESS.read_text().splitlines()
            if line and not line.startswith("#")]
    return {row[0]: row[1] for row in rows}


def replayed(path: str, found: list[Mutant]) -> list[Mutant]:
    keys = {line for line in pathlib.Path(path).read_text().splitlines() if line}
    return [mutant for mutant in found if mutant.key() in keys]


def judge_all(chosen: list[Mutant], kernels: str, count: int) -> tuple[int, list[Mutant]]:
    """Returns how many counted, and the survivors."""
    judge = Judge(kernels)
    counted = 0
    survivors = []
    for mutant in chosen:
        if counted == count:
            break
        path = TREE / mutant.file
        lines = path.read_text().split("\n")
        lines[mutant.line - 1] = mutant.mutated()
        path.write_text("\n".join(lines))
        verdict = judge.verdict()
        counted += verdict != "does not compile"
        if verdict == "SURVIVES":
            survivors.append(mutant)
        print(f"{counted:4} {verdict}: line {mutant.line}, {mutant.kind} {mutant.old} -> "
              f"{mutant.new}: {mutant.key()}", flush=True)
        lines[mutant.line - 1] = mutant.text
        path.write_text("\n".join(lines))
    return counted, survivors


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mutants", type=int, default=150)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="*", help="pattern of the files' stems")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--replay",
                        help="a file with the changes to make, as survivors.txt has them")
    parser.add_argument("--most", type=float, default=15.0,
                        help="per cent that may survive without a reason")
    arguments = parser.parse_args()
    found = all_mutants(arguments.only)
    if arguments.list:
        print("\n".join(mutant.key() for mutant in found))
        return
    if arguments.replay:
        chosen = replayed(arguments.replay, found)
        count = len(chosen)
    else:
        count = arguments.mutants
        # Some do not compile; mutants of one file follow each other, so that restoring one and
        # making the next costs one compilation.
        chosen = draw(found, count + count // 4, arguments.seed)
        random.Random(arguments.seed).shuffle(chosen)
        chosen = sorted(chosen[:count], key=lambda m: (m.file, m.line)) + chosen[count:]
    copy_tree()
    counted, survivors = judge_all(chosen, "baseline", count)
    if survivors:
        print("mutate: the survivors once more, with the kernels of all instruction sets",
              flush=True)
        survivors = judge_all(survivors, "all", len(survivors))[1]
    known = harmless()
    unexplained = [mutant for mutant in survivors if mutant.key() not in known]
    (WORK / "survivors.txt").write_text("".join(mutant.key() + "\n" for mutant in unexplained))
    explained = len(survivors) - len(unexplained)
    print(f"mutate: {counted} mutants, {len(survivors)} survive, {explained} of them harmless by "
          f"{HARMLESS.relative_to(ROOT)}; the others stand in "
          f"{(WORK / 'survivors.txt').relative_to(ROOT)}")
    if counted and 100.0 * len(unexplained) / counted > arguments.most:
        sys.exit(1)


if __name__ == "__main__":
    main()
