"""Names in formulas are short, and no two of them look alike."""

import pytest

from acausal.reporting import Short, shorten


def written(*names: str) -> list[str]:
    return [short.text for short in shorten(names).values()]


def test_a_name_that_one_part_has_needs_no_subscript() -> None:
    assert written("mass.m", "spring.c") == ["m", "c"]


def test_the_nearest_part_that_tells_two_apart_becomes_a_subscript() -> None:
    assert written("body.m", "wheel.m") == ["m_body", "m_wheel"]
    assert written("left.axle.J", "right.axle.J") == ["J_left", "J_right"]


def test_several_parts_where_one_is_not_enough() -> None:
    names = [f"{a}.{b}.R" for a in ("one", "two") for b in ("r", "s")]
    assert written(*names) == ["R_one, r", "R_one, s", "R_two, r", "R_two, s"]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("damper.v_rel", "v_rel"),
        ("motor.phi", "φ"),
        ("pipe.T[2]", "T_2"),
        ("der(road.v_ref)", "v̇_ref"),
        ("law.net'2", "net'2"),
        ("a.flange_a.f", "f"),
        ("part._x", "x"),
        ("shell[1].Q", "Q"),
    ],
)
def test_how_a_single_name_looks(name: str, text: str) -> None:
    assert written(name) == [text]


def test_names_of_the_model_itself_stay_apart_from_those_of_its_parts() -> None:
    assert written("m", "body.m") == ["m", "m_body"]


def test_many_names_are_all_different() -> None:
    names = [f"cell[{i}].{v}" for i in range(30) for v in ("soc", "v_rc", "T", "der(T)")]
    assert len(set(written(*names))) == len(names)


@pytest.mark.parametrize(
    "name", ["shell[1].Q", "particle.diffusion[2].net'", "x[1][2]", "[", "a]b", "a_"]
)
def test_any_name_can_be_written(name: str) -> None:
    """Also one that nobody has shortened, with places in the middle of its path."""
    short = Short.of(name)
    assert short.text.replace("_", "") or not name
    assert short.latex or not name
