"""What difmesh.h declares: its structs with their fields, its functions with their parameters."""

import re
import shutil
import subprocess
import tempfile
from pathlib import Path

HEADER = Path(__file__).parents[2] / "capi" / "include" / "difmesh" / "difmesh.h"


def _text():
    text = re.sub(r"/\*.*?\*/", " ", HEADER.read_text(), flags=re.DOTALL)
    return re.sub(r"//[^\n]*|^\s*#.*(?:\\\n.*)*", " ", text, flags=re.MULTILINE)


def structs():
    """Name of each struct to the names of its fields, in their order."""
    found = {}
    for name, body in re.findall(r"typedef struct (\w+) \{(.*?)\} \1;", _text(), re.DOTALL):
        fields = [field.strip() for field in body.split(";") if field.strip()]
        found[name] = [re.search(r"(\w+)(?:\[\w+\])*$", field).group(1) for field in fields]
    return found


def functions():
    """Name of each function to its result and parameters, as text."""
    found = {}
    for result, name, parameters in re.findall(
        r"DIF_API ([\w\s*]+?)\s*\b(dif_\w+)\((.*?)\);", _text(), re.DOTALL
    ):
        inside = " ".join(parameters.split())
        found[name] = (result, [] if inside == "void" else re.split(r",\s*", inside))
    return found


def constants():
    """Name of each constant of an enum to its value."""
    found = {}
    for body in re.findall(r"enum \{(.*?)\}", _text(), re.DOTALL):
        for name, value in re.findall(r"(DIF_\w+) = (\d+)", body):
            found[name] = int(value)
    return found


def macros():
    """Name of each #define of a number to its value."""
    found = re.findall(r"^#define (DIF_\w+) (\d+)$", HEADER.read_text(), flags=re.MULTILINE)
    return {name: int(value) for name, value in found}


def layout():
    """Name of each struct to its size and the offset and size of each field, as the C compiler
    has them; None without a C compiler."""
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None:
        return None
    lines = ['#include "difmesh/difmesh.h"', "#include <stdio.h>", "int main(void) {"]
    for struct, fields in structs().items():
        lines.append(f'  printf("{struct} . 0 %zu\\n", sizeof({struct}));')
        for field in fields:
            lines.append(
                f'  printf("{struct} {field} %zu %zu\\n", offsetof({struct}, {field}), '
                f"sizeof((({struct}*)0)->{field}));"
            )
    lines += ["  return 0;", "}"]
    with tempfile.TemporaryDirectory() as folder:
        source, program = Path(folder, "layout.c"), Path(folder, "layout")
        source.write_text("\n".join(lines))
        subprocess.run(
            [compiler, "-std=c99", f"-I{HEADER.parents[1]}", source, "-o", program], check=True
        )
        said = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    found = {}
    for line in said.splitlines():
        struct, field, offset, size = line.split()
        found.setdefault(struct, {})[field] = (int(offset), int(size))
    return found
