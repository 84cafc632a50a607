"""Modelica text that is wrong, or not supported: one sentence with the place, and nothing is dropped."""

import warnings
from pathlib import Path

import pytest

import acausal as ac

M = "Modelica.Mechanics.Translational.Components."

WRONG = {
    # names
    f"model M {M}Mas m; end M;": "there is no class .*Mas'; did you mean .*Mass'",
    "model M Foo f; end M;": "no class 'Foo'; give the folder that has it by path",
    "model M Real x; equation der(x)=y; end M;": "there is no 'y'; known are 'x'",
    "model M Real x=foo(time); end M;": "no function 'foo'",
    "package P constant Real c=3; end P; model M Real x=P.d; end M;": "'P' has no 'd'",
    "model M type E=enumeration(a,b); parameter E e=E.c; end M;": "'E' has no 'c'",
    "model M Real x=1; Real x=2; end M;": "'x' is declared twice",
    "model M Real time; end M;": "'time' is the time",
    "model M extends M; end M;": "'M' extends itself",
    "model M M m; end M;": "does 'M' contain itself",
    "model A end A; model C replaceable model K = A; K k; end C; model M extends C(redeclare model K = K); end M;":
    "'K' extends itself",
    f"model M {M}Mass m[3]; Real x[m]; end M;": "a size is a whole number, not ",
    "function f input Real x; output Real y=x; end f; model M f g; end M;": "a function, not a model",
    # modifiers
    f"model M {M}Mass m(mm=1); end M;": "Mass 'm' has no 'mm'; did you mean 'm'",
    "model A parameter Real k=1; end A; model M A a(q=2); end M;": "A has no 'q'",
    "model A final parameter Real k=1; end A; model M A a(k=2); end M;": "'k' is final",
    "model A parameter Real k=1; end A; model B A a(final k=3); end B; model M B b(a(k=2)); end M;": "'k' is final",
    "model A protected parameter Real p=1; end A; model M A a(p=2); end M;": "'p' is protected",
    "model A parameter Real k=1; end A; model M A a(k=1, k=2); end M;": "'k' is modified twice",
    f"model A {M}Spring s(c=1); end A; model M extends A(redeclare {M}Damper s(d=1)); end M;": "not replaceable",
    "partial model A Real x; end A; model M A a; end M;": "'A' is partial",
    "model A Real x=1; end A; model M A a=3; end M;": "'a' is a part, which has no value",
    "model M Real x(begin=3)=1; end M;": "a Real has no 'begin'",
    f"model M {M}Mass m[2](m={{1,2,3}}); end M;": "2 elements are needed here, not 3",
    # types, sizes, values
    "model M Boolean b=true; Real x=b+1; end M;": "a Boolean is not a number",
    "model M parameter Boolean b=3; end M;": "3 is neither true nor false",
    "model M parameter Integer n=1.5; end M;": "'n' is a whole number, not 1.5",
    "model M parameter Integer n; Real x[n]; end M;": "'n' has no value",
    "model M parameter Real a=0; parameter Integer n=integer(1/a); Real x[n]; end M;": "no finite real number",
    "model M parameter Real a=b; parameter Real b=a; end M;": "a -> b -> a: each depends on the next",
    "model M parameter Real m(min=0)=-1; end M;": "out of range: at least 0",
    "model M parameter Real k=1; equation assert(k>2,\"k is small\"); end M;": "violated: k is small",
    "model M parameter Real k=-1; parameter Boolean b=false;"
    'equation assert(k>0 or b, "k is " + String(k) + ", " + String(b)); end M;': "violated: k is -1, false",
    "function f input Real a; output Real y; algorithm y:=a; for i in 1:25 loop y:=0.5*(y+a/y); end for; end f;"
    "model M Real x=f(1+time); end M;": "'y' becomes an expression of more than 100000 parts; make fewer steps",
    'function f input Real x; algorithm assert(x<2, "x is large"); end f;'
    "model M parameter Real k=3; equation f(k); end M;": "violated: x is large",
    "function f input Real x; algorithm end f; model M Real x=f(time); end M;": "f has no result",
    "model M Real x[3]={1,2}; end M;": r"sizes \[3\] and \[2\]",
    "model M parameter Real x[3]={1,2}; end M;": r"size \[3\], its value has \[2\]",
    "model M Real x[3]; equation x[4]=1; end M;": "subscript 4 is outside of 1 to 3",
    "model M Real x; equation x={1,2}*{1,2,3}; end M;": "cannot be multiplied",
    "model M Real x; equation x=\"a\"; end M;": "an equation of texts",
    "model M Real x=sin(time,2); end M;": "sin does not take these arguments",
    # equations and algorithms
    "model M Real x; equation if time>1 then x=1; x=2; else x=3; end if; end M;": "have 2 and 1 equations",
    "model M Real x; equation der(x)=1; reinit(x,2); end M;": "within 'when' only",
    "model M Real x; equation x=1; for i in 1:integer(time) loop end for; end M;": "changes with time",
    "model M Real x; algorithm if time>1 then x:=1; end if; end M;": "does not assign 'x' in every case",
    "function f input Real x; output Real y=f(x); end f; model M Real x=f(time); end M;": "more than 30 deep",
    "function f input Real x; output Real y=x; algorithm while true loop y:=y+1; end while; end f;"
    "model M Real x=f(time); end M;": "does the loop end",
    "function f input Real x; output Real y=x; algorithm while y<5 loop y:=y+1; end while; end f;"
    "model M Real x=f(time); end M;": "a loop whose end changes with time",
    f"model M {M}Fixed f; Modelica.Electrical.Analog.Basic.Ground g; equation connect(f.flange,g.p); end M;":
    "unlike connectors",
    "connector C Real p; Real q; flow Real f; end C; model M C c; end M;": "not 1 and 2",
    # not supported
    "model M Real x=delay(time,1); end M;": "delay.* is not supported; use the block",
    "connector C Real p; flow Real f; end C; model M C c; parameter Integer n=cardinality(c); end M;":
    "stands in equations only",
    "model M outer Real x; end M;": "no 'inner Real x' around this; declare it in the model",
    "connector C parameter Integer n=1; Real p[n]; flow Real f; stream Real h; end C; model M C c; end M;":
    "a stream variable",
    "connector C Boolean b; Real p; flow Real f; end C; model M C c; end M;":
    "a Boolean in a connector is an input or output",
    "connector C Real p; flow Real f; end C; connector A C x; end A; connector B C x; C y; end B;"
    "model M A a; B b; equation connect(a,b); end M;": "unlike connectors: only one has 'y'",
    "model M outer function f input Real x; output Real y; end f; Real x=f(time); end M;": "'f' is an outer class",
    "model M Clock c; end M;": "Clock is not supported; write 'when sample",
    "model M ExternalObject e; end M;": "ExternalObject is not supported",
    "model M Real x; equation when Clock(0.1) then x=previous(x); end when; end M;": "not supported; write 'when",
    "model M Modelica.Mechanics.MultiBody.Interfaces.Frame_a f; equation Connections.root(f.R); end M;":
    "takes records of connectors; spatial mechanics",
    "model M Modelica.Clocked.RealSignals.Sampler.Sample s; end M;": "clocks are not supported; use the blocks",
    "model M Modelica.Mechanics.MultiBody.Joints.Revolute r; end M;": "Joints.Revolute: spatial mechanics is not",
    "model M import Modelica.Mechanics.MultiBody.*; Joints.Revolute r; end M;": "spatial mechanics is",
    "model M Modelica.Blocks.Nonlinear.FixedDelay d(delayTime=1); end M;": "past of a signal.*; PadeDelay is",
    "model M Modelica.Blocks.Math.Gain a[2,3](each k=1); Modelica.Blocks.Math.Gain b[3,2](each k=1);"
    "equation connect(a.y, b.u); end M;": "differ in length",
    "connector C Real p; flow Real f; stream Real h; end C; model M C c; end M;": "a stream variable",
    "expandable connector B end B; block G input Real u[2]; end G; model M B b; G g; G h;"
    "equation connect(b.x, g.u); connect(b.x[1], h.u[1]); end M;": "'b.x' is connected as a whole, too",
    f"expandable connector B end B; model M B b; {M}Mass m[2]; equation connect(b.x, m.flange_a); end M;":
    "'b.x' of an expandable connector has to be a signal or a connector",
    "expandable connector B end B; model M B b; Real y = b.x; end M;": "'b' has no 'x'",
    "record R Real x; end R; model M R a; R b; equation a=b+b; b.x=1; end M;": "'R' has no operator '\\+' for 2",
    "model M Real x; equation der(x)=1; Connections.root(x); end M;": "Connections.root takes records of connectors",
    'function f input Real x; output Real y; external "C" y=foo(x); end f; model M Real x=f(time); end M;':
    "written in another language",
}  # fmt: skip


