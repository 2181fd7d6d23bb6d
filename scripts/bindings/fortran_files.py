"""The structs, constants and functions of a C header as Fortran's bind(c) has them."""

from __future__ import annotations

import re

from c_header import Function, Header, Struct, Unclear, Variable

_WIDTH = 100
_LONGEST_NAME = 63

#: Fortran has no unsigned integers: those of C have the kind of the same size.
_NUMBERS = {
    **{f"{sign}int{bits}_t": f"integer(c_int{bits}_t)"
       for sign in ("", "u") for bits in (8, 16, 32, 64)},
    "float": "real(c_float)",
    "double": "real(c_double)",
}  # fmt: skip


def types(header: Header, tool: str) -> str:
    """The module of the constants, structs and interfaces of callbacks."""
    body = "".join(_constants(group, "c_int32_t") for group in header.enums)
    if header.macros:
        body += _constants(header.macros, "c_int64_t")
    body += "".join(_struct(struct) for struct in header.structs.values())
    if header.callbacks:
        body += "\n  ! What procedures have to be whose c_funloc() the library gets.\n"
        body += "  abstract interface\n"
        body += "\n".join(_procedure(each) for each in header.callbacks.values())
        body += "  end interface\n"
        body += _wrapped(f"  public :: {', '.join(header.callbacks)}")
    names = [name for group in [*header.enums, header.macros] for name, _ in group]
    _check_names([*names, *header.structs, *header.callbacks])
    return (
        f"{_first_line(tool)}"
        "! Constants and structs of difmesh.h, where their fields are described. A struct that\n"
        "! dif_init did not prepare has struct_size 0, which the library refuses.\n"
        "module difmesh_types\n"
        f"{_uses(body)}"
        "  implicit none\n  private\n"
        f"{body}end module\n"
    )


def functions(header: Header, tool: str) -> str:
    """The module of the functions."""
    body = "\n".join(_procedure(function) for function in header.functions.values())
    names = [name for group in [*header.enums, header.macros] for name, _ in group]
    _check_names([*names, *header.structs, *header.callbacks, *header.functions])
    return (
        f"{_first_line(tool)}"
        "! The functions of difmesh.h as they are, for what the module difmesh does not cover. An\n"
        "! absent optional argument is NULL; text ends with c_null_char; see the header for more.\n"
        "module difmesh_c\n"
        f"{_uses(body)}"
        "  use difmesh_types\n"
        "  implicit none\n"
        f"{_wrapped('  private :: ' + ', '.join(_kinds(body)))}\n"
        f"  interface\n{body}  end interface\nend module\n"
    )


def preparation(header: Header, tool: str) -> str:
    """The module of dif_init, which prepares every struct that a function of C prepares without
    further arguments."""
    structs = [
        struct
        for struct in header.structs
        if (function := header.functions.get(struct + "_init"))
        and [p.role for p in function.parameters] == ["struct", "number"]
    ]
    names = ["init_" + struct.removeprefix("dif_") for struct in structs]
    body = "".join(
        f"\n  subroutine {name}(struct)\n"
        f"    type({struct}), intent(out) :: struct\n"
        "    integer(c_int32_t) :: ignored\n"
        f"    ignored = {struct}_init(struct, c_sizeof(struct))\n"
        "  end subroutine\n"
        for name, struct in zip(names, structs)
    )
    return (
        f"{_first_line(tool)}"
        "! The preparation of structs.\n"
        "module difmesh_init\n"
        "  use, intrinsic :: iso_c_binding, only: c_int32_t, c_sizeof\n"
        "  use difmesh_types\n  use difmesh_c\n  implicit none\n  private\n\n"
        "  public :: dif_init\n\n"
        "  ! Prepares a struct, with the defaults of the library where it holds options. A\n"
        "  ! library of another interface may refuse; struct_size then stays 0, and calls with it\n"
        "  ! say so.\n"
        f"  interface dif_init\n{_wrapped('    module procedure ' + ', '.join(names))}"
        f"  end interface\n\ncontains\n{body}\nend module\n"
    )


def _first_line(tool: str) -> str:
    return f"! Written by {tool} from difmesh.h; do not edit, run that again.\n"


