#!/usr/bin/env python3
"""Names every line of source that is longer than 100 columns. clang-format leaves comments as they
are, and knows nothing of the other languages. Exits with 1 where there is one.
"""
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
COLUMNS = 100
SOURCES = {".c", ".cmake", ".cpp", ".css", ".f90", ".h", ".hpp", ".html", ".in", ".js", ".mjs",
           ".py", ".pyi", ".sh"}


def main() -> None:
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True,
                            text=True).stdout
    found = 0
    for name in listed.splitlines():
        path = pathlib.Path(name)
        if path.suffix not in SOURCES and path.name != "CMakeLists.txt" or "corpus" in path.parts:
            continue
        for number, line in enumerate((ROOT / path).read_text().splitlines(), 1):
            if len(line) > COLUMNS:
                print(f"{name}:{number}: {len(line)} columns")
                found += 1
    if found > 0:
        sys.exit(1)


if __name__ == "__main__":
    main()
