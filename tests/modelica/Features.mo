package Features "What libraries use: connectors within connectors, inner and outer, enumerations, records in functions"
  connector Pin
    Real v;
    flow Real i;
  end Pin;

  connector Plug
    parameter Integer m = 3;
    Pin pin[m];
    input Real gain;
  end Plug;

  connector Socket
    parameter Integer m = 3;
    Pin pin[m];
    output Real gain;
  end Socket;

  connector Bundle "An array of connectors that consist of others, and a vector"
    parameter Integer m = 2;
    Real T[m];
    flow Real Q[m];
    Pin pin;
  end Bundle;

  model Capacitors
    parameter Integer m = 3;
    Plug plug(final m = m);
    Real v[m](start = {1, 2}, each fixed = true);
  equation
    for k in 1:m loop
      der(v[k]) = plug.gain*plug.pin[k].i;
      plug.pin[k].v = v[k];
    end for;
  end Capacitors;

  model Resistors "to ground"
    parameter Integer m = 3;
    parameter Real R[m] = fill(1, m);
    Socket socket(final m = m);
    Integer n = cardinality(socket.pin[1]) + cardinality(socket);
  equation
    socket.gain = 2 + time;
    socket.pin.v = R .* socket.pin.i;
  end Resistors;

  model Wrapped "The plug of the whole is connected to that of a part"
    Plug plug(m = 2);
    Capacitors c(m = 2);
  equation
    connect(plug, c.plug);
  end Wrapped;

  model Store
    Bundle b;
    parameter Real C = 1;
    Real T[2](start = {1, 2}, each fixed = true);
  equation
    C*der(T) = b.Q;
    b.T = T;
    b.pin.v = 0;
  end Store;

  model Loss
    Bundle b;
  equation
    b.Q = {b.T[1], 2*b.T[2]};
    b.pin.i = 0;
  end Loss;

  model Bundled
    Loss loss[2];
    Store store(C = 2);
  equation
    connect(loss[1].b, loss[2].b);
    connect(loss[2].b, store.b);
  end Bundled;

  model World
    parameter Real g = 9;
    Real wind = 3*time;
    Boolean on = time > 0.5;
  end World;

  model Tank
    Pin p;
    Real x(start = 5, fixed = true);
  equation
    der(x) = p.i;
    p.v = x;
  end Tank;

  model Body
    outer World world;
    outer Tank tank;
    Pin own;
    Real y(start = 0, fixed = true);
  equation
    der(y) = world.g + (if world.on then 0 else world.wind);
    own.i = -y;
    connect(own, tank.p);
  end Body;

  model Deep
    Body body;
  end Deep;

  model Surrounded
    inner World world(g = 2);
    inner Tank tank;
    Body a;
    Deep d;
  end Surrounded;

  type Level = enumeration('0', X, '1');

  function first "The index of the first element above a limit, or zero"
    input Real u[:];
    input Real limit;
    output Integer index = 0;
  algorithm
    for i in 1:size(u, 1) loop
      if u[i] > limit then
        index := i;
        break;
      end if;
    end for;
  end first;

  function clipped
    input Real u;
    output Real y;
  algorithm
    y := u;
    for i in 1:2 loop
      if u > 10 then
        y := 10;
        return;
      end if;
    end for;
    y := 2*y;
  end clipped;

  model Choices
    import L = Features.Level;
    parameter Real table[L] = {10, 20, 30};
    constant Level upper[:] = L.X:L.'1';
    Level level = if time < 1 then L.'0' elseif time < 2 then L.X else L.'1';
    Real x = table[level];
    Integer n = Integer(level);
    Real found = first({time, 2*time, 3*time}, 3);
    Real y = clipped(4*time);
    Boolean any = max({time > 2, time > 1}), all = min({time > 2, time > 1});
    Real top = table[upper[2]];
    Watch watch(level = level);
    parameter String group = "Dy5";
    final parameter Real turns = if part(group, 1, 1) == "D" then 3 else 1;
  end Choices;

  block Watch
    input Level level;
    output Boolean middle = level == Level.X;
    output Boolean outside = level <> Level.X;
  end Watch;

  function part "A function of texts that is written in C"
    input String text;
    input Integer first, last;
    output String result;

    external "C" result = ModelicaStrings_substring(text, first, last);
  end part;

  record Data
    parameter Real a = 2;
    parameter Real b = 3*a;
    parameter Real c = 1;
    Real extra(start = 4);
    final parameter Integer whole = if extra > 3 then 1 else 0;
  end Data;

  function doubled
    input Data d;
    output Data e;
  algorithm
    e := d;
    e.a := 2*d.a;
    if d.a > 1 then
      e.c := 7;
    end if;
  end doubled;

  model Decay
    parameter Data d;
    parameter Data e = doubled(d);
    Real x(start = 1, fixed = true);
  equation
    der(x) = -(e.a + d.b + e.c + d.whole)*x;
  end Decay;

  model Named "Modifiers name members of the part that they modify, and of parts that name others"
    Decay p(d(a = p.d.c*2, c = 0.5));
    Decay q(d(a = r.k));
    Scale r(k = 4, k2 = q.d.a);
  end Named;

  model Scale
    parameter Real k = 1, k2 = 2;
  end Scale;

  model Plugged
    Wrapped w;
    Resistors r(m = 2, R = {1, 2});
  equation
    connect(w.plug, r.socket);
  end Plugged;

  model All
    Plugged plugged;
    Bundled bundled;
    Named named;
  end All;

  block Passing "Signals that are passed on by connections"
    Modelica.Blocks.Interfaces.BooleanOutput on;
    Modelica.Blocks.Sources.BooleanStep step(startTime = 1);
    Modelica.Blocks.Sources.Constant constant3(k = 3);
    Real twice = 2*local;
  protected
    Modelica.Blocks.Interfaces.RealInput local;
  equation
    connect(step.y, on);
    connect(local, constant3.y);
  end Passing;

  model Tabled "Elements of a parameter decide a table; a unit of reactive power"
    parameter Real x[:] = {0, 1, 2}, y[3] = 2*x;
    Modelica.Blocks.Tables.CombiTable1Ds table(table = {{x[i], y[i]} for i in 1:3});
    Real Q(unit = "var");
  equation
    Q = 3;
    table.u = 1.5;
  end Tabled;

  model Running
    Passing passing;
    Surrounded surrounded;
    Choices choices;
  end Running;
end Features;
