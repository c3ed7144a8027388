"""What is installed: parts work or say why not; the program completes its words."""

import json
import os
import subprocess
import sys
from importlib import metadata

import pytest

from topomap.cli import main
from topomap.errors import JobError
from topomap.installation import check_parts, installed_version, parts_of

NEEDS = ["numpy>=1.26", "PyYAML", "warp-drive>=9; extra == 'space'"]


@pytest.fixture
def installed(monkeypatch):
    """Let topomap be installed, with some needs."""
    needs = list(NEEDS)
    real = metadata.version
    monkeypatch.setattr(metadata, "requires", lambda _: needs)
    monkeypatch.setattr(
        metadata,
        "version",
        lambda name: "7.8" if name == "topomap-robots" else real(name),
    )
    return needs


@pytest.fixture
def uninstalled(monkeypatch):
    def missing(name):
        raise metadata.PackageNotFoundError(name)

    monkeypatch.setattr(metadata, "version", missing)
    monkeypatch.setattr(metadata, "requires", missing)


def test_each_extra_is_a_part_and_what_is_missing_is_named(installed):
    core, space = check_parts()
    assert (core.name, core.works, core.faults) == ("core", True, ())
    assert core.needs[0].found == metadata.version("numpy")
    assert (space.name, space.works) == ("space", False)
    assert space.faults == ("warp-drive is missing",)


@pytest.mark.parametrize(
    ("line", "works"),
    [
        ("numpy", True),
        ("numpy>=1", True),
        ("numpy>=0.0.0", True),
        ("numpy>={}", True),
        ("numpy>={}.0", True),
        ("numpy>={}.1", False),
        ("numpy>=1000", False),
        ("mkdocstrings[python]>=1000; extra == 'docs'", False),
    ],
)
def test_a_version_will_do_from_the_least_on(line, works):
    (*_, part) = parts_of([line.format(metadata.version("numpy"))], {})
    assert part.works == works


def test_a_version_that_is_too_old_is_told():
    ((need,),) = (part.needs for part in parts_of(["numpy>=1000"], {}))
    assert need.fault == f"{metadata.version('numpy')} is older than 1000"


def test_a_module_that_cannot_be_imported_is_told(tmp_path, monkeypatch):
    (tmp_path / "broken_at_heart.py").write_text("raise OSError('no\\nlibrary')")
    monkeypatch.syspath_prepend(tmp_path)
    modules = {"broken_at_heart": ["numpy"], "_hidden": ["numpy"]}
    (part,) = parts_of(["NumPy>=1"], modules)
    assert part.faults == ("NumPy cannot be imported: no library",)
    tools = parts_of(["numpy; extra == 'dev'"], modules)[1]
    assert tools.works  # tools are not tried


def test_doctor_tells_parts_and_versions(installed, capsys):
    assert main(["doctor"]) == 0
    said = capsys.readouterr().out
    assert said.startswith("topomap 7.8, Python 3.")
    assert "\ncore: works\n" in said
    assert "space: does not work: warp-drive is missing (pip install" in said
    assert "'topomap-robots[space]')" in said
    assert "  warp-drive             -               needs 9\n" in said


def test_doctor_tells_the_same_as_json(installed, capsys):
    assert main(["doctor", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["topomap"] == "7.8"
    assert found["python"] == ".".join(map(str, sys.version_info[:3]))
    assert found["parts"]["core"]["works"]
    assert found["parts"]["space"] == {
        "works": False,
        "needs": {"warp-drive": {"least": "9", "found": None, "fault": "is missing"}},
    }


def test_doctor_fails_when_the_core_does_not_work(installed, capsys):
    installed.append("hyper-space>=1")
    assert main(["doctor"]) == 3
    said = capsys.readouterr()
    assert said.err == ("topomap: the core does not work: hyper-space is missing\n")
    assert "core: does not work: hyper-space is missing" in said.out


def test_what_was_never_installed_says_so(uninstalled, capsys):
    assert installed_version() == "unknown"
    with pytest.raises(JobError, match="topomap was not installed"):
        check_parts()
    assert main(["doctor"]) == 3
    assert main(["--version"]) == 0
    assert "topomap unknown" in capsys.readouterr().out


def program(arguments, **environment):
    """Run the program as a shell does."""
    call = [sys.executable, "-c", "from topomap.cli import run; run()", *arguments]
    kept = {k: v for k, v in os.environ.items() if not k.startswith("_TOPOMAP")}
    done = subprocess.run(
        call, env=kept | environment, capture_output=True, text=True, check=False
    )
    return done.returncode, done.stdout, done.stderr


@pytest.mark.parametrize(
    ("words", "found"),
    [("topomap con", {"convert"}), ("topomap convert --re", {"--resolution"})],
)
def test_bash_completes_commands_and_options(words, found):
    code, out, err = program(
        [],
        _TOPOMAP_COMPLETE="complete_bash",
        COMP_WORDS=words,
        COMP_CWORD=str(len(words.split()) - 1),
    )
    assert (code, err) == (0, "")
    assert set(out.split()) == found


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_is_shown_for_each_shell(shell):
    code, out, err = program(
        ["--show-completion", shell],
        _TYPER_COMPLETE_TEST_DISABLE_SHELL_DETECTION="1",
    )
    assert (code, err) == (0, "")
    assert f"_TOPOMAP_COMPLETE=complete_{shell}" in out
