"""Foreign YAML: what PyYAML reads is read the same, what is a trap is refused."""

import tracemalloc

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from worlds.importing.yaml_text import YamlFaultError, read_yaml

words = st.text("ab1.:- #'\"\n{}[]&*!yesnoNE_~0x+", max_size=6)
values = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats(allow_nan=False)
    | st.dates()
    | words,
    lambda inner: (
        st.lists(inner, max_size=4) | st.dictionaries(words, inner, max_size=4)
    ),
    max_leaves=20,
)


@settings(deadline=None)
@given(value=values, style=st.sampled_from([None, True, False]))
def test_what_pyyaml_writes_is_read_as_it_was(value, style):
    text = yaml.safe_dump([value, value], default_flow_style=style)
    assert read_yaml(text, 1000) == [value, value]


@settings(deadline=None)
@given(text=st.text("ab1.:- #'\"\n{}[]&*!,?|>%@yesno~0x+\t", max_size=40))
def test_any_text_is_read_as_by_pyyaml_or_refused(text):
    try:
        found = read_yaml(text, 1000)
    except YamlFaultError as error:
        assert "\n" not in str(error)  # noqa: PT017 - either will do
        return
    rival = yaml.load(text, Loader=yaml.CSafeLoader)
    assert repr(found) == repr(rival)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a: [1, 2", "line 2: did not find expected ',' or ']'"),
        ("a: 1\n b: 2", "line 2: mapping values are not allowed in this context"),
        ("a: 1\n--- \nb: 2", "line 2: a second document"),
        ("a: !!python/object:os.system {}", "line 1: a tag, tag:yaml.org,2002:python"),
        ("a: !!str 1", "line 1: a tag, tag:yaml.org,2002:str"),
        ("a: &x {b: 1}\nc: {<<: *x}", "line 2: a merge key"),
        ("a: &x [*x]", "line 1: an alias of no part before it, x"),
        ("a: *x", "line 1: "),
        ("? [1]\n: 2", "line 1: a key that is no scalar"),
        ("[" * 200, "line 1: more than 100 levels"),
        ("a: 2001-99-99", "line 1: '2001-99-99' is no value"),
        ("a: \x00", "control characters are not allowed"),
    ],
)
def test_what_is_not_taken_says_where(text, message):
    with pytest.raises(YamlFaultError) as raised:
        read_yaml(text, 1000)
    assert message in str(raised.value)


def test_as_many_values_as_may_be_are_read():
    assert read_yaml("[&a 1, *a, 2]", 4) == [1, 1, 2]
    for text in "[1, 2, 3, 4]", "[&a [1], *a]":
        with pytest.raises(YamlFaultError, match="line 1: more than 4 values"):
            read_yaml(text, 4)


def test_a_bomb_is_refused_with_little_memory():
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{k}: &a{k} [{', '.join([f'*a{k - 1}'] * 10)}]" for k in range(1, 12)]
    tracemalloc.start()
    with pytest.raises(YamlFaultError, match="line 6: more than 1000000 values"):
        read_yaml("\n".join(lines), 1_000_000)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 5_000_000
