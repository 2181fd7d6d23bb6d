"""Reads what a C header of the library declares, for the bindings that are generated from it.

It understands the C that difmesh.h is written in and nothing else: what it does not understand is
an `Unclear` with file and line, never a guess.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import NoReturn, Union

#: The numbers of C that both languages have.
NUMBERS = {
    "int8_t", "int16_t", "int32_t", "int64_t", "uint8_t", "uint16_t", "uint32_t", "uint64_t",
    "float", "double",
}  # fmt: skip


class Unclear(Exception):
    """A declaration that the bindings cannot follow."""


@dataclass(frozen=True)
class Place:
    path: Path
    line: int

    def stop(self, what: str) -> NoReturn:
        raise Unclear(f"{self.path}:{self.line}: {what}")


@dataclass
class Variable:
    """A parameter or a field: `const base** name[length]`."""

    name: str
    place: Place
    base: str
    const: bool
    stars: int
    #: None for no array, 0 for []
    length: int | None
    nullable: bool = False
    #: what it is good for: see _parameter_role() and _field_role()
    role: str = ""


@dataclass
class Struct:
    name: str
    fields: list[Variable]

    @property
    def sized(self) -> bool:
        """Whether it begins with its own size, as all that may grow do."""
        return self.fields[0].name == "struct_size"


@dataclass
class Function:
    """A function, or the type of a callback."""

    name: str
    #: of NUMBERS, "text" or "void"
    result: str
    parameters: list[Variable]


@dataclass
class Header:
    #: each a list of names and values, in the order of the header
    enums: list[list[tuple[str, int]]] = field(default_factory=list)
    macros: list[tuple[str, int]] = field(default_factory=list)
    structs: dict[str, Struct] = field(default_factory=dict)
    handles: set[str] = field(default_factory=set)
    callbacks: dict[str, Function] = field(default_factory=dict)
    functions: dict[str, Function] = field(default_factory=dict)
    #: other names of numbers
    aliases: dict[str, str] = field(default_factory=dict)

    def kind(self, base: str) -> str:
        """What a name stands for as a type, "" for nothing known."""
        for kind, names in (
            ("number", NUMBERS),
            ("struct", self.structs),
            ("handle", self.handles),
            ("callback", self.callbacks),
            ("memory", {"void"}),
            ("text", {"char"}),
        ):
            if base in names:
                return kind
        return ""


@dataclass
class _Token:
    text: str
    place: Place
    #: the comments in front of it, "" for none
    comment: str = ""


_PIECE = re.compile(
    r"(?P<space>[ \t]+)|(?P<line>\n)|(?P<comment>/\*.*?\*/|//[^\n]*)"
    r"|(?P<directive>\#(?:\\\n|[^\n])*)"
    r"|(?P<token>[A-Za-z_]\w*|\d+|\"[^\"\n]*\"|[-{}()\[\];,*=])",
    re.DOTALL,
)


def _tokens(path: Path, header: Header, seen: set[Path]) -> list[_Token]:
    """The tokens of a header and of what it includes, without comments and directives."""
    text = path.read_text(encoding="utf-8")
    found: list[_Token] = []
    directives = _Directives(path, header, seen)
    at, line, comment = 0, 1, ""
    while at < len(text):
        piece = _PIECE.match(text, at)
        place = Place(path, line)
        if piece is None:
            place.stop(f"cannot read {text[at : at + 20].splitlines()[0]!r}")
        if piece.lastgroup == "comment":
            comment += piece.group()
        elif piece.lastgroup == "directive":
            found += directives.obey(piece.group(), place)
            comment = ""
        elif piece.lastgroup == "token":
            if not directives.skipping:
                found.append(_Token(piece.group(), place, comment))
            elif piece.group() not in ("extern", '"C"', "{", "}"):
                place.stop('#ifdef __cplusplus may only open and close extern "C"')
            comment = ""
        line += piece.group().count("\n")
        at = piece.end()
    directives.end(Place(path, line))
    return found


class _Directives:
    """The few lines with # that a header may have.

    Under a condition there may be the definitions of DIF_API and the opening and closing of
    extern "C", which say nothing of the interface; all else stands outside of conditions.
    """

    def __init__(self, path: Path, header: Header, seen: set[Path]) -> None:
        self._path, self._header, self._seen = path, header, seen
        self._conditions: list[str] = []

    @property
    def skipping(self) -> bool:
        return "__cplusplus" in self._conditions

    def obey(self, text: str, place: Place) -> list[_Token]:
        words = re.sub(r"/\*.*?\*/|//.*|\\\n", " ", text, flags=re.DOTALL)[1:].split()
        line = " ".join(words)
        if words[0] in ("if", "ifdef", "ifndef"):
            self._conditions.append(words[-1] if line == "ifdef __cplusplus" else line)
        elif words[0] in ("elif", "else", "endif"):
            self._continue(words[0], place)
        elif words[0] == "include":
            return self._include(line, place)
        elif words[0] == "define" and len(words) > 1:
            self._define(line, place)
        else:
            place.stop(f"the directive #{line} is not understood")
        return []

    def end(self, place: Place) -> None:
        if self._conditions:
            place.stop(f"#{self._conditions[-1]} is not closed")

    def _continue(self, word: str, place: Place) -> None:
        if not self._conditions:
            place.stop(f"#{word} without #if")
        if word == "endif":
            self._conditions.pop()
        elif self.skipping:
            place.stop('#ifdef __cplusplus may only open and close extern "C"')

    def _include(self, line: str, place: Place) -> list[_Token]:
        if line in ("include <stddef.h>", "include <stdint.h>"):
            return []
        ours = re.fullmatch(r'include ["<](?:difmesh/)?([\w/]+\.h)[">]', line)
        path = self._path.parent / ours[1] if ours else None
        if path is None or not path.exists():
            place.stop(f"#{line} is neither <stddef.h>, <stdint.h> nor a header of the library")
        if path.resolve() in self._seen:
            return []
        self._seen.add(path.resolve())
        return _tokens(path, self._header, self._seen)

    def _define(self, line: str, place: Place) -> None:
        name = line.split()[1]
        if name == "DIF_API" or f"ifndef {name}" in self._conditions:  # the guard
            return
        number = re.fullmatch(r"define (DIF_\w+) (\d+)", line)
        if not number:
            place.stop(f"#{line} is not a whole number with a name DIF_...")
        if any(not condition.startswith("ifndef ") for condition in self._conditions):
            place.stop(f"{name} is defined under the condition {self._conditions[-1]!r}")
        self._header.macros.append((number[1], int(number[2])))


class _Parser:
    def __init__(self, tokens: list[_Token], header: Header, end: Place) -> None:
        self._tokens, self._header, self._at = tokens, header, 0
        self._end = _Token("the end of the file", end)
        #: the functions that the last comment stands in front of, and the names that it says may
        #: be NULL
        self._described: list[Function] = []
        self._nullable: dict[str, Place] = {}

    def read(self) -> None:
        while self._at < len(self._tokens):
            token = self._look()
            if token.comment or token.text != "DIF_API":
                self._end_of_description()
            if token.text == "typedef":
                self._typedef()
            elif token.text == "enum":
                self._enum()
            elif token.text == "DIF_API":
                self._function()
            else:
                token.place.stop(f"{token.text!r} begins neither typedef, enum nor DIF_API")
        self._end_of_description()

    def _look(self, ahead: int = 0) -> _Token:
        at = self._at + ahead
        return self._tokens[at] if at < len(self._tokens) else self._end

    def _next(self) -> _Token:
        token = self._look()
        self._at += 1
        return token

    def _take(self, *texts: str) -> Place:
        """The tokens that must follow; the place of the last one."""
        for text in texts:
            token = self._next()
            if token.text != text:
                token.place.stop(f"{text!r} is needed, {token.text!r} found")
        return token.place

    def _name(self) -> _Token:
        token = self._next()
        if not re.fullmatch(r"[A-Za-z_]\w*", token.text):
            token.place.stop(f"a name is needed, {token.text!r} found")
        return token

    def _new_type(self) -> _Token:
        token = self._name()
        if self._header.kind(token.text) or token.text in self._header.aliases:
            token.place.stop(f"{token.text} is declared twice")
        if not token.text.startswith("dif_"):
            token.place.stop(f"the type {token.text} is not called dif_...")
        return token

    def _number(self) -> int:
        sign = -1 if self._look().text == "-" else 1
        if sign < 0:
            self._next()
        token = self._next()
        if not token.text.isdigit():
            token.place.stop(f"a whole number is needed, {token.text!r} found")
        value = sign * int(token.text)
        if not -(2**31) <= value < 2**31:
            token.place.stop(f"{value} is no number of 32 bits")
        return value

    def _typedef(self) -> None:
        self._take("typedef")
        if self._look().text == "struct":
            self._struct()
        elif self._look(1).text == "(":
            result = self._result()
            self._take("(", "*")
            name = self._new_type().text
            self._take(")")
            self._header.callbacks[name] = Function(name, result, self._parameters())
        else:
            kind = self._variable_type()
            name = self._new_type().text
            if kind.const or kind.stars or kind.base not in NUMBERS:
                kind.place.stop(f"{name} is another name of something that is no number")
            self._take(";")
            self._header.aliases[name] = kind.base

    def _struct(self) -> None:
        self._take("struct")
        token = self._new_type()
        name = token.text
        if self._look().text != "{":
            self._take(name, ";")
            self._header.handles.add(name)
            return
        self._take("{")
        fields: list[Variable] = []
        while self._look().text != "}":
            variable = self._variable()
            self._take(";")
            variable.role = self._field_role(variable)
            if variable.name in [field.name for field in fields]:
                variable.place.stop(f"{name} has two fields {variable.name}")
            fields.append(variable)
        self._take("}", name, ";")
        if not fields:
            token.place.stop(f"{name} has no fields")
        self._header.structs[name] = Struct(name, fields)

    def _enum(self) -> None:
        self._take("enum", "{")
        constants: list[tuple[str, int]] = []
        while self._look().text != "}":
            token = self._name()
            if not token.text.startswith("DIF_"):
                token.place.stop(f"the constant {token.text} is not called DIF_...")
            self._take("=")
            constants.append((token.text, self._number()))
            if self._look().text != "}":
                self._take(",")
        self._take("}", ";")
        self._header.enums.append(constants)

    def _function(self) -> None:
        first = self._at
        if self._look().comment:
            self._nullable = _may_be_null(self._look())
        self._take("DIF_API")
        result = self._result()
        name = self._name()
        if not name.text.startswith("dif_") or name.text in self._header.functions:
            name.place.stop(f"{name.text} is declared twice or not called dif_...")
        function = Function(name.text, result, self._parameters())
        for token in self._tokens[first + 1 : self._at]:
            if "may be NULL" in token.comment:
                token.place.stop("what may be NULL belongs into the comment in front of DIF_API")
        for parameter in function.parameters:
            options = parameter.const and re.search(r"_options$", parameter.base)
            parameter.nullable = parameter.name in self._nullable or bool(options)
            if parameter.nullable and not (parameter.stars or parameter.length is not None):
                parameter.place.stop(f"{parameter.name} is no pointer, so it cannot be NULL")
        self._header.functions[function.name] = function
        self._described.append(function)

    def _end_of_description(self) -> None:
        names = {parameter.name for f in self._described for parameter in f.parameters}
        for name, place in self._nullable.items():
            if name not in names:
                place.stop(f"the comment says that `{name}` may be NULL; no parameter is called so")
        self._described, self._nullable = [], {}

    def _result(self) -> str:
        kind = self._variable_type()
        if (kind.base, kind.const, kind.stars) == ("char", True, 1):
            return "text"
        if kind.stars == 0 and not kind.const and kind.base in NUMBERS | {"void"}:
            return kind.base
        kind.place.stop("a result is a number, const char* or void")

    def _parameters(self) -> list[Variable]:
        self._take("(")
        found: list[Variable] = []
        if self._look().text == "void" and self._look(1).text == ")":
            self._next()
        else:
            while True:
                variable = self._variable()
                variable.role = self._parameter_role(variable)
                found.append(variable)
                if self._look().text != ",":
                    break
                self._take(",")
        self._take(")", ";")
        return found

    def _variable_type(self) -> Variable:
        place = self._look().place
        const = self._look().text == "const"
        if const:
            self._next()
        base = self._name().text
        base = self._header.aliases.get(base, base)
        if not self._header.kind(base):
            place.stop(f"the type {base} is not known")
        stars = 0
        while self._look().text == "*":
            self._next()
            stars += 1
            if self._look().text == "const":  # of the pointer: says nothing to the caller
                self._next()
        return Variable("", place, base, const, stars, None)

    def _variable(self) -> Variable:
        variable = self._variable_type()
        variable.name = self._name().text
        if self._look().text == "[":
            self._next()
            variable.length = 0 if self._look().text == "]" else self._length()
            self._take("]")
        if self._look().text == "[":
            self._look().place.stop("arrays of arrays are not understood")
        return variable

    def _length(self) -> int:
        place = self._look().place
        length = dict(self._header.macros).get(self._look().text)
        if length is None:
            length = self._number()
        else:
            self._next()
        if length < 1:
            place.stop(f"an array of {length} elements")
        return length

    def _parameter_role(self, of: Variable) -> str:
        """What a parameter is: one line per way to write it."""
        kind = self._header.kind(of.base)
        written = (kind, "const" if of.const else "", of.stars, of.length is not None)
        roles: dict[tuple[Union[str, int, bool], ...], str] = {
            ("number", "", 0, False): "number",
            ("callback", "", 0, False): "callback",
            ("number", "", 1, False): "one number",
            ("number", "const", 0, True): "numbers",
            ("number", "", 0, True): "numbers",
            ("number", "const", 2, False): "borrowed",
            ("memory", "const", 1, False): "memory",
            ("memory", "", 1, False): "memory",
            ("text", "const", 1, False): "text",
            ("text", "const", 2, False): "borrowed text",
            ("struct", "const", 1, False): "struct",
            ("struct", "", 1, False): "struct",
            ("handle", "const", 1, False): "handle",
            ("handle", "", 1, False): "handle",
            ("handle", "", 2, False): "new handle",
            ("handle", "const", 1, True): "handles",
        }
        if written not in roles:
            hint = "; write [] for several numbers" if written[:3] == ("number", "const", 1) else ""
            of.place.stop(f"the bindings do not know what to make of the parameter {of.name}{hint}")
        return roles[written]

    def _field_role(self, of: Variable) -> str:
        """What a field is."""
        kind = self._header.kind(of.base)
        if of.length == 0:
            of.place.stop(f"the field {of.name} has no length")
        if of.stars == 0 and kind in ("number", "struct", "callback") and not of.const:
            return kind
        if of.stars == 1 and kind == "text" and of.const:
            return "text"
        if of.stars in (1, 2) and kind != "callback" and (of.const or kind != "text"):
            return "memory"
        of.place.stop(f"the bindings do not know what to make of the field {of.name}")


_NAMES = r"`\w+`(?:(?:,| and| or|, and) `\w+`)*"


def _may_be_null(token: _Token) -> dict[str, Place]:
    """The names of which the comment in front of a function says "`a` and `b` may be NULL"."""
    text = re.sub(r"\s*\n\s*\*?\s*", " ", token.comment)
    said = re.findall(rf"({_NAMES}) may be NULL", text)
    if len(said) != len(re.findall(r"\bmay be NULL", text)):
        token.place.stop(
            "the comment in front says that something may be NULL, but not in the words "
            "\"`x` may be NULL\" or \"`x` and `y` may be NULL\""
        )
    return {name: token.place for names in said for name in re.findall(r"\w+", names)
            if name not in ("and", "or")}  # fmt: skip


def read_header(path: Path) -> Header:
    """What the header at `path` declares, with the headers of the library that it includes."""
    header = Header()
    tokens = _tokens(path, header, {path.resolve()})
    _Parser(tokens, header, Place(path, path.read_text(encoding="utf-8").count("\n") + 1)).read()
    return header
