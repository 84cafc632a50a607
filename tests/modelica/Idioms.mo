package Idioms "What public libraries write; each model has a known derivative"
  type Substance = enumeration(A, B);
  import Idioms.Substance.B;

  model StateSpace "matrices without columns or rows"
    parameter Integer nx = 0, nu = 0, ny = 0;
    parameter Real A[nx, nx] = fill(0, nx, nx);
    parameter Real B[nx, nu] = fill(0, nx, nu);
    parameter Real C[ny, nx] = fill(0, ny, nx);
    Real x[nx](each start = 1, each fixed = true), u[nu], y[ny];
  equation
    der(x) = A*x + B*u;
    y = C*x;
  end StateSpace;

  model Free
    extends StateSpace(nx = 2, A = [0, 1; -4, 0]);
  equation
    u = fill(0, 0);
  end Free;

  connector Species "names that Python needs for something else"
    Real population;
    flow Real rate;
  end Species;

  model Growth
    Species species(population(start = 1, fixed = true));
    parameter Real document = 3;
    Real shapes = species.population;
    Real 'a+b' = document*shapes;
  equation
    der(species.population) = species.rate + 'a+b';
  end Growth;

  model Loss
    Species species;
    parameter Real replace = 1;
  equation
    species.rate = replace*species.population;
  end Loss;

  model Population
    Growth g(document = 4);
    Loss loss(replace = 0.5), '1st';
  equation
    connect(g.species, loss.species);
    connect(g.species, '1st'.species);
  end Population;

  connector Mixture "as many variables as values of a type"
    Real c[Substance];
    flow Real n[Substance];
  end Mixture;

  model Tank
    Mixture m;
    parameter Substance slow = B "by an import of a value";
    parameter Modelica.Units.SI.Temperature T "without a value: its start counts";
    Real c[Substance](each start = 1, each fixed = true) = m.c;
  equation
    for s in Substance loop
      der(c[s]) = m.n[s] + (if s == slow then 2 else T/288.15);
    end for;
  end Tank;

  partial model Law
    Real x(start = 1, fixed = true);
  end Law;

  model Decay
    extends Law;
    parameter Real k = 1;
  equation
    der(x) = -k*x;
  end Decay;

  model Linear
    extends Law;
  equation
    der(x) = -2;
  end Linear;

  model Plant
    replaceable Decay law(x(start = 3)) constrainedby Law;
  end Plant;

  model Fast
    extends Plant(redeclare replaceable Decay law(k = 5));
  end Fast;

  model Redeclared "twice; the modifiers of the first replacement are those of its class"
    extends Fast(redeclare Linear law);
  end Redeclared;

  partial package Phases "a package of sizes and functions, whose members see those of the package that extends it"
    constant Integer n;
    constant Real gain = 10*n;
    type Voltage = Real(unit = "V", nominal = gain);
    replaceable partial function turned
      input Real x[n];
      output Real y[n];
    end turned;
    function twice
      input Real x[n];
      output Real y[n] = 2*turned(x);
    end twice;
  end Phases;

  package Direct
    extends Phases(n = 1);
    redeclare function extends turned
    algorithm
      y := -x;
    end turned;
  end Direct;

  package Rotating
    extends Phases(n = 2);
    redeclare function extends turned
    algorithm
      y := {-x[2], x[1]};
    end turned;
  end Rotating;

  connector Terminal
    replaceable package System = Phases;
    System.Voltage v[System.n];
    flow Real i[System.n];
  end Terminal;

  connector Plug
    extends Terminal;
  end Plug;

  model Machine
    replaceable package System = Direct constrainedby Phases;
    function turned = System.turned;
    Plug plug(redeclare package System = System);
    Real x[System.n](each start = 1, each fixed = true) = plug.v;
  equation
    der(x) = plug.i + turned(x) + System.gain*System.twice(x);
  end Machine;

  model Load
    replaceable package System = Direct constrainedby Phases;
    Terminal t(redeclare package System = System);
  equation
    t.i = t.v;
  end Load;

  model Drive
    replaceable package System = Direct constrainedby Phases;
    Machine machine(redeclare package System = System);
    Load load(redeclare package System = System);
  equation
    connect(machine.plug, load.t);
  end Drive;

  type Reference "of a turning frame"
    extends Modelica.Units.SI.Angle;
    function equalityConstraint
      input Reference a[:], b[:];
      output Real residue[0];
    algorithm
      assert(size(a, 1) == size(b, 1), "unlike");
    end equalityConstraint;
  end Reference;

  connector Phasor
    Real v[2];
    flow Real i[2];
    Reference theta[1];
  end Phasor;

  model Grid
    Phasor p;
    parameter Real w = 3;
  equation
    Connections.potentialRoot(p.theta);
    if Connections.isRoot(p.theta) then
      p.theta[1] = w*time;
    end if;
    p.v = {cos(p.theta[1]), sin(p.theta[1])};
  end Grid;

  model Line
    Phasor a, b;
    parameter Real L = 2;
    Real i[2](each start = 1, each fixed = true);
  equation
    Connections.branch(a.theta, b.theta);
    a.theta = b.theta;
    a.i = i;
    L*der(i) + der(a.theta[1])*{-i[2], i[1]} = a.v - b.v;
  algorithm
    b.i := -i;
  end Line;

  model Consumer
    Phasor p;
  equation
    p.v = p.i;
  end Consumer;

  model Lines "two in parallel, whose loop is cut"
    Grid grid;
    Line one, two(L = 4);
    Consumer consumer;
  equation
    connect(grid.p, one.a);
    connect(grid.p, two.a);
    connect(one.b, consumer.p);
    connect(two.b, consumer.p);
  end Lines;

  expandable connector Bus
  end Bus;

  expandable connector ControlBus
    extends Bus;
    Bus sensors;
    Real unused;
  end ControlBus;

  model Mass
    Bus bus;
    Modelica.Mechanics.Translational.Components.Mass m(m = 2, s(start = 1, fixed = true), v(start = 1, fixed = true));
    Modelica.Mechanics.Translational.Sources.Force force;
    Modelica.Mechanics.Translational.Sensors.PositionSensor position;
    Modelica.Blocks.Sources.BooleanConstant on;
  equation
    connect(force.flange, m.flange_a);
    connect(m.flange_b, position.flange);
    connect(bus.force, force.f);
    connect(position.s, bus.position);
    connect(bus.flange, m.flange_b);
    connect(on.y, bus.on);
  end Mass;

  model Controller "reads a signal through an input of its own"
    ControlBus bus;
    Modelica.Blocks.Math.Gain gain(k = -3);
    Modelica.Blocks.Logical.Switch switch;
    Modelica.Blocks.Sources.Constant none(k = 0);
  protected
    Modelica.Blocks.Interfaces.RealInput u;
  equation
    connect(bus.sensors.position, u);
    connect(u, gain.u);
    connect(gain.y, switch.u1);
    connect(none.y, switch.u3);
    connect(bus.on, switch.u2);
    connect(switch.y, bus.force);
  end Controller;

  model Bystander
    ControlBus bus;
  end Bystander;

  model Controlled "signals and a flange go through buses, also through one of a part that uses nothing of them"
    Mass mass;
    Bystander between;
    Controller controller;
    Bus sensors;
    Modelica.Mechanics.Translational.Components.Spring spring(c = 5);
    Modelica.Mechanics.Translational.Components.Fixed wall;
    Modelica.Blocks.Continuous.Integrator sum[2](each y_start = 1);
  equation
    connect(mass.bus, between.bus);
    connect(between.bus, controller.bus);
    connect(mass.bus.position, sensors.position);
    connect(sensors, controller.bus.sensors);
    connect(wall.flange, spring.flange_a);
    connect(spring.flange_b, mass.bus.flange);
    for i in 1:2 loop
      connect(between.bus.sum[i], sum[i].u);
    end for;
    connect(mass.bus.position, between.bus.sum[1]);
    connect(sum[1].y, between.bus.sum[2]);
  end Controlled;

  function piecewise "a value that only branches assign"
    input Real x, xs[:], ys[:];
    output Real y;
  algorithm
    for i in 1:size(xs, 1) - 1 loop
      if x >= xs[i] and x <= xs[i + 1] then
        y := ys[i] + (ys[i + 1] - ys[i])*(x - xs[i])/(xs[i + 1] - xs[i]);
      end if;
    end for;
  end piecewise;

  partial model Fluid
    replaceable function density
      input Real p;
      output Real d;
    end density;
    function twice
      input Real p;
      output Real d = 2*density(p);
    end twice;
  end Fluid;

  model Oil
    extends Fluid;
    redeclare function density
      input Real p;
      output Real d = 1000 + p;
    end density;
  end Oil;

  connector Plain
    Real c;
    flow Real n;
  end Plain;

  connector Port
    extends Plain;
    input Real V;
  end Port;

  model Pipe "functions of a part and of the library, values for variables of a connector"
    outer Oil oil;
    function arctan = Modelica.Math.atan;
    Real x(start = 1, fixed = true);
    Port port(c = 3*x);
    Modelica.Blocks.Interfaces.BooleanOutput open[2](start = fill(true, 2), each fixed = true);
  equation
    der(x) = port.c + piecewise(x, {0, 2, 5}, {1, 3, 9}) + oil.twice(5) + arctan(0);
    connect(port, port);
    when time > 1 then
      open = {false, not pre(open[2])};
    end when;
  end Pipe;

  block Weighted "sizes that an interface of the library declares"
    extends Modelica.Blocks.Interfaces.MISO;
    parameter Real k[nin];
    Real sum(start = 1, fixed = true);
  equation
    y = k*u;
    der(sum) = y;
  end Weighted;

  model Piping
    inner Oil oil;
    Pipe pipe;
    Weighted weighted(nin = 2, k = {3, 4});
  equation
    pipe.port.V = 0;
    weighted.u = {pipe.x, 1};
  end Piping;

  connector Vector
    Real v[2];
    flow Real i[2];
  end Vector;

  model Store
    Vector c;
  equation
    der(c.v) = c.i + {1, 2};
  end Store;

  model Matrices "of numbers that are known, and arrays of arrays"
    parameter Real k = 2;
    parameter Real A[2, 2] = Modelica.Math.Matrices.inv([k, 1; 0, 4]);
    parameter Real b[2] = Modelica.Math.Matrices.solve([k, 1; 0, 4], {1, 2});
    parameter Real poles[2, 2] = Modelica.Math.Matrices.eigenValues([0, 1; -9, 0]);
    Store store(c(v(start = {3, 4}, each fixed = true)));
    Real x[2, 1](start = transpose(fill({1, 1}, 1)), each fixed = true);
  equation
    der(x) = -poles[1, 2]^2*transpose(fill(A*{1, 2} + b, 1));
  end Matrices;

  model Voltage "an input that is there or not, and one within that stands for it"
    parameter Boolean use_v = false;
    parameter Real v0 = 2;
    Modelica.Blocks.Interfaces.RealInput v[2] if use_v;
    Real x[2](each start = 1, each fixed = true);
  protected
    Modelica.Blocks.Interfaces.RealInput passed[2];
  equation
    connect(v, passed);
    if not use_v then
      passed = {v0, 3};
    end if;
    der(x) = passed;
  end Voltage;

  model Voltages
    Voltage own, given(use_v = true);
    Modelica.Blocks.Sources.Constant c[2](k = {5, 6});
  equation
    connect(c.y, given.v);
  end Voltages;

  model Choosing "enumerations of the library, also by another name"
    import Modelica.Blocks.Types.Init;
    type Start = Modelica.Blocks.Types.Init;
    parameter Init init = Init.InitialState;
    parameter Start other = Start.SteadyState;
    Real x(start = 1, fixed = true);
  equation
    der(x) = -(if init == Start.SteadyState then 1 else 2)*(if other == Init.SteadyState then 3 else 5);
  end Choosing;

  expandable connector CellBus
    Real v;
    Real T;
  end CellBus;

  expandable connector StackBus
    parameter Integer n = 1;
    CellBus cell[n];
  end StackBus;

  model Cell
    parameter Real k;
    CellBus bus;
    Modelica.Blocks.Sources.Constant v(k = k);
    Modelica.Blocks.Sources.Constant T(k = 100*k);
    Modelica.Thermal.HeatTransfer.Components.HeatCapacitor heat(C = k, T(start = 1, fixed = true));
  equation
    connect(v.y, bus.v);
    connect(T.y, bus.T);
  end Cell;

  model Watch "reads an array of buses as a whole, and members of one in an expression"
    StackBus bus(n = 2);
    Modelica.Blocks.Math.Gain gain[2](each k = 10);
    Real x(start = 1, fixed = true);
  equation
    connect(bus.cell.v, gain.u);
    der(x) = sum(gain.y) + sum(bus.cell.v) + bus.cell[2].T;
  end Watch;

  model Stack "arrays of buses; a matrix of ports for which a class of the library has a list"
    Cell cell[2](k = {1, 2});
    StackBus bus(n = 2);
    Watch watch;
    Modelica.Thermal.HeatTransfer.Components.ThermalCollectorMatrix all(Ns = 1, Np = 2);
    Modelica.Thermal.HeatTransfer.Sources.FixedHeatFlow source(Q_flow = 6);
    Modelica.Thermal.HeatTransfer.Interfaces.HeatPort_a port[1, 2];
  equation
    connect(cell.bus, bus.cell);
    connect(bus, watch.bus);
    connect(cell[1].heat.port, port[1, 1]);
    connect(cell[2].heat.port, port[1, 2]);
    connect(port, all.port_a);
    connect(source.port, all.port_b);
  end Stack;

  partial function Function
    input Real x;
    output Real y;
  end Function;

  function monomial
    extends Function;
    input Real k = 1;
    input Integer n = 2;
  algorithm
    y := k*x^n;
  end monomial;

  function trapezoid "a function that has a function as argument"
    input Function f;
    input Real a, b;
    output Real s;
  algorithm
    s := (b - a)*(f(a) + f(b))/2;
  end trapezoid;

  function twice "passes it on"
    input Function f;
    output Real s = 2*trapezoid(function f(), 0, 3);
  end twice;

  operator record Vec
    Real x;
    Real y;
    encapsulated operator function '*' "of a number and a record, without a constructor of numbers"
      import Idioms.Vec;
      input Real k;
      input Vec a;
      output Vec c;
    algorithm
      c := Vec(k*a.x, k*a.y);
    end '*';
  end Vec;

  model Functions
    Vec v(x(start = 1, fixed = true), y(start = 1, fixed = true));
    Vec d = 2*v;
    Real w[3] = skew({1, 2, 3})*{v.x, 1, 1} + outerProduct({1, 0, 0}, {5, 6, 7})*{1, 1, 0};
  equation
    der(v.x) = d.x + trapezoid(monomial, 1, 2) + twice(function monomial(k = 5, n = 1));
    der(v.y) = w[1] + 10*Modelica.Math.Vectors.norm({3, 4});
  end Functions;

  model Starting "some elements are fixed, others not; an algorithm begins with starts"
    Real x[2](start = {4, 2}, fixed = {true, false});
    Real s(start = 10);
  initial equation
    der(x[2]) = 0;
  algorithm
    s := s + x[1];
  equation
    der(x) = {s, 3 - x[2]};
  end Starting;

  function inRange "only asserts"
    input Real x;
    input Real most = 10;
  algorithm
    assert(x < most, "x is too large");
  end inRange;

  model Buttons "a function as a statement; the size of an array of the library is that of its value"
    parameter Real k = 3;
    Modelica.Blocks.Sources.RadioButtonSource start(reset = {stop.on}, buttonTimeTable = {1, 3});
    Modelica.Blocks.Sources.RadioButtonSource stop(reset = {start.on, late.on}, buttonTimeTable = {2});
    Modelica.Blocks.Sources.RadioButtonSource late(reset = {false}, buttonTimeTable = {4});
    Real x(start = 1, fixed = true);
  initial equation
    inRange(k);
  equation
    inRange(k, 4);
    der(x) = -k*x;
  end Buttons;

  model Guarded "a division by zero in a branch that parameters rule out"
    parameter Real least = 0;
    constant Real none = 0;
    Real x = if least > 0 then time/none else y;
    Real y(start = 1, fixed = true);
  equation
    der(y) = -y;
  end Guarded;

  model Counting "an algorithm is one unit: later statements see what earlier ones have set at the same instant"
    Integer n(start = 0, fixed = true), m(start = 0, fixed = true), both[2](each start = 0, each fixed = true);
    Boolean late(start = false, fixed = true);
  algorithm
    late := time > 0.65;
    when sample(0.1, 0.1) then
      n := n + 1;
      both[1] := n;
    end when;
    when sample(0.2, 0.2) then
      m := n;
      both[2] := if late then 10 else 20;
    end when;
    when n >= 4 then
      n := 0;
    elsewhen time > 0.55 then
      n := 10*n;
      late := true;
    end when;
  end Counting;

  model Branch "Inflows from the side, of which there may be none; names that begin with an underscore"
    extends Modelica.Blocks.Icons.Block;
    connector Inflow
      input Real q;
    end Inflow;
    parameter Integer n = 0;
    parameter Real area "without a value";
    parameter Real map[n, 2] = fill(0.5, n, 2);
    Inflow side[n];
    Real x(nominal = area);
  protected
    Real[2] _spread = {3.0, 4.0} .+ transpose(map)*side.q;
    Real _weight = 10;
  equation
    der(x) = sum(side.q) + _weight*_spread[2]/area;
  end Branch;

  model All
    Buttons buttons;
    Starting starting;
    Functions functions;
    Stack stack;
    Guarded guarded;
    Choosing choosing(init = Modelica.Blocks.Types.Init.SteadyState);
    Voltages voltages;
    Matrices matrices;
    Piping piping;
    Lines lines;
    Drive direct;
    Drive rotating(redeclare package System = Rotating);
    Controlled controlled;
    Free free;
    Population population;
    Tank tank;
    Fast fast;
    Redeclared redeclared;
    Branch branch(area = 2);
  end All;
end Idioms;
