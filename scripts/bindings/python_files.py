"""The structs, constants and functions of a C header as ctypes has them."""

from __future__ import annotations

import keyword
import re

from c_header import Function, Header, Unclear, Variable

_WIDTH = 100


def _class(name: str) -> str:
    return "".join(word.title() for word in name.split("_"))


def _ctype(number: str) -> str:
    return "c_" + number.removesuffix("_t")


def _imports(body: str) -> str:
    """What the body takes from ctypes, in one line or several."""
    names = set(re.findall(r"\b(?:c_\w+|CFUNCTYPE|POINTER|Structure)\b", body))
    ordered = sorted(names, key=lambda name: (not name.isupper(), name.islower(), name))
    line = f"from ctypes import {', '.join(ordered)}"
    if len(line) <= _WIDTH:
        return line
    return "from ctypes import (\n" + "".join(f"    {name},\n" for name in ordered) + ")"


def _module(title: str, imports: str, body: str, tool: str) -> str:
    return (
        f'"""{title}\n\n'
        f'Written by {tool} from difmesh.h; do not edit, run that again.\n"""\n\n'
        f"from __future__ import annotations\n\n{imports}{body}"
    )


def constants(header: Header, tool: str) -> str:
    """The module of the constants, without DIF_ in front."""
    groups = header.enums + ([header.macros] if header.macros else [])
    blocks = []
    for group in groups:
        for name, _ in group:
            word = name.removeprefix("DIF_")
            if not word.isidentifier() or keyword.iskeyword(word):
                raise Unclear(f"{name} without DIF_ is no name in Python")
        blocks.append("".join(f"{name.removeprefix('DIF_')} = {value}\n" for name, value in group))
    title = "The constants of difmesh.h, without DIF_; see there for what they mean."
    return _module(title, "", "\n".join(blocks), tool)


def structs(header: Header, tool: str) -> str:
    """The module of the structs and of the types of callbacks."""
    body = ""
    for callback in header.callbacks.values():
        kinds = ", ".join([_result(callback.result), *(_argument(p) for p in callback.parameters)])
        body += f"{_class(callback.name)} = CFUNCTYPE({kinds})\n"
    for struct in header.structs.values():
        base = "Sized" if struct.sized else "Structure"
        body += f"\n\nclass {_class(struct.name)}({base}):\n    _fields_ = [\n"
        body += "".join(f'        ("{of.name}", {_field(of)}),\n' for of in struct.fields)
        body += "    ]\n"
    title = "The structs of difmesh.h, field by field in its order; see there for what they mean."
    imports = f"{_imports(body)}\n\nfrom ._sized import Sized\n\n"
    return _module(title, imports, body, tool)


def prototypes(header: Header, tool: str) -> str:
    """The module of the functions' results and arguments."""
    body = "#: Result and arguments of each function.\n"
    body += "FUNCTIONS: dict[str, tuple[Any, list[Any]]] = {\n"
    body += "".join(_prototype(function) for function in header.functions.values()) + "}\n"
    title = "The functions of difmesh.h as ctypes has them."
    imports = f"{_imports(body)}\nfrom typing import Any\n\nfrom . import _structs as s\n\n"
    return _module(title, imports, body, tool)


def _prototype(function: Function) -> str:
    result = _result(function.result)
    arguments = [_argument(parameter, "s.") for parameter in function.parameters]
    line = f'    "{function.name}": ({result}, [{", ".join(arguments)}]),\n'
    if len(line) <= _WIDTH + 1:
        return line
    inner = f"        [{', '.join(arguments)}],\n"
    if len(inner) > _WIDTH + 1:
        lines = "".join(f"            {each},\n" for each in arguments)
        inner = f"        [\n{lines}        ],\n"
    return f'    "{function.name}": (\n        {result},\n{inner}    ),\n'


def _result(result: str) -> str:
    return {"void": "None", "text": "c_char_p"}.get(result) or _ctype(result)


def _argument(of: Variable, module: str = "") -> str:
    if of.role == "number":
        return _ctype(of.base)
    if of.role == "one number" or (of.role == "numbers" and of.length):
        return f"POINTER({_ctype(of.base)})"
    if of.role == "callback":
        return module + _class(of.base)
    if of.role == "struct":
        return f"POINTER({module}{_class(of.base)})"
    return {
        "numbers": "c_void_p",
        "memory": "c_void_p",
        "handle": "c_void_p",
        "text": "c_char_p",
        "borrowed": "POINTER(c_void_p)",
        "new handle": "POINTER(c_void_p)",
        "handles": "POINTER(c_void_p)",
        "borrowed text": "POINTER(c_char_p)",
    }[of.role]


def _field(of: Variable) -> str:
    kinds = {"memory": "c_void_p", "text": "c_char_p"}
    if of.role == "number":
        kind = _ctype(of.base)
    else:
        kind = kinds.get(of.role) or _class(of.base)
    return f"{kind} * {of.length}" if of.length else kind
