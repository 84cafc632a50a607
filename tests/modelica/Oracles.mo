package Oracles "Ten of the reference models, written by hand; the files of ../shared/oracles have the same as netlists"
  import Modelica.Blocks.Sources;
  import Modelica.Units.SI;

  package T
    extends Modelica.Icons.Package;
    import Modelica.Mechanics.Translational.Components.*;
    import Modelica.Mechanics.Translational.Sources.Force;

    model Start = Mass(L = 1, m = 1, s(start = -0.5, fixed = true), v(start = 0, fixed = true));

    model Translational_SignConvention
      Mass mass1(L = 1, m = 1, s(fixed = true), v(fixed = true)), mass2(L = 1, m = 1, s(fixed = true), v(fixed = true)),
        mass3(L = 1, m = 1, s(fixed = true), v(fixed = true));
      Force force1, force2, force3;
      Sources.Constant constant1(k = 1), constant2(k = 1), constant3(k = 1);
      Fixed fixed;
    equation
      connect(constant1.y, force1.f);
      connect(constant2.y, force2.f);
      connect(constant3.y, force3.f);
      connect(force1.flange, mass1.flange_a);
      connect(force2.flange, mass2.flange_b);
      connect(mass3.flange_b, force3.flange);
    end Translational_SignConvention;

    partial model Braked
      parameter SI.TranslationalDampingConstant d = 25;
      parameter SI.Position wall = 4.5;
      Mass mass1(L = 2, m = 1, s(start = 3, fixed = true), v(start = 10, fixed = true));
      Fixed fixed1(s0 = wall);
    end Braked;

    model Translational_Damper
      extends Braked(mass1.L = 1);
      Damper damper1(d = d), damper2(d = d);
      replaceable Mass mass2(L = 1, m = 1, s(start = 3, fixed = true), v(start = 10, fixed = true)) constrainedby Mass;
      Mass mass3(L = 1, m = 1, s(start = 3, fixed = true), v(start = 10, fixed = true));
      Fixed fixed2(s0 = wall), fixed3(s0 = wall);
      Spring spring2(s_rel0 = 1, c = 1);
      SpringDamper springDamper3(s_rel0 = 1, d = d, c = spring2.c);
    equation
      connect(mass1.flange_b, damper1.flange_a);
      connect(damper1.flange_b, fixed1.flange);
      connect(mass2.flange_b, damper2.flange_a);
      connect(damper2.flange_a, spring2.flange_a);
      connect(damper2.flange_b, spring2.flange_b);
      connect(damper2.flange_b, fixed2.flange);
      connect(mass3.flange_b, springDamper3.flange_a);
      connect(springDamper3.flange_b, fixed3.flange);
    end Translational_Damper;

    model Translational_Oscillator
      constant Real f = 15.9155;
      Start mass1, mass2;
      Spring spring1(s_rel0 = 1, c = 1e4), spring2(s_rel0 = 1, c = 1e4);
      Fixed fixed1(s0 = 1), fixed2(s0 = 1);
      Damper damper1(d = 10);
      Force force1(f = amplitude*sin(2*Modelica.Constants.pi*f*time)), force2(f = force1.f);
      parameter SI.Force amplitude = 1;
    equation
      connect(force1.flange, mass1.flange_a);
      connect(mass1.flange_b, spring1.flange_a);
      connect(spring1.flange_b, fixed1.flange);
      connect(force2.flange, mass2.flange_a);
      connect(mass2.flange_b, spring2.flange_a);
      connect(mass2.flange_b, damper1.flange_a);
      connect(damper1.flange_b, spring2.flange_b);
      connect(spring2.flange_b, fixed2.flange);
    end Translational_Oscillator;

    model Translational_ElastoGap
      parameter SI.TranslationalDampingConstant d = 1.5;
      parameter SI.TranslationalSpringConstant c = 10;
      Fixed fixed;
      Rod rod1(L = 2), rod2(L = 2);
      SpringDamper springDamper1(c = c, d = d, s_rel0 = 1, s_rel(start = 1)), springDamper2(c = c, d = d, s_rel0 = 1,
        s_rel(start = 1));
      ElastoGap elastoGap1(c = c, d = d, s_rel0 = 1.5, s_rel(start = 1.5)), elastoGap2(c = c, d = d, s_rel0 = 1.5,
        s_rel(start = 1.5));
      Mass mass1(m = 1, s(start = 2, fixed = true), v(fixed = true)), mass2(m = 1, s = mass2_start, v(fixed = true));
      SI.Position mass2_start(start = 2, fixed = true);
    equation
      connect(rod1.flange_b, fixed.flange);
      connect(fixed.flange, rod2.flange_a);
      connect(springDamper1.flange_a, rod1.flange_a);
      connect(springDamper2.flange_b, rod2.flange_b);
      connect(springDamper1.flange_b, mass1.flange_a);
      connect(mass1.flange_b, springDamper2.flange_a);
      connect(rod1.flange_a, elastoGap1.flange_a);
      connect(rod2.flange_b, elastoGap2.flange_b);
      connect(elastoGap1.flange_b, mass2.flange_a);
      connect(mass2.flange_b, elastoGap2.flange_a);
    end Translational_ElastoGap;
  end T;

  package R
    import Modelica.Mechanics.Rotational.Components;
    import Modelica.Mechanics.Rotational.Sources.Torque;

    record Data
      parameter SI.Inertia Jmotor = 0.1, Jload = 2;
      parameter Real ratio = 10;
      parameter SI.RotationalDampingConstant damping = 10;
    end Data;

    model Rotational_First
      parameter Boolean supported = true;
      parameter Data data;
      parameter Real amplitude = 10;
      parameter SI.Frequency f = 5;
      Components.Fixed fixed;
      Torque torque(useSupport = supported);
      Components.Inertia inertia1(J = data.Jmotor), inertia2(J = 2, phi(fixed = true, start = 0), w(fixed = true)),
        inertia3(J = data.Jload, w(fixed = true, start = 0));
      Components.IdealGear idealGear(ratio = data.ratio, useSupport = supported);
      Components.Spring spring(c = 1e4, phi_rel(fixed = true));
      Components.Damper damper(d = data.damping);
      Sources.Sine sine(amplitude = amplitude, f = f);
    equation
      connect(inertia1.flange_b, idealGear.flange_a);
      connect(idealGear.flange_b, inertia2.flange_a);
      connect(inertia2.flange_b, spring.flange_a);
      connect(spring.flange_b, inertia3.flange_a);
      connect(damper.flange_a, inertia2.flange_b);
      connect(damper.flange_b, fixed.flange);
      connect(sine.y, torque.tau);
      connect(torque.flange, inertia1.flange_a);
      if supported then
        connect(torque.support, fixed.flange);
        connect(idealGear.support, fixed.flange);
      end if;
    end Rotational_First;

    model Rotational_FirstGrounded = Rotational_First(supported = false);
  end R;

  model HeatTransfer_TwoMasses
    parameter SI.Temperature T_final_K(fixed = false) "of both";
    Modelica.Thermal.HeatTransfer.Components.HeatCapacitor mass[2](each C = 15, T(start = {373.15, 273.15}, each fixed = true));
    Modelica.Thermal.HeatTransfer.Components.ThermalConductor conduction(G = 10);
    Modelica.Thermal.HeatTransfer.Celsius.TemperatureSensor Tsensor[2];
  initial equation
    T_final_K = mass.T*mass.C/sum(mass.C);
  equation
    connect(mass[1].port, conduction.port_a);
    connect(conduction.port_b, mass[2].port);
    connect(mass.port, Tsensor.port);
  end HeatTransfer_TwoMasses;

  package E
    import Modelica.Electrical.Analog.Basic.*;

    model Analog_CauerLowPassAnalog
      import Modelica.Electrical.Analog.Basic.{Capacitor, Inductor, Resistor, Ground};
      parameter SI.Inductance l[2] = {1.304, 0.8586};
      parameter SI.Capacitance c1 = 1.072, c3 = 1.682, c5 = 0.7262, c2 = 1/(1.704992^2*l[1]), c4 = 1/(1.179945^2*l[2]);
      Ground G;
      Capacitor C1(C = c1, v(start = 0, fixed = true)), C2(C = c2), C3(C = c3, v(start = 0, fixed = true)), C4(C = c4),
        C5(C = c5, v(start = 0, fixed = true));
      Inductor L1(L = l[1], i(start = 0, fixed = true)), L2(L = l[2], i(start = 0, fixed = true));
      Resistor R1(R = 1), R2(R = 1);
      Modelica.Electrical.Analog.Sources.StepVoltage V(startTime = 1, V = 1);
    equation
      connect(V.p, R1.p);
      connect(R1.n, C1.p);
      connect(R1.n, L1.p);
      connect(L1.p, C2.p);
      connect(L1.n, C2.n);
      connect(L1.n, C3.p);
      connect(L1.n, L2.p);
      connect(L2.p, C4.p);
      connect(L2.n, C4.n);
      connect(L2.n, C5.p);
      connect(L2.n, R2.p);
      connect(G.p, C1.n);
      connect(G.p, C3.n);
      connect(G.p, C5.n);
      connect(G.p, R2.n);
      connect(G.p, V.n);
    end Analog_CauerLowPassAnalog;

    model Analog_ShowVariableResistor
      parameter Integer n = 5;
      Modelica.Electrical.Analog.Basic.Resistor R[n](each R = 1);
      Modelica.Electrical.Analog.Basic.VariableResistor VariableResistor(R = ramp.y);
      Modelica.Electrical.Analog.Basic.Ground ground;
      Modelica.Electrical.Analog.Sources.SineVoltage SineVoltage1(V = 1, f = 1);
      Sources.Ramp ramp(height = 5, offset = 2, duration = 2);
    equation
      for i in 1:2 loop
        connect(R[i].n, R[i + 1].p);
      end for;
      connect(R[4].n, VariableResistor.p);
      connect(VariableResistor.n, R[5].p);
      connect(SineVoltage1.n, R[1].p);
      connect(SineVoltage1.n, R[4].p);
      connect(SineVoltage1.p, ground.p);
      connect(ground.p, R[3].n);
      connect(ground.p, R[5].n);
    end Analog_ShowVariableResistor;
  end E;

  model Rotational_ElasticBearing
    import R = Modelica.Mechanics.Rotational;
    R.Components.Inertia shaft(J = 1, phi(fixed = true), w(fixed = true)), load(J = 50, w(fixed = true)), housing(J = 5);
    R.Components.Spring spring(c = 1000, phi_rel(fixed = true));
    R.Components.Fixed fixed;
    R.Components.SpringDamper springDamper(c = 1e5, d = 5, phi_rel(fixed = true), w_rel(fixed = true, nominal = 1e-4));
    R.Sources.Torque torque(useSupport = true);
    Sources.Ramp ramp(duration = 5, height = 100);
    R.Components.IdealGear idealGear(ratio = 3, useSupport = true);
  equation
    connect(torque.flange, shaft.flange_a);
    connect(torque.support, fixed.flange);
    connect(ramp.y, torque.tau);
    connect(shaft.flange_b, idealGear.flange_a);
    connect(idealGear.flange_b, spring.flange_a);
    connect(spring.flange_b, load.flange_a);
    connect(idealGear.support, housing.flange_b);
    connect(housing.flange_a, springDamper.flange_b);
    connect(springDamper.flange_a, fixed.flange);
  end Rotational_ElasticBearing;
end Oracles;
