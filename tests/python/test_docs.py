# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""What the documents show runs."""

import re
from pathlib import Path

import pytest

import crease
from conftest import roof

SOURCE = Path(__file__).parents[2]
SHOWN = [(name, block) for name in ("README.md", "docs/python.md")
         for block in re.findall(r"```python\n(.*?)```", (SOURCE / name).read_text(), flags=re.S)]


@pytest.mark.skipif(not crease.HAS_CAD, reason="built without OpenCASCADE")
@pytest.mark.parametrize("name, block", SHOWN)
def test_examples_run(tmp_path, monkeypatch, name, block):
    monkeypatch.chdir(tmp_path)
    exec(block.replace('"bracket"', '"cube"'), {"crease": crease, "xyz": roof(600, noise=0.005)})


def test_the_document_names_everything_that_is_exported():
    text = (SOURCE / "docs/python.md").read_text()
    functions = [name for name in crease.__all__ if name[0].islower()]
    assert all(f"crease.{name}(" in text for name in functions)