@pytest.mark.parametrize("text", WRONG, ids=range(len(WRONG)))
def test_wrong_text_is_refused_with_its_place(tmp_path: Path, text: str) -> None:
    file = tmp_path / "wrong.mo"
    file.write_text(text)
    with pytest.raises(
        ac.ModelicaError, match=rf"(?s)^wrong\.mo, line 1, column \d+: .*{WRONG[text]}"
    ):
        ac.load(file, "M")


def test_an_assertion_that_nothing_watches_is_named(tmp_path: Path) -> None:
    file = tmp_path / "asserts.mo"
    file.write_text(
        'model M Real x=time; equation when x>1 then assert(x<5, "too large"); end when; end M;'
    )
    with pytest.warns(
        UserWarning, match=r"asserts\.mo, line 1, column \d+: this assertion is not watched"
    ):
        ac.load(file)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for text in ("parameter Real k=3; equation assert(k<5", "Real x=time; equation assert(x<5"):
            file.write_text(f'model M {text}, "too large"); end M;')
            ac.load(file)


def test_an_end_that_the_text_states_is_named(tmp_path: Path) -> None:
    file = tmp_path / "ends.mo"
    file.write_text(
        'model M Real x=time; equation when x>1 then terminate("late"); end when; end M;'
    )
    with pytest.warns(UserWarning, match=r"line 1, column 45: this does not end the simulation"):
        ac.load(file)


def test_a_model_that_is_too_large_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "large.mo"
    file.write_text("model M parameter Integer n=1000000; Real x[n]; end M;")
    with pytest.raises(ac.ModelError, match="budget"):
        ac.load(file)
