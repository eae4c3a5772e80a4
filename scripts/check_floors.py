#!/usr/bin/env python3
"""Checks that includes go down only: a room never knows one above it, or beside it.

Usage: check_floors.py [--root DIR]      prints each fault as `file:line: what`; exit code 1 if there is any.

The table below is the house; CMakeLists.txt's lightsweep_room lines say which lower rooms each one uses. An include must
agree with both, and so must the lines with the table. GL and EGL headers stay in renderer/gl, out of what it shows to others.
"""

import argparse
import pathlib
import re
import sys

# Top first; rooms of one floor do not know each other.
FLOORS = (
    ("bench/cli", "bench/micro"),
    ("bench/stress",),
    ("bench/encodings", "bench/explore"),
    ("bench/measure",),
    ("bench/report",),
    ("bench/plan", "bench/stats", "bench/metrics"),
    ("renderer/paths", "renderer/post"),
    ("renderer/pass",),
    ("renderer/gbuffer", "renderer/reference"),
    ("renderer/frame",),
    ("renderer/gl", "renderer/scene", "renderer/image"),
    ("renderer/base",),
)
FLOOR_OF = {room: floor for floor, rooms in enumerate(FLOORS) for room in rooms}
GL_ROOM = "renderer/gl"
# Not rooms, and open to all: what C++ and GLSL share, and what the build generates.
SHARED_FOLDERS = ("shaders/shared", "generated")

INCLUDE = re.compile(r'\s*#\s*include\s*([<"])([^>"]+)[>"]')
GL_HEADER = re.compile(r"(glad|GL|GLES\d*|EGL|KHR)/")
ROOM_LINE = re.compile(r"lightsweep_room\((\w+)\s+([^)]*)\)")


def declared_rooms(cmake_file):
    """{room: (line, folder, [rooms it links])} of every lightsweep_room line."""
    text = cmake_file.read_text(encoding="utf-8") if cmake_file.exists() else ""
    rooms = {}
    for match in ROOM_LINE.finditer(text):
        folder = re.search(r"\bDIR\s+(\S+)", match[2])
        links = re.findall(r"\blightsweep_(\w+)", match[2])
        rooms[match[1]] = (text.count("\n", 0, match.start()) + 1, folder[1] if folder else "", links)
    return rooms


def reachable(name, rooms):
    """The folders of every room that `name` links, directly or through others."""
    seen, queue = set(), [name]
    while queue:
        for link in rooms.get(queue.pop(), (0, "", []))[2]:
            if link in rooms and link not in seen:
                seen.add(link)
                queue.append(link)
    return {rooms[link][1] for link in seen}


def not_below(room, other):
    """Why `room` may not use `other`, or nothing."""
    if other not in FLOOR_OF:
        return f"{other} is in no floor of scripts/check_floors.py"
    if FLOOR_OF[other] < FLOOR_OF[room]:
        return f"{room} is below {other}: includes go down only"
    if FLOOR_OF[other] == FLOOR_OF[room]:
        return f"{room} and {other} are on one floor and do not know each other"
    return None


def cmake_faults(rooms):
    for name, (line, folder, links) in rooms.items():
        if folder not in FLOOR_OF:
            yield f"CMakeLists.txt:{line}: room {name}: {folder or 'no folder'} is in no floor of scripts/check_floors.py"
            continue
        for link in links:
            if link in rooms and (why := not_below(folder, rooms[link][1])):
                yield f"CMakeLists.txt:{line}: room {name} links {link}: {why}"


def room_of(path):
    return "/".join(path.parts[:2]) if len(path.parts) > 2 else None


def included_file(root, file, target):
    """The project's file that `target` names, from the root or beside `file`; nothing for anybody else's header."""
    for base in (root, file.parent):
        candidate = (base / target).resolve()
        if candidate.is_file() and candidate.is_relative_to(root):
            return candidate.relative_to(root)
    # A file that is not there yet still belongs to the room that its path names.
    path = pathlib.Path(target)
    return path if room_of(path) in FLOOR_OF else None


def include_fault(root, file, quote, target, allowed):
    """What is wrong with one include of `file`, or nothing. `allowed`: the rooms its room links; None: all below."""
    relative = file.relative_to(root)
    room = room_of(relative)
    if GL_HEADER.match(target):
        if room != GL_ROOM:
            return f"<{target}>: GL headers stay in {GL_ROOM}"
        if file.suffix == ".h" and not file.stem.endswith("_internal"):
            return f"<{target}>: a header that others may include shows no GL; only *_internal.h may"
        return None
    included = included_file(root, file, target)
    if included is None:
        if quote == '"' and not target.startswith(SHARED_FOLDERS):
            return f'"{target}": no such file from the root of the project'
        return None
    if included.as_posix().startswith(SHARED_FOLDERS):
        return None
    if included.as_posix() != target:
        return f'"{target}": write includes from the root of the project: "{included.as_posix()}"'
    other = room_of(included)
    if other == room:
        return None
    if why := not_below(room, other):
        return f'"{target}": {why}'
    if allowed is not None and other not in allowed:
        return f'"{target}": {room} does not link {other} in CMakeLists.txt'
    if included.stem.endswith("_internal"):
        return f'"{target}": an *_internal.h is for its own room'
    return None


def source_faults(root, rooms):
    name_of = {folder: name for name, (_, folder, _) in rooms.items()}
    for top in ("bench", "renderer"):
        for file in sorted((root / top).rglob("*")):
            if file.suffix not in (".h", ".cpp"):
                continue
            relative = file.relative_to(root)
            room = room_of(relative)
            if room not in FLOOR_OF:
                yield f"{relative}:1: {room or top} is in no floor of scripts/check_floors.py"
                continue
            allowed = reachable(name_of[room], rooms) if room in name_of else None
            for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
                if match := INCLUDE.match(line):
                    if what := include_fault(root, file, match[1], match[2], allowed):
                        yield f"{relative}:{number}: {what}"


def faults(root):
    rooms = declared_rooms(root / "CMakeLists.txt")
    return [*cmake_faults(rooms), *source_faults(root, rooms)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).parent.parent)
    found = faults(parser.parse_args().root.resolve())
    for fault in found:
        print(fault)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
