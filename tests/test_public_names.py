"""Every public name exists, is documented, and its docstring keeps the form."""

import ast
import inspect
from importlib import import_module
from pathlib import Path

import pytest
from numpydoc.validate import validate

ROOT = Path(__file__).parents[1]
ROOMS = ("behaviours", "evidence", "merge", "topomap", "worlds")

CHECKS = {
    *("GL03", "GL05", "GL06", "GL07", "GL08", "GL09", "GL10"),
    *("SS01", "SS02", "SS03", "SS04", "SS06"),
    *("PR02", "PR03", "PR04", "PR05", "PR06", "PR07", "PR09", "PR10"),
    *("RT02", "RT03", "RT04", "RT05"),
}
"""What numpydoc is asked to check. Left out:

- GL01, GL02: where the quotes stand; ruff settles that.
- ES01, SA01, EX01: a section is there when it has something to say.
- SS05: takes nouns that end in -s for verbs in the wrong form.
- PR08: a description may begin with a name, such as ``r0``.
- RT01: the first line may have said what is returned.
- YD01: a behaviour yields primitives, as its type says, and returns a value.
"""

EVERY_PARAMETER = {"PR01"}
"""Asked of functions that describe a parameter: then they describe all. A class
describes its fields one by one, where they stand."""


def public_names():
    """Yield module and name of all that is public."""
    for room in ROOMS:
        for path in sorted((ROOT / room).rglob("*.py")):
            parts = path.relative_to(ROOT).with_suffix("").parts
            module = ".".join(parts).removesuffix(".__init__")
            for node in ast.parse(path.read_text()).body:
                if isinstance(node, ast.Assign) and is_all(node.targets[0]):
                    for name in ast.literal_eval(node.value):
                        yield module, name


def is_all(target):
    return isinstance(target, ast.Name) and target.id == "__all__"


NAMES = list(public_names())


@pytest.mark.parametrize(("module", "name"), NAMES)
def test_public_name_exists(module, name):
    assert hasattr(import_module(module), name)


@pytest.mark.parametrize("module", sorted({module for module, _ in NAMES}))
def test_public_names_are_named_once(module):
    names = [name for where, name in NAMES if where == module]
    assert len(set(names)) == len(names)


def documented():
    """Yield the full name of each public function, class and method."""
    for module, name in NAMES:
        thing = getattr(import_module(module), name, None)
        if not (inspect.isfunction(thing) or inspect.isclass(thing)):
            continue
        if thing.__module__ != module:
            continue  # it is checked where it is defined
        yield f"{module}.{name}"
        for member, value in vars(thing).items() if inspect.isclass(thing) else ():
            if inspect.isfunction(value) and not member.startswith("_"):
                yield f"{module}.{name}.{member}"


@pytest.mark.parametrize("full_name", sorted(set(documented())))
def test_docstring_keeps_the_form(full_name):
    found = validate(full_name)
    checks = CHECKS
    if found["type"] == "function" and "\nParameters\n" in found["docstring"]:
        checks = CHECKS | EVERY_PARAMETER
    faults = [f"{code}: {text}" for code, text in found["errors"] if code in checks]
    assert not faults, f"{found['file']}:{found['file_line']}"
