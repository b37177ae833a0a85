"""The parts of others that the program is built of, with their licences: cmake/parts.csv.

Columns: part; what CMake knows it by; beginnings of the names of its libraries, none for headers and fonts, with a ?
after them if the program loads them on some systems only; Debian package it is built with; licence as SPDX writes it.
"""
import csv
import re

import tree

table = "cmake/parts.csv"
cmake_files = ("CMakeLists.txt", "cmake/libraries.cmake", *(f"{layer}/CMakeLists.txt" for layer in tree.layers))
asked = re.compile(r"\b(?:find_dependency|find_package|pkg_check_modules)\(\s*(\w+)")


def parts():
    return list(csv.DictReader(tree.text(table).splitlines()))


def part_of(library):
    """The part that a library of this file name (libgdal.so.32) belongs to; None: it is in no row."""
    stem = library.split(".so")[0]
    return next((part for part in parts() if stem in part["library"].rstrip("?").split()), None)


def check_parts():
    faults = []
    named = {name for part in parts() for name in part["cmake"].split()}
    used = {name for file in cmake_files for name in asked.findall(tree.text(file))} - {"PkgConfig"}
    for name in sorted(used - named):
        faults.append(f"{table}: has no row for {name}, which CMake looks for")
    for name in sorted(named - used):
        faults.append(f"{table}: CMake does not look for {name}")
    # What tools/setup installs to build: libraries and fonts.
    run = re.search(r"^run=\(([^)]*)\)", (tree.root / "tools/setup").read_text(encoding="utf-8"), re.M).group(1).split()
    packages = {part["package"] for part in parts()}
    for name in run:
        if re.match(r"lib.*-dev$|fonts-|nlohmann", name) and name not in packages:
            faults.append(f"{table}: has no row for the package {name} of tools/setup")
    return faults, f"{len(parts())} parts with licences"
