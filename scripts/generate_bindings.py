#!/usr/bin/env python3
"""Writes the parts of the bindings that only repeat difmesh.h: structs, constants and functions.

    scripts/generate_bindings.py            writes them, after a change of the header
    scripts/generate_bindings.py --check    fails if they are not what it would write
"""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "bindings"))
import c_header
import fortran_files
import python_files

ROOT = Path(__file__).resolve().parents[1]
TOOL = "scripts/generate_bindings.py"
FILES = {
    "bindings/python/difmesh/_constants.py": python_files.constants,
    "bindings/python/difmesh/_structs.py": python_files.structs,
    "bindings/python/difmesh/_prototypes.py": python_files.prototypes,
    "bindings/fortran/difmesh_types.f90": fortran_files.types,
    "bindings/fortran/difmesh_c.f90": fortran_files.functions,
    "bindings/fortran/difmesh_init.f90": fortran_files.preparation,
}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="fail if a file is not up to date")
    parser.add_argument("--header", type=Path, default=ROOT / "capi/include/difmesh/difmesh.h")
    parser.add_argument("--out", type=Path, default=ROOT, help="folder of the tree to write to")
    given = parser.parse_args()
    try:
        header = c_header.read_header(given.header)
        texts = {given.out / name: write(header, TOOL) for name, write in FILES.items()}
    except (c_header.Unclear, OSError) as error:
        print(error, file=sys.stderr)
        return 1
    stale = [path for path, text in texts.items() if not path.exists() or path.read_text() != text]
    for path in stale:
        if given.check:
            print(f"{path} is not what the header says; run {TOOL}", file=sys.stderr)
        else:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(texts[path])
            print(f"written: {path}")
    return 1 if given.check and stale else 0


if __name__ == "__main__":
    sys.exit(main())
