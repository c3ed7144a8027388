"""Tables of costs are read from CSV and JSON, or refused by row and column."""

import json

import numpy as np
import pytest
import typer
from hypothesis import HealthCheck, given, settings
from typer.testing import CliRunner

from tests.strategies import tables
from topomap.cli.allocate import allocate as command
from topomap.errors import InputError
from topomap.exploration import allocate, read_costs


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(table=tables())
def test_what_was_written_is_read(table, tmp_path):
    path = tmp_path / "costs.csv"
    path.write_text("\n".join(",".join(map(str, row)) for row in table))
    assert read_costs(path).tolist() == table
    for document in (table, {"costs": table}):
        path = tmp_path / "costs.json"
        path.write_text(json.dumps(document))
        assert read_costs(path).tolist() == table


@pytest.mark.parametrize(
    "text",
    [
        "1,,3\n4,5,inf\n",
        "# a note\n1;null;3\n\n4;5;INF\n",
        "\ufeff1\t\t3\n4\t5\tinfinity",
    ],
)
def test_marks_of_no_way_and_separators(text, tmp_path):
    path = tmp_path / "costs.txt"
    path.write_text(text, encoding="utf-8")
    np.testing.assert_array_equal(read_costs(path), [[1, np.inf, 3], [4, 5, np.inf]])


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.csv", "1,2\n3\n", "a.csv: row 1: expected 2 columns as in row 0; got 1"),
        ("a.csv", "1,x\n", "row 0, column 1: expected a number, or inf .* got 'x'"),
        ("a.csv", "1,-2\n", "row 0, column 1: expected a cost of at least 0"),
        ("a.csv", "nan,2\n", "row 0, column 0: expected a cost of at least 0"),
        ("a.csv", "", "expected at least one robot"),
        ("a.json", "[[1, 2", "expected valid JSON"),
        ("a.json", '{"cost": []}', "costs: expected the list of rows"),
        ("a.json", '{"costs": 1}', "costs: expected a list of rows; got 1"),
        ("a.json", "[[1, null], [2]]", "row 1: expected 2 columns"),
        ("a.json", "[[]]", "row 0: expected at least one frontier"),
    ],
)
def test_broken_tables_are_refused(name, text, message, tmp_path):
    path = tmp_path / name
    path.write_text(text)
    with pytest.raises(InputError, match=message):
        read_costs(path)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(InputError, match="expected a readable file"):
        read_costs(tmp_path / "none.csv")


def run(*arguments):
    """Run the command alone."""
    app = typer.Typer()
    app.command()(command)
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


def test_command_prints_one_object(tmp_path):
    path = tmp_path / "costs.csv"
    path.write_text("20,20,15,19\n25,15,10,16\n,,,\n")
    answer = run(path, "--allocator", "mpg", "--json")
    assert json.loads(answer.output) == {
        "assignment": [0, 2, None],
        "costs": [20, 10, None],
        "waits": [False, False, False],
    }
    assert answer.exit_code == 0


def test_command_says_who_goes_where(tmp_path):
    path = tmp_path / "costs.csv"
    path.write_text("1,3\n2,4\n,\n")
    text = run(path, "--allocator", "mindist").output
    assert text.splitlines() == [
        "robot 0 goes to frontier 0, cost 1",
        "robot 1 goes to frontier 0, cost 2, after a wait",
        "robot 2 stays: no frontier can be reached",
    ]
    fast = run(path, "--speeds", "1,10,1", "--exchange", "--json")
    assert json.loads(fast.output)["assignment"][1] is not None
    assert fast.exit_code == 0


def test_command_names_a_speed_that_is_none(tmp_path):
    path = tmp_path / "costs.csv"
    path.write_text("1\n")
    answer = run(path, "--speeds", "x")
    assert isinstance(answer.exception, InputError)
    assert str(answer.exception) == "--speeds: robot 0: expected a number; got 'x'"


def test_command_answers_as_the_library(tmp_path):
    rng = np.random.default_rng(5)
    costs = rng.random((4, 6))
    path = tmp_path / "costs.json"
    path.write_text(json.dumps(costs.tolist()))
    for name in ("minpos", "greedy", "minmax"):
        found = json.loads(run(path, "--allocator", name, "--json").output)
        assert tuple(found["assignment"]) == allocate(costs, name).assignment
