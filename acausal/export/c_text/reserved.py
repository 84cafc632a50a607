"""Names that a model's type cannot have in C, as the language or its file use them."""

_KEYWORDS = """auto break case char const continue default do double else enum extern float for goto if inline int long
register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while main"""

_MATH = """acos asin atan atan2 ceil cos cosh exp expm1 fabs floor fmax fmin fmod hypot isfinite isinf isnan log log1p
nearbyint pow remainder round signbit sin sinh sqrt tan tanh tgamma lgamma erf erfc cbrt trunc real"""

_OWN = """all_finite attempt came_true condition_rates conditions copy end_with_event equal excess factor fill_d fill_p
fill_x find_due find_edge fire force iterate jacobian_column jumped look look_at_points lu_factor lu_solve maximum
minimum next_length outputs rates recalibrate resets same signum solve_stage strict switched tangent ticks timed updated
x u y p d t m h Model Status"""

RESERVED = frozenset(f"{_KEYWORDS} {_MATH} {_OWN}".split())
"""Words of C, of its mathematics, and of the functions in a model's file."""
