# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""The keywords are the options of the program."""

import inspect
import re
import sys
from pathlib import Path

import pytest

import crease
from crease import _fit

TABLE = (Path(__file__).parents[2] / "cli/option.c").read_text()
#: What methods or other calls do here, and what is for files larger than memory.
ELSEWHERE = {"output", "creases", "points", "report", "skip_invalid", "mesh_points", "json",
             "quiet", "help", "resume", "scratch"}


def program_options(command):
    found = re.findall(r'\{"([a-z-]+)",[^"]*?(?:"[^"]*")?,?\s*(FOR_[A-Z_]+(?:\s*\|\s*FOR_[A-Z_]+)*)',
                       TABLE)
    names = {name.replace("-", "_") for name, commands in found
             if {f"FOR_{command.upper()}", "FOR_ALL"} & set(re.findall(r"\w+", commands))}
    return names - ELSEWHERE


@pytest.mark.parametrize("command", ["detect", "filter", "compare"])
def test_keywords_are_those_of_the_program(command):
    keywords = set(inspect.signature(getattr(crease, command)).parameters)
    assert keywords - {"points", "model", "progress"} == program_options(command)


def test_the_options_of_fit_are_those_of_the_program():
    taken = set().union(*_fit._TAKES.values()) | {"method", "seed", "threads", "memory"}
    assert taken == program_options("fit")


@pytest.mark.skipif(sys.version_info < (3, 11), reason="Python does not keep overloads")
def test_each_method_of_fit_has_its_options_in_its_signature():
    from typing import get_args, get_overloads
    told = {}
    for overload in get_overloads(crease.fit):
        parameters = dict(inspect.signature(overload, eval_str=True).parameters)
        method, = get_args(parameters.pop("method").annotation)
        told[method] = set(parameters) - {"points", "seed", "threads", "memory", "progress"}
    assert told == _fit._TAKES
