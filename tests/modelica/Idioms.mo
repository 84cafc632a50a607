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

  model All
    Free free;
    Population population;
    Tank tank;
    Fast fast;
    Redeclared redeclared;
  end All;
end Idioms;
