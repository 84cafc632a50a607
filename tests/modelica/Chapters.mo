package Chapters "Small classes after the chapters of the specification; what they show is known after 1 s"
  package Expressions "Chapter 3"
    model Precedence
      Real x = -2^2 + 3*4/2 - 1 + time;
      Real y = -time^2 - (-time)^2 + 2^(-1);
      Boolean b = not time > 2 and time < 3 or time > 5;
      Real z = if b then 2*time else 0;
      Real w = 7 - 3 - 2 + 12/3/2*time;
    end Precedence;

    model Integers
      Real k = -2.5*time;
      Integer n = integer(k), c = integer(ceil(k)), f = integer(floor(k));
      Integer d = div(-7, 2), m = mod(-7, 2), r = rem(-7, 2);
      Real total = n + 10*c + 100*f + 1000*d + 10000*m + 100000*r;
      Real q = mod(-3.7*time, 2) + rem(-3.7*time, 2) + div(-3.7*time, 2);
    end Integers;

    model Staircase "A state that counts by floor"
      Real x(start = 0, fixed = true), y = floor(3*time + 0.1);
    equation
      der(x) = y;
    end Staircase;

    model Elementary
      Real s = sin(time) + cos(time) + tan(time) + asin(time/2) + acos(time/2) + atan(time) + atan2(time, 2);
      Real e = exp(-time) + log(1 + time) + log10(1 + time) + sinh(time) + cosh(time) + tanh(time) + sqrt(time);
      Real p = abs(time - 2) + sign(time - 2) + max(time, 0.3) + min(time, 0.3) + time^3 + time^0.5;
    end Elementary;

    model Smoothly
      Real x(start = 1, fixed = true), y = noEvent(if x > 0.5 then x else 0.5);
      Real z = smooth(0, if x > 0.6 then 2*x else 1.2), w = homotopy(x^2, x);
    equation
      der(x) = -y;
    end Smoothly;

    model Derivatives "of what is given"
      Real y = sin(2*time), v = der(y), a = der(v);
    end Derivatives;

    model OfExpressions
      Real x(start = 1, fixed = true), a = der(der(sin(2*time)));
    equation
      der(x^2 + x) = 3*cos(time);
    end OfExpressions;

    model Loop "A nonlinear equation"
      Real x(start = 2, fixed = true), y(start = 1);
    equation
      der(x) = -x*y;
      y^3 + y = x;
    end Loop;

    model Counting
      Integer n(start = 0, fixed = true);
      discrete Real last(start = -1, fixed = true);
    equation
      when sample(0.05, 0.2) then
        n = pre(n) + 2;
        last = time + pre(last);
      end when;
    end Counting;
  end Expressions;

  package Classes "Chapter 4"
    model Decay
      parameter Real k = 1;
      parameter Real x0 = 1;
      Real x(start = x0, fixed = true);
    equation
      der(x) = -k*x;
    end Decay;

    model Conditional
      parameter Boolean with = true, other = not with;
      Decay a(k = 2) if with;
      Decay b(k = 3) if other;
      Decay c if with and not other;
    end Conditional;

    model Short = Decay(k = 0.5, x(start = 4));

    model Types
      type Rate = Real(unit = "1/s", min = 0, start = 3);
      type Fast = Rate(start = 5);
      parameter Rate k = 0.25;
      Fast x(fixed = true);
      Rate y(fixed = true);
    equation
      der(x) = -k*x;
      der(y) = -2*k*y;
    end Types;

    model Dependent
      constant Real c = 2*3;
      parameter Real a = b + 1, b = c/4;
      final parameter Real d = a*b;
      parameter Integer n = 3;
      Real x(start = d, fixed = true);
    equation
      der(x) = n - x;
    end Dependent;

    model Chained "Blocks with inputs and outputs"
      block Lag
        input Real u;
        output Real y(start = 0, fixed = true);
        parameter Real T = 1;
      equation
        T*der(y) = u - y;
      end Lag;
      Lag first(T = 0.5), second;
    equation
      first.u = 1 + time;
      second.u = first.y;
    end Chained;

    model Colours "An enumeration as a type, as a value and as a subscript"
      type Colour = enumeration(red "warm", green, blue "cold");
      parameter Colour mine = Colour.blue;
      parameter Real weight[Colour] = {1, 2, 4};
      Colour now = if time < 0.5 then Colour.red else Colour.green;
      Real y = weight[mine] + weight[Colour.red]*time;
      Integer n = Integer(now) + Integer(mine);
      Boolean before = now < mine;
      Real z = if before and now <> Colour.red then 1 else 0;
    end Colours;

    model Hidden
      parameter Real k = 2;
      Real y;
    protected
      parameter Real square = k^2;
      Real x = square*time;
    public
      Real z = x + 1;
    equation
      y = 2*x;
    end Hidden;

    record Point
      Real x = 1;
      Real y;
    end Point;

    record Weighted
      extends Point(x = 3);
      parameter Real weight = 2;
    end Weighted;

    model Records
      Point a(y = time), b(x = 2*time, y = 5), c = Point(x = time, y = 2);
      Weighted w(y = a.x + b.x);
      Point many[2](y = {time, 2*time});
      Real total = a.x + a.y + b.x + b.y + c.x + c.y + w.x*w.weight + w.y + sum(many.y);
    end Records;
  end Classes;

  package Names "Chapters 5 and 13"
    constant Real factor = 3;

    package Inner
      constant Real factor = 5;
      constant Real own = 2*factor;
      model Uses
        Real y = factor*time + own;
      end Uses;
      encapsulated model Alone
        import Chapters.Names.factor;
        Real y = factor*time;
      end Alone;
    end Inner;

    model Imported
      import Chapters.Names.Inner;
      import I = Chapters.Names.Inner;
      import Chapters.Names.Inner.{own, Uses};
      import Chapters.Classes.*;
      Inner.Uses a;
      I.Alone b;
      Uses c;
      Decay d(k = own);
      Real y = factor*time;
    end Imported;

    model World
      parameter Real g = 9.81;
      Real wind = 2*time;
    end World;

    model Falling
      outer World world;
      Real v(start = 0, fixed = true);
    equation
      der(v) = -world.g - v + world.wind;
    end Falling;

    model Nested
      Falling a;
      Falling many[2];
    end Nested;

    model Surroundings
      inner World world(g = 1.6);
      Falling a;
      Nested deep;
    end Surroundings;
  end Names;

  package Inheritance "Chapters 6 and 7"
    partial model Law
      Real x(start = 1, fixed = true);
      Real rate;
    equation
      der(x) = rate;
    end Law;

    model Linear
      extends Law;
      parameter Real k = 1;
    equation
      rate = -k*x;
    end Linear;

    model Cubic
      extends Law;
      parameter Real k = 1;
    equation
      rate = -k*x^3;
    end Cubic;

    model Left
      extends Classes.Decay;
      Real twice = 2*x;
    end Left;

    model Right
      extends Classes.Decay;
      Real thrice = 3*x;
    end Right;

    model Twice "One base on two ways"
      extends Left;
      extends Right;
    end Twice;

    model Holder
      replaceable Linear law constrainedby Law;
      Real y = 2*law.x;
    end Holder;

    model Redeclared
      Holder a;
      Holder b(redeclare Cubic law(k = 2));
      extends Holder(redeclare replaceable Cubic law);
    end Redeclared;

    model Chosen
      replaceable model Kind = Linear constrainedby Law;
      Kind first;
      Kind second(x(start = 2));
    end Chosen;

    model OtherKind
      extends Chosen(redeclare model Kind = Cubic);
    end OtherKind;

    package Medium
      constant Real cp = 1;
      replaceable function power
        input Real T;
        output Real P;
      algorithm
        P := cp*T;
      end power;
    end Medium;

    package Oil
      extends Medium(cp = 2);
      redeclare function power
        input Real T;
        output Real P;
      algorithm
        P := cp*T + 1;
      end power;
    end Oil;

    package Water
      extends Medium(final cp = 4);
    end Water;

    model Heating
      replaceable package M = Medium;
      Real T(start = 1, fixed = true);
    equation
      2*der(T) = -M.power(T);
    end Heating;

    model Heatings
      Heating plain;
      Heating water(redeclare package M = Water);
    end Heatings;

    model Modified
      Heating oil(redeclare package M = Oil);
      Heating two(redeclare package M = Medium(cp = 2), T.start = 3);
      Library.Whole part(p.k = 2);
      Chosen chosen(redeclare model Kind = Cubic(k = 0.5));
    end Modified;

    model Each
      parameter Real start[3] = {1, 2, 3};
      Linear law[3](k = {0.5, 1, 2}, x(start = start));
      Linear same[2](each k = 3, each x(start = 4));
    end Each;

    package Library
      replaceable model Part
        parameter Real k = 1;
        Real x(start = 1, fixed = true);
      equation
        der(x) = -k*x;
      end Part;
      model Whole
        Part p;
      end Whole;
    end Library;

    package Changed
      extends Library;
      redeclare model extends Part
        Real y = 2*x;
      end Part;
    end Changed;

    model Uses
      Library.Whole a(p(k = 2));
      Changed.Part b(k = 3);
    end Uses;
  end Inheritance;

  package Equations "Chapter 8"
    model Loops
      parameter Integer n = 3;
      Real x[n, n], y[n];
    equation
      for i in 1:n loop
        for j in 1:n loop
          x[i, j] = if i == j then time else i - j;
        end for;
        y[i] = sum(x[i, :]);
      end for;
    end Loops;

    model Ifs
      parameter Boolean fast = true;
      Real x(start = 1, fixed = true), y, z;
    equation
      if fast then
        der(x) = -2*x;
      else
        der(x) = -x;
      end if;
      if time < 0.4 then
        y = 1;
        z = x;
      elseif x > 0.3 then
        y = 2;
        z = 2*x;
      else
        y = 3;
        z = 3*x;
      end if;
    end Ifs;

    model Ball
      parameter Real e = 0.8;
      Real h(start = 1, fixed = true), v(start = 0, fixed = true);
      Integer hits(start = 0, fixed = true);
    equation
      der(h) = v;
      der(v) = -9.81;
      when h <= 0 then
        reinit(v, -e*pre(v));
        hits = pre(hits) + 1;
      end when;
    end Ball;

    model Elsewhen
      Real x(start = 0, fixed = true);
      discrete Real y(start = 1, fixed = true);
      Boolean up = x > 0.25, late = time > 0.7;
      Integer edges(start = 0, fixed = true);
    equation
      der(x) = 1;
      when up then
        y = 2*x;
      elsewhen late then
        y = pre(y) + 3;
      end when;
      when {edge(up), late, time > 0.9} then
        edges = pre(edges) + 1;
      end when;
    end Elsewhen;

    model Started "Initial equations, and a parameter that they determine"
      parameter Real k(fixed = false, start = 1);
      parameter Real steady = 2;
      Real x(start = 1), y(start = 3, fixed = true);
    initial equation
      der(x) = 0;
      k*steady = x + 3;
    equation
      der(x) = 4 - 2*x + time;
      der(y) = -k*y;
    end Started;

    model Constrained "Two capacitors in parallel: one state"
      Real v1(start = 1, fixed = true), v2, i1, i2;
    equation
      2*der(v1) = i1;
      3*der(v2) = i2;
      v1 = v2;
      i1 + i2 = -v1;
    end Constrained;

    model Pendulum "Index three, in its angle"
      Real phi(start = 0.5, fixed = true), w(start = 0, fixed = true), x, y, F;
    equation
      x = sin(phi);
      y = -cos(phi);
      w = der(phi);
      der(der(x)) = -F*x;
      der(der(y)) = -F*y - 9.81;
    end Pendulum;

    model Modes "A machine of three states"
      Integer mode(start = 1, fixed = true);
      Real x(start = 0, fixed = true);
    equation
      der(x) = if mode == 1 then 2 elseif mode == 2 then -1 else 0;
      when pre(mode) == 1 and x > 0.5 then
        mode = 2;
      elsewhen pre(mode) == 2 and x < 0.2 then
        mode = 3;
      end when;
    end Modes;

    model Pulses "What changes, and what has risen"
      Boolean on = sin(20*time - 1) > 0;
      Integer rises(start = 0, fixed = true), changes(start = 0, fixed = true);
      discrete Real first(start = 5, fixed = true);
    equation
      when edge(on) then
        rises = pre(rises) + 1;
      end when;
      when change(on) then
        changes = pre(changes) + 1;
      end when;
      when initial() then
        first = 2 + time;
      end when;
    end Pulses;

    model Saw "A state that is set back by samples"
      parameter Real T = 0.3;
      Real x(start = 0.5, fixed = true), area(start = 0, fixed = true);
    equation
      der(x) = 2;
      der(area) = x;
      when sample(T, T) then
        reinit(x, 0.1*pre(x));
      end when;
    end Saw;

    model Saturated "if with events, in an expression"
      parameter Real limit = 0.6;
      Real u = 2*sin(3*time), x(start = 0, fixed = true);
    equation
      der(x) = if u > limit then limit elseif u < -limit then -limit else u;
    end Saturated;
  end Equations;

  package Connections "Chapter 9"
    connector Pin
      Real v;
      flow Real i;
    end Pin;

    partial model TwoPin
      Pin p, n;
      Real v = p.v - n.v, i = p.i;
    equation
      p.i + n.i = 0;
    end TwoPin;

    model Resistor
      extends TwoPin;
      parameter Real R = 1;
    equation
      v = R*i;
    end Resistor;

    model Capacitor
      extends TwoPin(v(start = 0, fixed = true));
      parameter Real C = 1;
    equation
      C*der(v) = i;
    end Capacitor;

    model Source
      extends TwoPin;
      parameter Real V = 1;
    equation
      v = V;
    end Source;

    model Ground
      Pin p;
    equation
      p.v = 0;
    end Ground;

    model Ladder "Arrays of components, connected in a loop"
      parameter Integer n = 4;
      Source source(V = 10);
      Ground ground;
      Resistor r[n](each R = 0.5);
      Capacitor c[n](C = {0.1*i for i in 1:n});
    equation
      connect(source.p, r[1].p);
      connect(source.n, ground.p);
      for i in 1:n loop
        connect(r[i].n, c[i].p);
        connect(c[i].n, ground.p);
      end for;
      for i in 1:n - 1 loop
        connect(r[i].n, r[i + 1].p);
      end for;
    end Ladder;

    model Bank "Arrays of connectors, and what nobody connects"
      model Store
        parameter Integer n = 2;
        Pin pins[n];
        Real x(start = 2, fixed = true);
      equation
        der(x) = sum(pins.i);
        for i in 1:n loop
          pins[i].v = x;
        end for;
      end Store;
      Store store(n = 3), other(x(start = 0));
      Resistor r[2](R = {1, 2});
    equation
      connect(store.pins[1:2], r.p);
      connect(r[1].n, other.pins[1]);
      connect(r[2].n, other.pins[2]);
    end Bank;

    connector Flange
      Real s;
      flow Real f;
    end Flange;

    model Mass
      Flange a, b;
      parameter Real m = 1;
      Real s(start = 0, fixed = true), v(start = 0, fixed = true);
    equation
      a.s = s;
      b.s = s;
      v = der(s);
      m*der(v) = a.f + b.f;
    end Mass;

    model Spring
      Flange a, b;
      parameter Real c = 1, d = 0;
      Real stretch = b.s - a.s;
    equation
      b.f = c*stretch + d*der(stretch);
      a.f = -b.f;
    end Spring;

    model Oscillators "A ring of masses: parts as they come from records of parameters"
      record Data
        parameter Real m, c;
      end Data;
      parameter Data data = Data(m = 2, c = 8);
      Mass first(m = data.m, s(start = 1)), second(m = 2*data.m);
      Spring left(c = data.c), right(c = 3, d = 0.5);
    equation
      connect(first.a, left.a);
      connect(left.b, second.a);
      connect(first.b, right.a);
      connect(right.b, second.b);
    end Oscillators;

    connector RealInput = input Real;
    connector RealOutput = output Real;

    model Signals
      block Gain
        RealInput u;
        RealOutput y = k*u;
        parameter Real k = 2;
      end Gain;
      block Integrator
        RealInput u;
        RealOutput y(start = 0, fixed = true);
      equation
        der(y) = u;
      end Integrator;
      block Both
        RealInput u;
        RealOutput y;
        Gain gain(k = 3);
        Integrator integrator;
      equation
        connect(u, gain.u);
        connect(gain.y, integrator.u);
        connect(integrator.y, y);
      end Both;
      Both a, b;
    equation
      a.u = time;
      connect(a.y, b.u);
    end Signals;
  end Connections;

  package Arrays "Chapter 10"
    model Constructed
      Real A[2, 3] = [1, 2, 3; 4, 5, 6], B[3, 2] = transpose(A), C[2, 2] = A*B;
      Real z = sum(zeros(2, 2)) + sum(ones(3)) + sum(fill(time, 2, 3)) + product({1, 2, 3});
      Real l[5] = linspace(0, 1, 5), e = sum(identity(3)) + sum(diagonal({1, 2}));
      Real s = sum(C) + sum(cat(1, {1, 2}, {3}))*time;
      Real v = {1.5, 2, 3}*{4, 5, 6} + sum(cross({1, 0, 0}, {0, 1, 0})) + sum(vector([1.5; 2]));
    end Constructed;

    model Sliced
      Real x[5] = {i*time for i in 1:5};
      Real y[3] = x[2:4], z[3] = x[{5, 3, 1}], w[2] = x[end - 1:end], back[3] = x[5:-2:1];
      Real M[2, 3] = [x[1], x[2], x[3]; 7, 2*x[4], 9];
      Real row[3] = M[2, :], column[2] = M[:, 2];
    end Sliced;

    model Reductions
      parameter Integer n = 4;
      Real a = sum(i^2 for i in 1:n)*time, b = product(i + 1 for i in 1:3);
      Real c = max(abs(i - 2.5) for i in 1:n), d = min(i*time for i in 2:3);
      Real m[2, 3] = {{i + 10*j for i in 1:3} for j in 1:2};
      Real t = m[2, 3]*time;
    end Reductions;

    model StateSpace
      parameter Real A[2, 2] = [0, 1; -4, -0.5], B[2, 1] = [0; 1], C[1, 2] = [1, 0];
      Real x[2](start = {1, 0}, each fixed = true), u[1] = {sin(time)}, y[1];
    equation
      der(x) = A*x + B*u;
      y = C*x;
    end StateSpace;

    model Elementwise
      Real a[2] = {1, 2}, b[2] = {1 + time, 3};
      Real c[2] = a .* b + a ./ b .^ 2 - 2*b, d[2] = 2 .- a .^ b, e[2] = sin(a) + exp(-b);
      Real n = a*a;
    end Elementwise;

    model Rod "Heat in a rod"
      parameter Integer n = 6;
      parameter Real h = 1/n;
      Real T[n](each start = 0, each fixed = true);
    equation
      der(T[1]) = (T[2] - 2*T[1] + 1)/(10*h^2);
      der(T[2:n - 1]) = (T[3:n] - 2*T[2:n - 1] + T[1:n - 2])/(10*h^2);
      der(T[n]) = (T[n - 1] - T[n])/(10*h^2);
    end Rod;

    model Further "Two iterators, powers of matrices, all literals of a type, scalar"
      Integer k[2, 3] = {10*i + j for j in 1:3, i in 1:2}, t = sum(k[2, :]);
      Real n = size(k, 2), b = product(i + j for i in 1:2, j in 1:2), f[2, 2] = [1, 2; 3, 4]^ndims(k);
      Real c = sum(i for i in f[1, :]), s = scalar([time]);
    end Further;

    model Sizes
      parameter Real p[:] = {1, 2, 3}, Q[:, :] = [1, 2; 3, 4; 5, 6];
      parameter Integer n = size(p, 1), m[2] = size(Q);
      Real x[n](start = p, each fixed = true), y[size(Q, 2), size(Q, 1)] = transpose(Q)*time;
    equation
      der(x) = -p .* x;
    end Sizes;
  end Arrays;

  package Algorithms "Chapter 11"
    model Sections
      Real x, y, z;
      Integer n;
    algorithm
      n := 0;
      for i in 1:4 loop
        if mod(i, 2) == 0 then
          n := n + i;
        else
          n := n - 1;
        end if;
      end for;
      x := n*time;
      if x > 2 then
        y := x - 2;
      elseif x > 1 then
        y := x - 1;
      else
        y := x;
      end if;
      z := y + x;
      z := 2*z;
    end Sections;

    model Sampled
      Real x(start = 1, fixed = true);
      discrete Real u(start = 0, fixed = true), sum(start = 0, fixed = true);
    equation
      der(x) = -x + u;
    algorithm
      when sample(0.1, 0.25) then
        u := 0.5*x;
        sum := pre(sum) + u;
      end when;
    end Sampled;

    model Straight
      Real x(start = 1, fixed = true), y, rate;
    equation
      der(x) = rate;
    algorithm
      rate := -x;
      rate := 2*rate + sin(time);
      if x > 0.4 then
        y := x;
      else
        y := 3*x;
      end if;
    end Straight;

    model Filled
      Real c[4], total;
    algorithm
      total := 0;
      for i in 1:4 loop
        c[i] := i*time;
        total := total + c[i];
      end for;
    end Filled;
  end Algorithms;

  package Functions "Chapter 12"
    function polar
      input Real x, y = 1;
      output Real r, phi;
    algorithm
      r := sqrt(x^2 + y^2);
      phi := atan2(y, x);
    end polar;

    function polynomial "Horner's scheme"
      input Real x, c[:];
      output Real y = 0;
    algorithm
      for i in size(c, 1):-1:1 loop
        y := y*x + c[i];
      end for;
    end polynomial;

    function cumulated
      input Real x[:];
      output Real y[size(x, 1)];
    protected
      Real total = 0;
    algorithm
      for i in 1:size(x, 1) loop
        total := total + x[i];
        y[i] := total;
      end for;
    end cumulated;

    function root "by Newton's method"
      input Real a;
      output Real y;
    protected
      Integer i = 0;
    algorithm
      y := a;
      while i < 6 loop
        y := 0.5*(y + a/y);
        i := i + 1;
        if i > 4 then
          break;
        end if;
      end while;
    end root;

    function clipped
      input Real u;
      output Real y;
    algorithm
      y := u;
      if u > 0.5 then
        y := 0.5;
        return;
      end if;
      y := 2*y;
    end clipped;

    function moved
      input Classes.Point p;
      input Real by;
      output Classes.Point q;
    algorithm
      q := p;
      q.x := p.x + by;
    end moved;

    model Called
      Real r, phi, one = polar(time), y = polynomial(time, {1, 2, 3}), c[3] = cumulated({time, 2, 3});
      Real named = polar(y = 2, x = time);
    equation
      (r, phi) = polar(3*time, 4);
    end Called;

    model Steps
      Real y = root(1 + time), z = clipped(time), w = clipped(0.3*time);
    end Steps;

    function chosen
      input Real u;
      input Integer kind = 1;
      output Real y;
    algorithm
      if kind == 1 then
        y := u^2;
      elseif kind == 2 then
        y := 2*u;
      else
        y := -u;
      end if;
    end chosen;

    function square = chosen(kind = 1);

    model Choices
      Real a = chosen(3*time), b = chosen(3*time, 2), c = chosen(kind = 3, u = time), d = square(2*time);
    end Choices;

    model WithRecords
      Classes.Point p(x = time, y = 2), q = moved(p, 3);
      Real y = q.x + q.y;
    end WithRecords;

    model Differentiated "A function in a constraint"
      Real x(start = 0.5, fixed = true), y, v(start = 1, fixed = true);
    equation
      y = polynomial(x, {0, 1, 1});
      der(y) = v;
      der(v) = -y;
    end Differentiated;
  end Functions;

  package Operators "Chapter 14"
    operator record Pair
      Real a, b;
      encapsulated operator function '+'
        import Chapters.Operators.Pair;
        input Pair x, y;
        output Pair z;
      algorithm
        z := Pair(x.a + y.a, x.b + y.b);
      end '+';
      encapsulated operator '*'
        import Chapters.Operators.Pair;
        function scaled
          input Real k;
          input Pair x;
          output Pair z;
        algorithm
          z := Pair(k*x.a, k*x.b);
        end scaled;
        function dot
          input Pair x, y;
          output Real z;
        algorithm
          z := x.a*y.a + x.b*y.b;
        end dot;
      end '*';
    end Pair;

    model Overloaded
      Pair x = Pair(time, 2), y = Pair(3, 4), z = x + 2.0*y;
      Real d = x*y;
    end Overloaded;
  end Operators;
end Chapters;