def _check_names(names: list[str]) -> None:
    """Fortran does not tell capitals from small letters, and has a longest name."""
    seen: dict[str, str] = {}
    for name in names:
        if len(name) > _LONGEST_NAME:
            raise Unclear(f"{name} is longer than a name of Fortran, {_LONGEST_NAME} letters")
        if name.lower() in seen:
            raise Unclear(f"{name} and {seen[name.lower()]} are the same name in Fortran")
        seen[name.lower()] = name


def _wrapped(statement: str) -> str:
    """A statement in lines that go on with &, cut after commas."""
    indent = " " * (len(statement) - len(statement.lstrip()) + 2)
    if statement.lstrip().startswith(("integer", "subroutine", "real", "type(c_ptr) function")):
        indent += "  "
    lines, line = "", ""
    for piece in re.findall(r".*?, |.+", statement):
        if len(line) + len(piece) > _WIDTH - (2 if piece.endswith(", ") else 0) and line.strip():
            lines += line.rstrip() + " &\n"
            line = indent
        line += piece
    return lines + line + "\n"


def _natural(name: str) -> list[str | int]:
    return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", name)]


def _kinds(body: str) -> list[str]:
    return sorted(
        set(re.findall(r"\bc_(?:char|double|float|funptr|ptr|null_\w+|int\d+_t)\b", body)),
        key=_natural,
    )


def _uses(body: str) -> str:
    return _wrapped(f"  use, intrinsic :: iso_c_binding, only: {', '.join(_kinds(body))}")


def _constants(group: list[tuple[str, int]], kind: str) -> str:
    lines = ", &\n".join(f"    {name.lower()} = {value}" for name, value in group)
    return f"\n  integer({kind}), parameter, public :: &\n{lines}\n"


def _struct(struct: Struct) -> str:
    fields = "".join(f"    {_field(of)}\n" for of in struct.fields)
    return f"\n  type, bind(c), public :: {struct.name}\n{fields}  end type\n"


def _field(of: Variable) -> str:
    name = f"{of.name}({of.length})" if of.length else of.name
    if of.role == "number":
        return f"{_NUMBERS[of.base]} :: {name} = 0"
    if of.role == "struct":
        return f"type({of.base}) :: {name}"
    if of.role == "callback":
        return f"type(c_funptr) :: {name} = c_null_funptr"
    return f"type(c_ptr) :: {name} = c_null_ptr"


def _procedure(function: Function) -> str:
    results = {"text": "type(c_ptr) function", "void": "subroutine"}
    start = results.get(function.result) or f"{_NUMBERS[function.result]} function"
    names = ", ".join(parameter.name for parameter in function.parameters)
    arguments = "".join(_wrapped(f"      {_argument(each)}") for each in function.parameters)
    imported = set(re.findall(r"\bc_\w+\b|(?<=type\()dif_\w+", f"{start}\n{arguments}"))
    imports = ", ".join(sorted(imported, key=lambda name: (name[0] != "c", _natural(name))))
    return (
        _wrapped(f"    {start} {function.name}({names}) bind(c)")
        + (_wrapped(f"      import :: {imports}") if imports else "")
        + arguments
        + f"    end {start.split()[-1]}\n"
    )


def _argument(of: Variable) -> str:
    intent = f"intent({'in' if of.const else 'inout'}){', optional' if of.nullable else ''}"
    if of.role == "number":
        return f"{_NUMBERS[of.base]}, value :: {of.name}"
    if of.role == "one number":
        return f"{_NUMBERS[of.base]}, {intent} :: {of.name}"
    if of.role == "numbers":
        return f"{_NUMBERS[of.base]}, {intent} :: {of.name}({of.length or '*'})"
    if of.role == "callback":
        return f"type(c_funptr), value :: {of.name}"
    if of.role == "text":
        return f"character(kind=c_char), {intent} :: {of.name}(*)"
    if of.role == "struct":
        return f"type({of.base}), {intent} :: {of.name}"
    if of.role == "handles":
        return f"type(c_ptr), {intent} :: {of.name}(*)"
    if of.role in ("borrowed", "borrowed text", "new handle"):
        out = "intent(inout), optional" if of.nullable else "intent(inout)"
        return f"type(c_ptr), {out} :: {of.name}"
    return f"type(c_ptr), value :: {of.name}"  # a handle, memory
