#!/usr/bin/env python3
"""Do includes run downward only? Checks every include of the library against the rooms below.

A room may include itself and the rooms that it names, and through them nothing else. A public
header of the core belongs to the room of its name in PUBLIC. Exits with 1 and a line per include
that runs upward, per file outside the rooms, and per room that is named but not there.

    scripts/check_rooms.py [ROOT]
"""

import pathlib
import re
import sys

# Folders of cxx/src, lowest first, and what each may include.
ROOMS = {
    "base": [],
    "grid": ["base"],
    "lanes": [],
    "planes": ["base", "grid", "lanes"],
    "cells": ["base", "grid", "planes"],
    "curved": ["base", "grid", "planes"],
    "placement": ["base", "grid", "lanes", "planes", "cells"],
    "mesh": ["base", "grid"],
    "surface": ["base", "grid", "planes", "cells", "curved", "placement", "mesh"],
    "sampling": ["base", "grid", "mesh"],
    "shapes": ["base", "grid", "mesh", "sampling"],
}

# Headers of cxx/include/difmesh by the room that implements them.
PUBLIC = {
    "base": ["array", "error", "float_environment", "out_of_memory", "printable", "progress",
             "vec3", "version"],
    "grid": ["block", "edge_id", "field_view", "grid", "names", "options", "report",
             "values"],
    "planes": ["plane"],
    "cells": ["cell_planes"],
    "curved": ["cell_surfaces"],
    "mesh": ["curvature", "measure", "mesh", "mesh_portion", "smoothing",
             "vertex_normals"],
    "surface": ["reconstruct", "surface_builder", "vertex_curvature", "weld"],
    "sampling": ["constrained_smoothing", "fractions_from_function", "fractions_from_mesh",
                 "mollify"],
    "shapes": ["shapes"],
}

# Folders of the project: which of the others they may include.
HOUSES = {
    "cxx": [],
    "io": ["cxx"],
    "metrics": ["cxx"],
    "adapters": ["cxx", "io"],
    "capi": ["cxx", "io", "metrics", "adapters"],
    "cli": ["cxx", "io", "metrics"],
}

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.M)
SOURCES = {".hpp", ".cpp", ".h", ".in"}


def sources(folder: pathlib.Path) -> list[pathlib.Path]:
    return sorted(path for path in folder.rglob("*") if path.suffix in SOURCES)


def public_room(header: str) -> str | None:
    stem = header.removeprefix("difmesh/").removesuffix(".in").removesuffix(".hpp")
    return next((room for room, stems in PUBLIC.items() if stem in stems), None)


class Checker:
    def __init__(self, root: pathlib.Path) -> None:
        self.root = root
        self.core = root / "cxx" / "src"
        self.faults: list[str] = []

    def fault(self, path: pathlib.Path, text: str) -> None:
        self.faults.append(f"{path.relative_to(self.root)}: {text}")

    def room_of(self, path: pathlib.Path) -> str | None:
        if path.is_relative_to(self.core):
            room = path.relative_to(self.core).parts[0]
            return room if room in ROOMS else None
        return public_room(path.name)

    def check_core(self) -> None:
        for room in ROOMS:
            if not (self.core / room).is_dir():
                self.fault(self.core / room, "is named in check_rooms.py and is not there")
        headers = sources(self.root / "cxx" / "include")
        umbrella = [path for path in headers if path.name == "difmesh.hpp"]
        for path in sources(self.core) + [path for path in headers if path not in umbrella]:
            room = self.room_of(path)
            if room is None:
                self.fault(path, "stands in no room")
                continue
            for included in INCLUDE.findall(path.read_text()):
                self.check_include(path, room, included)

    def check_include(self, path: pathlib.Path, room: str, included: str) -> None:
        if included.startswith("difmesh/"):
            target = public_room(included)
        elif (self.core / included).is_file():
            target = included.split("/")[0]
        else:
            return
        if target is None:
            self.fault(path, f"includes {included}, which stands in no room")
        elif target != room and target not in ROOMS[room]:
            self.fault(path, f"{room} must not include {target} ({included})")

    def check_houses(self) -> None:
        owner: dict[str, str] = {}
        for house in HOUSES:
            for path in sources(self.root / house / "include"):
                name = str(path.relative_to(self.root / house / "include")).removesuffix(".in")
                owner[name] = house
        for house, allowed in HOUSES.items():
            for path in sources(self.root / house):
                for included in INCLUDE.findall(path.read_text()):
                    target = owner.get(included)
                    if target not in (None, house) and target not in allowed:
                        self.fault(path, f"{house} must not include {target} ({included})")


def main() -> int:
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    checker = Checker(root.resolve())
    checker.check_core()
    checker.check_houses()
    print("\n".join(checker.faults) or "rooms: all includes run downward")
    return 1 if checker.faults else 0


if __name__ == "__main__":
    sys.exit(main())
