package Phasors "Records with operators, in equations and in connectors whose angle is redundant"
  operator record Phasor
    replaceable Real re;
    replaceable Real im;
    encapsulated operator 'constructor'
      function fromReal
        import Phasors.Phasor;
        input Real re;
        input Real im = 0;
        output Phasor made(re = re, im = im);
      algorithm
      end fromReal;
    end 'constructor';
    encapsulated operator function '+'
      import Phasors.Phasor;
      input Phasor a;
      input Phasor b;
      output Phasor c = Phasor(a.re + b.re, a.im + b.im);
    algorithm
    end '+';
    encapsulated operator '-'
      import Phasors.Phasor;
      function negative
        input Phasor a;
        output Phasor c = Phasor(-a.re, -a.im);
      algorithm
      end negative;
      function difference
        input Phasor a;
        input Phasor b;
        output Phasor c = Phasor(a.re - b.re, a.im - b.im);
      algorithm
      end difference;
    end '-';
    encapsulated operator '*'
      import Phasors.Phasor;
      function product
        input Phasor a;
        input Phasor b;
        output Phasor c = Phasor(a.re*b.re - a.im*b.im, a.re*b.im + a.im*b.re);
      algorithm
      end product;
      function scalar "with the conjugate of the first"
        input Phasor a[:];
        input Phasor b[size(a, 1)];
        output Phasor c = Phasor(sum(a[i].re*b[i].re + a[i].im*b[i].im for i in 1:size(a, 1)), sum(a[i].re*b[i].im - a[i].im*b[i].re for i in 1:size(a, 1)));
      algorithm
      end scalar;
    end '*';
  end Phasor;

  function size2 "of one phasor; of several one after the other"
    input Phasor z;
    output Real y = z.re^2 + z.im^2;
  algorithm
  end size2;

  operator record Voltage = Phasor(redeclare Modelica.Units.SI.Voltage re, redeclare Modelica.Units.SI.Voltage im);
  operator record Current = Phasor(redeclare Modelica.Units.SI.Current re, redeclare Modelica.Units.SI.Current im);

  record Angle
    Real phi;
    function equalityConstraint
      input Angle a;
      input Angle b;
      output Real residual[0];
    algorithm
    end equalityConstraint;
  end Angle;

  connector Pin
    Voltage v;
    flow Current i;
    Angle angle;
  end Pin;

  connector Sent = output Phasor;
  connector Taken = input Phasor;

  partial model TwoPin
    Pin p;
    Pin n;
    Voltage v;
    Current i;
    Real omega = der(p.angle.phi);
  equation
    Connections.branch(p.angle, n.angle);
    p.angle.phi = n.angle.phi;
    v = p.v - n.v;
    i = p.i;
    p.i + n.i = Phasor(0);
  end TwoPin;

  model Impedance
    extends TwoPin;
    parameter Real R = 3;
    parameter Real L = 0;
  equation
    v = Phasor(R, omega*L)*i;
  end Impedance;

  model Source
    extends TwoPin;
    parameter Phasor V(re = 10, im = 0);
    Boolean first = Connections.isRoot(p.angle);
  equation
    Connections.potentialRoot(p.angle);
    if Connections.isRoot(p.angle) then
      omega = 2;
    end if;
    v = V;
  end Source;

  model Ground
    Pin p;
  equation
    Connections.potentialRoot(p.angle, 5);
    if Connections.isRoot(p.angle) then
      p.angle.phi = 0;
    end if;
    p.v = Phasor(0);
  end Ground;

  model Twice
    Taken u;
    Sent y;
  equation
    y = 2*u + u - 1*u;
  end Twice;

  model Same
    Sent y;
    parameter Phasor z = Phasor(3, 4);
  equation
    y = if time > 0.5 then -z else z;
  end Same;

  model Sink "signals of records that are given values, arrays of connectors with records"
    Pin pin[2];
    Sent s[2] = pin.i;
  equation
    Connections.branch(pin[1].angle, pin[2].angle);
    Connections.root(pin[1].angle);
    pin[1].angle.phi = 0;
    pin[2].angle.phi = 0;
    pin.v = {Phasor(6), Phasor(3)};
  end Sink;

  model Circuit "two impedances in parallel close a loop of angles"
    Source source;
    Ground ground;
    Impedance a(R = 3, L = 2), b(R = 5);
    Same same;
    Sink sink;
    Impedance c(R = 3);
    Twice twice[2];
    Real squares[2] = size2(twice.y);
    Phasor across[2] = {a.i, b.i};
    Phasor power = across*{source.v, Phasor(10)};
    Phasor whole = sum(across);
  equation
    connect(source.p, a.p);
    connect(source.n, a.n);
    connect(a.p, b.p);
    connect(a.n, b.n);
    connect(source.n, ground.p);
    connect(c.p, sink.pin[1]);
    connect(c.n, sink.pin[2]);
    connect(same.y, twice[1].u);
    connect(twice[1].y, twice[2].u);
  end Circuit;
end Phasors;
