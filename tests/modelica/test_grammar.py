"""Modelica text becomes a syntax tree, or is refused with its place."""

import random
from pathlib import Path

import pytest

from acausal.modelica import ModelicaError, Source, parse, read_source
from acausal.modelica.syntax import (
    Branches,
    Choice,
    Comprehension,
    Connect,
    Declared,
    Do,
    EquationStatement,
    Extends,
    FunctionCall,
    Import,
    Loop,
)

TEXT = r"""
within A.B;
encapsulated package P "many forms" /* a comment */
  import Modelica.Constants.pi; import SI = Modelica.Units.SI; import A.B.{c, d}; import A.C.*;
  type Angle = Real(final quantity="Angle", unit="rad", min=-1e-3, max=.5E+2) "an angle";
  type Mode = enumeration(off "not on", on) annotation(Icon(graphics={Line(points={{0, 0}})}));
  connector Pin Real v; flow Real i; stream Real h; end Pin;
  expandable connector Bus end Bus;
  operator record Pair Real a; Real b = 2; end Pair;
  function f input Real x[:]; input Integer n = 1; output Real y; protected Real z[n, 2];
  algorithm
    y := 0; // the rest
    for i in 1:2:size(x, 1), j loop y := y + x[i]; if y > 3 then break; end if; end for;
    while y < 1 loop y := 2*y; end while;
    (y, , z) := g(x, n=n + 1); return;
  end f;
  function g = f(n=2);
  impure function h external "C" y = h_(x) annotation(Library="h"); end h;
  partial model M extends A(redeclare replaceable model R = B(k=1) constrainedby C, final b(start=1, fixed=true),
    each c.d=2
  );
    replaceable Pin p, q[3, size(x, 1)](each v(start=0)) if use and not x constrainedby Pin "why";
    inner outer parameter Integer n(final min=0) = 3 annotation(Dialog);
    discrete input Boolean on; 'odd name' quoted;
    redeclare model extends Base(n=1) end Base;
  public
    final constant Real t[:, 2] = [0, 1; 2, -3 .^ 2], u = if a then 1 elseif b then 2 else {i^2 for i in 1:3}*x[end, :];
  initial equation
    der(x) = 0;
  equation
    connect(p, q[1, 2].pin) annotation(Line());
    if initial() then x = 1; elseif time >= 2 then x = 3; else x = 4; end if;
    when {sample(0, 1), change(on)} then reinit(x, -pre(x)); elsewhen edge(on) then n = pre(n) + 1; end when;
    for i in 1:n loop x[i] = sum(k*i for k in 1:3) + f(function g(n=3), x); end for;
    assert(x > 0 or a <> b, "it \"is\" " + String(x)); .A.B.c = 3;
  algorithm
    when on then y := 1; end when;
  annotation(experiment(StopTime=1.5, Tolerance=1e-6), Documentation(info="<p>; end M;</p>"));
  end M;
end P;
"""


def test_every_form_of_the_language_is_read() -> None:
    within, (package,) = parse(Source("P.mo", TEXT))
    assert within == "A.B"
    assert [e.names for e in package.elements if isinstance(e, Import)][:3] == [
        {"pi": "Modelica.Constants.pi"},
        {"SI": "Modelica.Units.SI"},
        {"c": "A.B.c", "d": "A.B.d"},
    ]
    classes = {
        e.name: e for e in package.elements if not isinstance(e, Import | Declared | Extends)
    }
    assert classes["Mode"].literals == {"off": "off", "on": "on"}
    assert classes["h"].external == "h_"
    model = classes["M"]
    assert [type(s) for s in model.equations] == [
        Connect,
        Branches,
        Branches,
        Loop,
        Do,
        EquationStatement,
    ]
    declared = {e.name: e for e in model.elements if isinstance(e, Declared)}
    assert isinstance(declared["u"].modifier.value, Choice)
    assert declared["n"].prefixes.inner
    assert declared["n"].prefixes.outer
    assert declared["p"].constraint is not None
    assert declared["q"].condition is not None
    assert model.experiment["StopTime"].value == 1.5  # pyright: ignore[reportAttributeAccessIssue]
    assert package.source.text[model.at :].startswith("M extends")
    (loop,) = [s for s in model.equations if isinstance(s, Loop)]
    total = loop.body[0].right.operands[0]  # pyright: ignore[reportAttributeAccessIssue]
    assert isinstance(total, FunctionCall)
    assert isinstance(total.arguments[0], Comprehension)


WRONG = {
    "no end": ("model M Real x;", "'end M' expected, the end of the file found"),
    "another end": ("model M end N;", "'end M' expected, 'end N' found"),
    "no equation": ("model M equation x + 1; end M;", "'=' expected, ';' found"),
    "an assignment": ("model M equation x := 1; end M;", "'=' expected, ':=' found"),
    "a keyword": ("model M Real when; end M;", "a name expected, 'when' found"),
    "a character": ("model M Real x = 3 $ 4; end M;", "'$' is not allowed in Modelica"),
    "an open text": ('model M "open end M;', "this text has no end"),
    "an open comment": ("model M /* end M;", "this comment has no end"),
    "an open annotation": ("model M annotation(Icon(; end M;", "this annotation has no end"),
    "no class": ("", "a class expected, the end of the file found"),
    "a kind": ("final x", "a class such as 'model' or 'package' expected, 'x' found"),
    "depth": (f"model M Real x = {'(' * 99}1{')' * 99}; end M;", "nested more than 60 deep"),
    "infinity": ("model M Real x = 1e999; end M;", "not a finite number"),
    "an argument twice": ("model M Real x = f(a=1, a=2); end M;", "'a' is given twice"),
}


@pytest.mark.parametrize(("text", "words"), WRONG.values(), ids=WRONG)
def test_wrong_text_is_refused_with_its_place(text: str, words: str) -> None:
    with pytest.raises(ModelicaError) as caught:
        parse(Source("M.mo", text))
    sentence, line, mark = str(caught.value).split("\n")
    assert sentence.startswith("M.mo, line 1, column ")
    assert sentence.endswith(words)
    assert set(mark.strip()) == {"^"}
    assert len(mark) <= len(line) + 1


PIECES = ("(", ")", ";", "end", '"', "\\", "when", "1e", "", "'", "{", "\0")


def test_mutated_text_is_read_or_refused_in_one_sentence() -> None:
    draw = random.Random(1)
    for _ in range(200):
        text = list(TEXT)
        for _ in range(draw.randint(1, 4)):
            at = draw.randrange(len(text))
            text[at : at + draw.randint(0, 3)] = draw.choice(PIECES)
        try:
            parse(Source("P.mo", "".join(text)))
        except ModelicaError as error:
            assert str(error).startswith("P.mo, line ")  # noqa: PT017


def test_files_that_are_no_text_are_refused(tmp_path: Path) -> None:
    (tmp_path / "M.mo").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ModelicaError, match="not a text file in UTF-8"):
        read_source(tmp_path / "M.mo")
    with pytest.raises(ModelicaError, match="cannot be read"):
        read_source(tmp_path / "absent.mo")
