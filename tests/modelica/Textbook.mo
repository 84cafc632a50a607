package Textbook "Models of textbooks, each with a known solution"
  import Modelica.Units.SI;
  import Modelica.Constants.pi;

  connector Pin
    SI.Voltage v;
    flow SI.Current i;
  end Pin;

  partial model OnePort
    Pin p, n;
    SI.Voltage v = p.v - n.v;
    SI.Current i = p.i;
  equation
    p.i + n.i = 0;
  end OnePort;

  model Resistor
    extends OnePort;
    parameter SI.Resistance R(min = 0) = 1;
  equation
    v = R*i;
  end Resistor;

  model Capacitor
    extends OnePort(v(start = 0, fixed = true));
    parameter SI.Capacitance C = 1;
  equation
    C*der(v) = i;
  end Capacitor;

  model Source
    extends OnePort;
    parameter SI.Voltage V = 1;
  equation
    v = V;
  end Source;

  model Ground
    Pin p;
  equation
    p.v = 0;
  end Ground;

  model RC
    parameter SI.Resistance R = 2;
    Resistor r(R = R);
    Capacitor c(C = 0.5);
    Source s(V = 10);
    Ground g;
  equation
    connect(s.p, r.p);
    connect(r.n, c.p);
    connect(c.n, s.n);
    connect(s.n, g.p);
    annotation (experiment(StopTime = 3));
  end RC;

  model Chua
    Modelica.Electrical.Analog.Basic.Inductor L(L = 18, i(start = 0, fixed = true));
    Modelica.Electrical.Analog.Basic.Ground G;
    Modelica.Electrical.Analog.Basic.Resistor Ro(R = 12.5e-3);
    Modelica.Electrical.Analog.Basic.Conductor Gc(G = 0.565);
    Modelica.Electrical.Analog.Basic.Capacitor C1(C = 10, v(start = 4, fixed = true));
    Modelica.Electrical.Analog.Basic.Capacitor C2(C = 100, v(start = 0, fixed = true));
    NonlinearResistor Nr(Ga = -0.757576, Gb = -0.409091, Ve = 1);
  equation
    connect(L.n, Ro.p);
    connect(C2.p, Gc.p);
    connect(L.p, Gc.p);
    connect(G.p, Nr.n);
    connect(Nr.p, C1.p);
    connect(Gc.n, C1.p);
    connect(C1.n, G.p);
    connect(C2.n, G.p);
    connect(Ro.n, G.p);
  end Chua;

  model NonlinearResistor
    extends Modelica.Electrical.Analog.Interfaces.OnePort;
    parameter SI.Conductance Ga, Gb;
    parameter SI.Voltage Ve;
  equation
    i = if v < -Ve then Gb*(v + Ve) - Ga*Ve else if v > Ve then Gb*(v - Ve) + Ga*Ve else Ga*v;
  end NonlinearResistor;

  model Pendulum
    parameter Real m = 1, L = 1, g = 9.81;
    Real x(start = 0.6, fixed = true), y(start = -0.8), vx(start = 0, fixed = true), vy, F;
  equation
    der(x) = vx;
    der(y) = vy;
    m*der(vx) = -x/L*F;
    m*der(vy) = -y/L*F - m*g;
    x^2 + y^2 = L^2;
  end Pendulum;

  model Tank
    parameter SI.Area A = 2;
    parameter Real k = 0.5;
    input Real q;
    output SI.Length level(start = 1, fixed = true);
  equation
    A*der(level) = q - k*sqrt(level);
  end Tank;

  model ControlledTank
    Tank tank(A = 1.5);
    Modelica.Blocks.Continuous.PI pi(k = 2, T = 4, initType = Modelica.Blocks.Types.Init.InitialState);
    Modelica.Blocks.Sources.Constant setpoint(k = 2);
    Modelica.Blocks.Math.Feedback feedback;
  equation
    connect(setpoint.y, feedback.u1);
    connect(tank.level, feedback.u2);
    connect(feedback.y, pi.u);
    connect(pi.y, tank.q);
  end ControlledTank;

  model Thermostat
    Real T(start = 15, fixed = true);
    Boolean on(start = true, fixed = true);
    discrete Integer switches(start = 0, fixed = true);
    parameter Real low = 18, high = 22;
  equation
    der(T) = (10 - T)/5 + (if on then 5 else 0);
    on = if pre(on) then T < high else T < low;
    when change(on) then
      switches = pre(switches) + 1;
    end when;
  end Thermostat;

  model Rod
    parameter Integer n = 5;
    parameter Real a = 1.0;
    Real T[n](start = fill(1, n), each fixed = true);
  protected
    parameter Real dx = 1/n;
  equation
    der(T[1]) = a*(T[2] - T[1])/dx^2;
    for i in 2:n - 1 loop
      der(T[i]) = a*(T[i + 1] - 2*T[i] + T[i - 1])/dx^2;
    end for;
    der(T[n]) = a*(0 - 2*T[n] + T[n - 1])/dx^2;
  end Rod;

  model Slices
    parameter Integer n = 4;
    parameter Real A[2, 2] = [0, 1; -4, -0.4];
    Real x[2](start = {1, 0}, each fixed = true);
    Real y[n] = {sum(x[j]^i for j in 1:2) for i in 1:n};
    Real z = y[2:end]*y[1:end - 1];
  equation
    der(x) = A*x;
  end Slices;

  model Chain
    parameter Integer n = 3;
    replaceable model Link = Modelica.Mechanics.Translational.Components.SpringDamper(c = 10, d = 1) constrainedby Modelica.Mechanics.Translational.Interfaces.PartialCompliant;
    Modelica.Mechanics.Translational.Components.Mass mass[n](each m = 1, s(start = {1, 2, 3}*0.1, each fixed = true), v(each fixed = true));
    Link link[n];
    Modelica.Mechanics.Translational.Components.Fixed fixed;
  equation
    connect(fixed.flange, link[1].flange_a);
    for i in 1:n loop
      connect(link[i].flange_b, mass[i].flange_a);
      if i < n then
        connect(mass[i].flange_b, link[i + 1].flange_a);
      end if;
    end for;
  end Chain;

  model Chain2
    extends Chain(n = 2, redeclare model Link = Modelica.Mechanics.Translational.Components.Spring(c = 20), mass(s(start = {1, 2})));
  end Chain2;

  function cubic
    input Real x;
    input Real c[:] = {1, 2};
    output Real y = 0;
  algorithm
    for i in 1:size(c, 1) loop
      y := y + c[i]*x^i;
    end for;
    if x < -1 then
      y := -y;
    end if;
  end cubic;

  model Functions
    Real x(start = 1, fixed = true);
    Real u = cubic(x);
    Real w = cubic(x, {1, 0, 3});
  equation
    der(x) = -u;
  end Functions;

  model Sampled
    parameter Real Ts = 0.1, k = 2;
    Real x(start = 1, fixed = true);
    discrete Real u(start = 0, fixed = true);
  equation
    der(x) = u;
    when sample(0, Ts) then
      u = -k*x;
    end when;
  end Sampled;

  model Algorithmic
    Real x(start = 1, fixed = true);
    Real a, b;
    Integer n(start = 0, fixed = true);
  equation
    der(x) = b;
  algorithm
    a := 2*x;
    if a > 1 then
      b := -a;
    else
      b := -1;
    end if;
    when x < 0.25 then
      n := n + 1;
    end when;
  end Algorithmic;

  record Data
    parameter Real k = 1;
    parameter Real d = 2;
  end Data;

  model Records
    parameter Data data(k = 3);
    Part part(data = data);
    Real y = part.x;
  end Records;

  model Part
    parameter Data data;
    Real x(start = 1, fixed = true);
  equation
    der(x) = -data.k*data.d*x;
  end Part;

  type Mode = enumeration(slow, fast);

  model Conditional
    parameter Boolean damped = false;
    parameter Mode mode = Mode.fast;
    Modelica.Mechanics.Rotational.Components.Inertia J(J = 1, phi(start = 1, fixed = true), w(fixed = true));
    Modelica.Mechanics.Rotational.Components.Spring spring(c = if mode == Mode.fast then 100 else 1);
    Modelica.Mechanics.Rotational.Components.Damper damper(d = 1) if damped;
    Modelica.Mechanics.Rotational.Components.Fixed fixed;
  equation
    connect(fixed.flange, spring.flange_a);
    connect(spring.flange_b, J.flange_a);
    connect(fixed.flange, damper.flange_a);
    connect(damper.flange_b, J.flange_a);
  end Conditional;

  model SteadyStart
    Real x;
    parameter Real p(fixed = false, start = 1);
    Real y;
  initial equation
    der(x) = 0;
    y = 3;
  equation
    der(x) = -x + p*(1 + time);
    y = 2*x + p;
  end SteadyStart;

  model Motor
    Modelica.Electrical.Analog.Sources.ConstantVoltage source(V = 12);
    Modelica.Electrical.Analog.Basic.Resistor R(R = 0.5);
    Modelica.Electrical.Analog.Basic.Inductor L(L = 0.01, i(fixed = true));
    Modelica.Electrical.Analog.Basic.RotationalEMF emf(k = 0.1);
    Modelica.Electrical.Analog.Basic.Ground ground;
    Modelica.Mechanics.Rotational.Components.Inertia load(J = 0.02, phi(fixed = true), w(fixed = true));
    Modelica.Mechanics.Rotational.Components.Damper friction(d = 0.001);
    Modelica.Mechanics.Rotational.Components.Fixed fixed;
  equation
    connect(source.p, R.p);
    connect(R.n, L.p);
    connect(L.n, emf.p);
    connect(emf.n, source.n);
    connect(source.n, ground.p);
    connect(emf.flange, load.flange_a);
    connect(load.flange_b, friction.flange_a);
    connect(friction.flange_b, fixed.flange);
  end Motor;

  model BouncingBall
    parameter Real e = 0.7;
    parameter Real g = 9.81;
    Real h(start = 1, fixed = true);
    Real v(start = 0, fixed = true);
  equation
    der(h) = v;
    der(v) = -g;
    when h <= 0 and v < 0 then
      reinit(v, -e*pre(v));
    end when;
  end BouncingBall;

  model Buffered "a queue of samples: arrays in when, loops, if within when"
    parameter Integer n = 3;
    discrete Real buffer[n](each start = 0, each fixed = true);
    Integer count(start = 0, fixed = true);
    Boolean full(start = false, fixed = true);
  equation
    when sample(0.05, 0.1) then
      buffer[1] = time;
      for i in 2:n loop
        buffer[i] = pre(buffer[i - 1]);
      end for;
      if pre(count) < n then
        count = pre(count) + 1;
      else
        count = n;
      end if;
      full = count >= n;
    end when;
  end Buffered;

  model Hysteresis "elsewhen, edge and initial"
    Real x = sin(6*time);
    discrete Real y(start = 0);
    Boolean high = x > 0.5;
    Integer edges(start = 0, fixed = true);
  equation
    when initial() then
      y = 5;
    elsewhen x > 0.5 then
      y = 1;
    elsewhen x < -0.5 then
      y = -1;
    end when;
    when edge(high) then
      edges = pre(edges) + 1;
    end when;
  end Hysteresis;

  function two
    input Real x;
    output Real a;
    output Real b;
  protected
    Real t = 2*x;
  algorithm
    a := t + 1;
    b := t^2;
  end two;

  record R
    Real a;
    Real b = 3;
  end R;

  function norm2
    input Real v[:];
    output Real y;
  algorithm
    y := sqrt(v*v);
  end norm2;

  model Language "functions, records, matrices"
    Real x(start = 0.5, fixed = true), y, z, w, n "falls by a quarter";
    R r = R(a = x);
    Real m[2, 2] = {{x, 0}, {1, 2}};
    Real mv[2] = m*{1, 2};
    Real t[2, 2] = transpose(m);
    constant Real q = Modelica.Constants.pi/4;
    parameter Real ang = Modelica.Units.Conversions.from_deg(30);
    Real s = Modelica.Math.sin(ang) + abs(x) + max(x, 0.2) + min({x, 0.1, 3}) + sign(x) + atan2(x, 1) + exp(-x) + log(2) + mod(5.5, 2) + div(7, 2) + rem(7, 3) + ceil(1.2) + floor(1.7) + integer(2.5);
  equation
    der(x*x) = -x/4;
    (y, z) = two(x);
    w = r.a + r.b;
    n = norm2({x, y, z});
  end Language;

  block Gain
    extends Modelica.Blocks.Interfaces.SISO;
    parameter Real k = 1;
  equation
    y = k*u;
  end Gain;

  model Signals "values of inputs, arrays of blocks"
    Gain g[3](k = {1, 2, 3}, u = {time, 2*time, 1});
    Modelica.Blocks.Math.Gain lib(k = 5, u = time);
    Modelica.Blocks.Sources.RealExpression e(y = g[2].y + lib.y);
    Modelica.Blocks.Continuous.Integrator i(y_start = 1);
    Modelica.Blocks.Sources.CombiTimeTable table(table = [0, 1; 1, 3]);
    Real total = sum(g.y);
  equation
    connect(e.y, i.u);
  end Signals;

  model Chooser
    Modelica.Blocks.Interfaces.RealInput u;
    Modelica.Blocks.Interfaces.BooleanOutput on;
    Modelica.Blocks.Interfaces.RealOutput y(unit = "V");
    Modelica.Blocks.Logical.Switch sw;
    Modelica.Blocks.Sources.Constant one(k = 1), two(k = 2);
  equation
    on = u > 0.5;
    connect(on, sw.u2);
    connect(one.y, sw.u1);
    connect(two.y, sw.u3);
    connect(sw.y, y);
  end Chooser;

  model Queue "an algorithm with when"
    Chooser c;
    Modelica.Blocks.Sources.Ramp ramp(duration = 1, height = 1);
    Boolean late = time > 0.25 and not c.on;
    Integer k(start = 0);
    Real hold(start = 0);
  equation
    connect(ramp.y, c.u);
  algorithm
    when {late, c.on} then
      k := pre(k) + 1;
      if c.on then
        hold := time;
      else
        hold := -time;
      end if;
    end when;
  end Queue;

  model Ladder "vectors of connectors"
    parameter Integer n = 3;
    Modelica.Electrical.Analog.Basic.Resistor r[n](each R = 2);
    Modelica.Electrical.Analog.Basic.Capacitor c[n](C = {i*0.1 for i in 1:n}, v(each start = 0, each fixed = true));
    Modelica.Electrical.Analog.Sources.ConstantVoltage v(V = 5);
    Modelica.Electrical.Analog.Basic.Ground g;
  equation
    connect(v.p, r[1].p);
    connect(r[1:n - 1].n, r[2:n].p);
    connect(r.n, c.p);
    for k in 1:n loop
      connect(c[k].n, g.p);
    end for;
    connect(v.n, g.p);
  end Ladder;

  model Smooth "all that has no events"
    RC rc;
    Chua chua;
    Pendulum pendulum;
    ControlledTank control;
    Rod rod;
    Slices slices;
    Chain chain;
    Chain2 chain2;
    Functions functions;
    Records records;
    Conditional undamped, damped(damped = true, mode = Mode.slow);
    SteadyStart steady;
    Motor motor;
    Language language;
    Signals signals;
    Ladder ladder;
  end Smooth;

  model Events "all that has events"
    BouncingBall ball;
    Thermostat thermostat;
    Sampled sampled;
    Algorithmic algorithmic;
    Buffered buffered;
    Hysteresis hysteresis;
    Queue queue;
  end Events;
end Textbook;
