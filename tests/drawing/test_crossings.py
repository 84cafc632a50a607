"""Where wires meet: crossings, wires on each other, branches, and the piece that a net does not need."""

from acausal.drawing.crossings import branches, crossings, shared, without_stub

ACROSS = [((0.0, 5.0), (10.0, 5.0))]
DOWN = [((5.0, 0.0), (5.0, 10.0))]


def test_wires_of_different_nets_cross() -> None:
    assert crossings([ACROSS, DOWN]) == [(5.0, 5.0)]
    assert crossings([[*ACROSS, *DOWN]]) == []
    assert crossings([ACROSS, [((5.0, 5.0), (5.0, 10.0))]]) == [], "touching is not crossing"


def test_wires_on_one_line_are_shared_if_they_look_like_one() -> None:
    assert shared([ACROSS, [((8.0, 5.0), (20.0, 5.0))]]) == 1
    assert shared([ACROSS, [((12.0, 5.0), (20.0, 5.0))]]) == 1
    assert shared([ACROSS, [((30.0, 5.0), (40.0, 5.0))]]) == 0
    assert shared([ACROSS, [((0.0, 9.0), (10.0, 9.0))]]) == 0


def test_dots_are_where_lines_part() -> None:
    left = ((0.0, 0.0), (-10.0, 0.0))
    up = ((0.0, 0.0), (5.0, 0.0), (5.0, -10.0))
    right = ((0.0, 0.0), (10.0, 0.0))
    assert branches([left, up, right]) == [(5.0, 0.0)]
    assert branches([left, right]) == []


def test_a_common_first_piece_is_left_out() -> None:
    up = ((0.0, 0.0), (5.0, 0.0), (5.0, -10.0))
    right = ((0.0, 0.0), (10.0, 0.0))
    assert without_stub([up, right]) == [((5.0, 0.0), (5.0, -10.0)), ((5.0, 0.0), (10.0, 0.0))]
    left = ((0.0, 0.0), (-10.0, 0.0))
    assert without_stub([up, left]) == [up, left]
