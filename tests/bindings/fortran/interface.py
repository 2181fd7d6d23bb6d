"""The Fortran module declares what difmesh.h does, as gfortran itself writes it down in C.

    interface.py GFORTRAN CC FOLDER-OF-THE-SOURCES
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))
import header

fortran, cc, sources = sys.argv[1:4]
failures = []


def expect(holds, what):
    if not holds:
        failures.append(what)


def prototypes(folder, name):
    done = subprocess.run(
        [fortran, "-std=f2018", "-fc-prototypes", "-fsyntax-only", f"-J{folder}",
         Path(sources, name)],
        check=True, capture_output=True, text=True,
    )  # fmt: skip
    return re.sub(r"/\*.*?\*/", "", done.stdout)


def check_structs(folder, text):
    """Sizes and places of all fields, by the C compiler."""
    found = dict(re.findall(r"typedef struct (\w+) \{(.*?)\} \1;", text, re.DOTALL))
    structs = header.structs()
    expect(set(found) == set(structs), f"structs {set(found) ^ set(structs)}")
    lines = ['#include "difmesh/difmesh.h"']
    for name, fields in structs.items():
        body = re.sub(r"\bdif_\w+(?= \w+;)", lambda kind: "f_" + kind.group(), found[name])
        lines.append(f"typedef struct f_{name} {{{body}}} f_{name};")
        lines.append(f'_Static_assert(sizeof(f_{name}) == sizeof({name}), "{name}");')
        names = re.findall(r"(\w+)(?:\[\d+\]|\)\(\))?;", body)
        expect(names == fields, f"fields of {name}: {names}")
        for field in fields:
            for measure in (f"offsetof({{}}, {field})", f"sizeof((({{}}*)0)->{field})"):
                lines.append(
                    f"_Static_assert({measure.format('f_' + name)} == {measure.format(name)}, "
                    f'"{name}.{field}");'
                )
    expect(len(lines) > 300, "fields of structs")
    source = Path(folder, "structs.c")
    source.write_text("#include <stddef.h>\n" + "\n".join(lines) + "\n")
    done = subprocess.run(
        [cc, "-std=c11", f"-I{header.HEADER.parents[1]}", "-fsyntax-only", source],
        capture_output=True, text=True,
    )  # fmt: skip
    expect(done.returncode == 0, done.stderr)


def shape(parameter):
    """'*' for a pointer, else the number's type."""
    if "*" in parameter or "[" in parameter or re.match(r"dif_(function|gradient)\b", parameter):
        return "*"
    words = {"int64_t": "long", "uint64_t": "long", "int32_t": "int", "dif_status": "int"}
    kind = parameter.split()[0]
    return words.get(kind, kind)


def check_functions(text):
    found = {
        name: (result, [] if not parameters.strip() else re.split(r",\s*", parameters))
        for result, name, parameters in re.findall(r"^([\w ]+?\**) ?\*?(dif_\w+) \((.*)\);$", text,
                                                   re.MULTILINE)
    }  # fmt: skip
    declared = header.functions()
    expect(set(found) == set(declared), f"functions {set(found) ^ set(declared)}")
    for name, (result, parameters) in declared.items():
        given = [shape(parameter.strip()) for parameter in found[name][1]]
        expect(given == [shape(parameter) for parameter in parameters], f"{name}: {given}")
        expect(
            ("*" in result or "void" == result) == ("void" in found[name][0]), f"result of {name}"
        )


def check_pointers_to_pointers():
    """Of a handle by reference and one by value gfortran writes the same, so by the source."""
    text = Path(sources, "difmesh_c.f90").read_text()
    for name, (_, parameters) in header.functions().items():
        body = re.search(rf"(?:function|subroutine) {name}\(.*?\n    end ", text, re.DOTALL).group()
        for parameter in parameters:
            stars = len(re.findall(r"\*|\[", parameter))
            argument = re.search(r"(\w+)(?:\[\d*\])?$", parameter).group(1)
            opaque = re.search(r"\b(void|dif_mesh|dif_shape|dif_field_file)\b", parameter)
            if stars == 0 or not opaque:
                continue
            (line,) = re.findall(rf"^ *(type\(c_ptr\).*::.*\b{argument}\b.*)$", body, re.MULTILINE)
            expect(("value" in line) == (stars == 1), f"{argument} of {name}")


def check_constants():
    text = Path(sources, "difmesh_types.f90").read_text()
    found = {name.upper(): int(value) for name, value in re.findall(r"(dif_\w+) = (\d+)", text)}
    expected = {**header.constants(), **header.macros()}
    expect(found == expected, f"constants {set(found.items()) ^ set(expected.items())}")


with tempfile.TemporaryDirectory() as folder:
    check_structs(folder, prototypes(folder, "difmesh_types.f90"))
    check_functions(prototypes(folder, "difmesh_c.f90"))
check_pointers_to_pointers()
check_constants()
print("\n".join(failures) or "the Fortran module declares what the header does")
sys.exit(1 if failures else 0)
