# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""The declarations of the package are those of the headers."""

import ctypes
import re
import subprocess
from enum import IntEnum
from pathlib import Path

import pytest

from crease import _declarations as declared

INCLUDE = Path(__file__).parents[2] / "include"
NUMBERS = {"double": ctypes.c_double, "int": ctypes.c_int, "size_t": ctypes.c_size_t,
           "bool": ctypes.c_bool, "uint64_t": ctypes.c_uint64, "uint32_t": ctypes.c_uint32}


def header(name):
    """The text of a header without comments and with single spaces."""
    text = (INCLUDE / "crease" / name).read_text()
    return re.sub(r"\s+", " ", re.sub(r"/\*.*?\*/", " ", text, flags=re.S))


TEXT = {name: header(name) for name in ("crease.h", "crease_trim.h", "crease_cad.h")}
ALL = " ".join(TEXT.values())


def c_name(python_name):
    return "crease" + re.sub("([A-Z])", lambda letter: "_" + letter.group(1).lower(), python_name)


STRUCTURES = {c_name(name): each for name, each in vars(declared).items()
              if isinstance(each, type) and issubclass(each, ctypes.Structure)
              and each is not ctypes.Structure}
ENUMERATIONS = {c_name(name): each for name, each in vars(declared).items()
                if isinstance(each, type) and issubclass(each, IntEnum) and each is not IntEnum}


def printed_by_c(tmp_path, body):
    """What a C program prints that knows all headers."""
    source = tmp_path / "declared.c"
    source.write_text('#include "crease/crease_cad.h"\n#include <stdio.h>\nint main(void)\n{\n'
                      + body + "    return 0;\n}\n")
    subprocess.run(["cc", f"-I{INCLUDE}", source, "-o", tmp_path / "declared"], check=True)
    return subprocess.run([tmp_path / "declared"], check=True, capture_output=True,
                          text=True).stdout.split()


def test_structures_have_the_layout_that_c_gives_them(tmp_path):
    body, expected = "", []
    for name, structure in STRUCTURES.items():
        body += f'    printf("%zu\\n", sizeof({name}));\n'
        expected.append(ctypes.sizeof(structure))
        for member, member_type in structure._fields_:
            body += (f'    printf("%zu %zu\\n", offsetof({name}, {member}), '
                     f'sizeof((({name} *)0)->{member}));\n')
            expected += [getattr(structure, member).offset, ctypes.sizeof(member_type)]
    assert [int(number) for number in printed_by_c(tmp_path, body)] == expected


def members_of(name):
    found = re.search(r"typedef struct %s \{(.*?)\} %s;" % (name, name), ALL)
    assert found, f"{name} is in no header"
    names = []
    for statement in found.group(1).split(";"):
        for declarator in statement.split(",") if "(*" not in statement else [statement]:
            names += re.findall(r"\(\*(\w+)\)|(\w+)(?:\[\d+\])*\s*$", declarator)
    return [first or second for first, second in names]


@pytest.mark.parametrize("name", STRUCTURES)
def test_structures_have_the_members_of_the_header(name):
    assert [member for member, _ in STRUCTURES[name]._fields_] == members_of(name)


def test_enumerations_have_the_numbers_that_c_gives_them(tmp_path):
    constants = {}
    for name, enumeration in ENUMERATIONS.items():
        prefix = {"crease_status": "CREASE", "crease_region_type": "CREASE_REGION",
                  "crease_part_state": "CREASE_PART",
                  "crease_snap_kind": "CREASE_SNAP"}.get(name, name.upper())
        constants |= {f"{prefix}_{member.name}": member.value for member in enumeration}
    body = "".join(f'    printf("%d\\n", (int){constant});\n' for constant in constants)
    assert [int(number) for number in printed_by_c(tmp_path, body)] == list(constants.values())


@pytest.mark.parametrize("name", ENUMERATIONS)
def test_enumerations_lack_nothing(name):
    if name == "crease_status":
        table = (INCLUDE / "crease/crease.h").read_text().split("CREASE_STATUS_TABLE(X)")[1]
        count = table.split("typedef")[0].count("X(")
    else:
        found = re.search(r"enum %s \{(.*?)\}" % name, ALL)
        count = found.group(1).count(",") + 1
    assert len(ENUMERATIONS[name]) == count


def prototypes(text):
    found = re.findall(r"CREASE_API ([\w *]+?)(crease_\w+)\((.*?)\)", text)
    return {name: (result, [] if arguments == "void" else
                   [re.sub(r"\w+(\[\d*\])?$", lambda end: "*" if end.group(1) else "", argument)
                    for argument in arguments.split(",")])
            for result, name, arguments in found}


def matches(c_type, python_type):
    """Whether a ctypes type stands for a C type such as `const double *`. Any address may go as
    c_void_p."""
    base = re.sub(r"\bconst\b|\*", "", c_type).strip()
    depth = c_type.count("*")
    if base == "void" and depth == 0:
        return python_type is None
    number = STRUCTURES.get(base) or NUMBERS.get(base, ctypes.c_int)
    if depth == 0:
        return python_type is number
    if depth == 1 and python_type is not ctypes.c_void_p:
        return python_type is (ctypes.c_char_p if base == "char" else ctypes.POINTER(number))
    return python_type in (ctypes.c_void_p, ctypes.POINTER(ctypes.c_void_p))


@pytest.mark.parametrize("file, functions", [("crease.h", declared.FUNCTIONS),
                                             ("crease_trim.h", declared.TRIM_FUNCTIONS),
                                             ("crease_cad.h", declared.CAD_FUNCTIONS)])
def test_functions_take_and_return_what_the_header_says(file, functions):
    known = prototypes(TEXT[file])
    wrong = []
    for name, (result, *arguments) in functions.items():
        if name not in known:
            wrong.append(f"{name} is not in {file}")
            continue
        c_result, c_arguments = known[name]
        if not matches(c_result, result):
            wrong.append(f"{name} returns {c_result}, not {result}")
        if len(c_arguments) != len(arguments):
            wrong.append(f"{name} takes {len(c_arguments)} arguments, not {len(arguments)}")
        wrong += [f"{name}: {c_argument.strip()} is not {argument}"
                  for c_argument, argument in zip(c_arguments, arguments)
                  if not matches(c_argument, argument)]
    assert not wrong, "\n".join(wrong)


def test_the_interface_is_that_of_the_version():
    version = (INCLUDE.parent / "VERSION").read_text().split()[0]
    assert version.rsplit(".", 1)[0] == declared.INTERFACE
