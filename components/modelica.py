"""Where the classes of the Modelica Standard Library 4.1.0 are found here, and which there are.

`CATALOG` lists the library's own packages of our domains, whether a class is covered or not; the loader of netlists
and the table of coverage read it.
"""

_BLOCKS = "Modelica.Blocks"
_ANALOG = "Modelica.Electrical.Analog"
_TRANSLATIONAL = "Modelica.Mechanics.Translational"
_ROTATIONAL = "Modelica.Mechanics.Rotational"
_HEAT = "Modelica.Thermal.HeatTransfer"
_FLUID = "Modelica.Thermal.FluidHeatFlow"
_FLUX = "Modelica.Magnetic.FluxTubes"

_SCALE = (
    "ToKelvin",
    "FromKelvin",
    "FixedTemperature",
    "PrescribedTemperature",
    "TemperatureSensor",
)


def _words(text: str) -> tuple[str, ...]:
    return tuple(text.split())


CATALOG: dict[str, tuple[str, tuple[str, ...]]] = {
    f"{_TRANSLATIONAL}.Components": (
        "translational",
        _words(
            "Fixed Mass Rod Spring Damper SpringDamper ElastoGap SupportFriction Brake IdealGearR2T "
            "IdealRollingWheel RollingResistance Vehicle InitializeFlange MassWithStopAndFriction "
            "RelativeStates GeneralForceToPositionAdaptor GeneralPositionToForceAdaptor"
        ),
    ),
    f"{_TRANSLATIONAL}.Sensors": (
        "translational",
        _words(
            "PositionSensor SpeedSensor AccSensor RelPositionSensor RelSpeedSensor RelAccSensor "
            "ForceSensor PowerSensor MultiSensor"
        ),
    ),
    f"{_TRANSLATIONAL}.Sources": (
        "translational",
        _words(
            "Position Speed Accelerate Move Force Force2 InverseSpeedDependentForce "
            "LinearSpeedDependentForce QuadraticSpeedDependentForce ConstantForce SignForce "
            "ConstantSpeed ForceStep EddyCurrentForce"
        ),
    ),
    f"{_TRANSLATIONAL}.Interfaces": (
        "translational",
        _words(
            "Flange Flange_a Flange_b Support InternalSupport PartialTwoFlanges "
            "PartialOneFlangeAndSupport PartialTwoFlangesAndSupport PartialRigid PartialCompliant "
            "PartialCompliantWithRelativeStates PartialElementaryOneFlangeAndSupport2 "
            "PartialElementaryTwoFlangesAndSupport2 PartialElementaryRotationalToTranslational "
            "PartialForce PartialAbsoluteSensor PartialRelativeSensor PartialFriction"
        ),
    ),
    f"{_TRANSLATIONAL}.Examples.Utilities": (
        "translational.utilities",
        _words("DirectMass InverseMass Spring SpringDamper SpringDamperNoRelativeStates"),
    ),
    f"{_ROTATIONAL}.Components": (
        "rotational",
        _words(
            "Fixed Inertia Disc Coupling Spring Damper SpringDamper ElastoBacklash ElastoBacklash2 "
            "BearingFriction Brake Clutch OneWayClutch IdealGear LossyGear IdealPlanetary Gearbox "
            "IdealGearR2T IdealRollingWheel InitializeFlange RelativeStates TorqueToAngleAdaptor "
            "AngleToTorqueAdaptor GeneralAngleToTorqueAdaptor GeneralTorqueToAngleAdaptor"
        ),
    ),
    f"{_ROTATIONAL}.Sensors": (
        "rotational",
        _words(
            "AngleSensor SpeedSensor AccSensor RelAngleSensor RelSpeedSensor RelAccSensor "
            "TorqueSensor PowerSensor MultiSensor"
        ),
    ),
    f"{_ROTATIONAL}.Sources": (
        "rotational",
        _words(
            "Position Speed Accelerate Move Torque Torque2 InverseSpeedDependentTorque "
            "LinearSpeedDependentTorque QuadraticSpeedDependentTorque ConstantTorque SignTorque "
            "ConstantSpeed TorqueStep EddyCurrentTorque"
        ),
    ),
    f"{_ROTATIONAL}.Interfaces": (
        "rotational",
        _words(
            "Flange Flange_a Flange_b Support InternalSupport PartialTwoFlanges "
            "PartialOneFlangeAndSupport PartialTwoFlangesAndSupport PartialCompliant "
            "PartialCompliantWithRelativeStates PartialElementaryOneFlangeAndSupport2 "
            "PartialElementaryTwoFlangesAndSupport2 PartialElementaryRotationalToTranslational "
            "PartialTorque PartialAbsoluteSensor PartialRelativeSensor PartialFriction"
        ),
    ),
    f"{_ROTATIONAL}.Examples.Utilities": (
        "rotational.utilities",
        _words("DirectInertia InverseInertia Spring SpringDamper SpringDamperNoRelativeStates"),
    ),
    f"{_ANALOG}.Basic": (
        "electrical",
        _words(
            "Ground Resistor Conductor Capacitor Inductor SaturatingInductor Transformer "
            "M_Transformer Gyrator RotationalEMF TranslationalEMF VCV VCC CCV CCC OpAmp "
            "OpAmpDetailed VariableResistor VariableConductor VariableCapacitor VariableInductor "
            "Potentiometer GeneralCurrentToVoltageAdaptor GeneralVoltageToCurrentAdaptor"
        ),
    ),
    f"{_ANALOG}.Ideal": (
        "electrical",
        _words(
            "IdealDiode IdealThyristor IdealGTOThyristor IdealTwoWaySwitch IdealIntermediateSwitch "
            "ControlledIdealTwoWaySwitch ControlledIdealIntermediateSwitch IdealOpAmp "
            "IdealOpAmp3Pin IdealOpAmpLimited IdealizedOpAmpLimited IdealTransformer Idle Short "
            "IdealOpeningSwitch IdealClosingSwitch ControlledIdealOpeningSwitch "
            "ControlledIdealClosingSwitch OpenerWithArc CloserWithArc ControlledOpenerWithArc "
            "ControlledCloserWithArc IdealTriac AD_Converter DA_Converter"
        ),
    ),
    f"{_ANALOG}.Semiconductors": (
        "electrical",
        _words("Diode Diode2 ZDiode NMOS PMOS NPN PNP Thyristor SimpleTriac"),
    ),
    f"{_ANALOG}.Examples.Utilities": (
        "electrical.utilities",
        _words(
            "Nand NonlinearResistor Transistor DirectCapacitor InverseCapacitor Resistor "
            "DirectInductor InverseInductor Conductor"
        ),
    ),
    f"{_ANALOG}.Sensors": (
        "electrical",
        _words("PotentialSensor VoltageSensor CurrentSensor PowerSensor MultiSensor"),
    ),
    f"{_ANALOG}.Sources": (
        "electrical",
        _words(
            "SignalVoltage ConstantVoltage StepVoltage RampVoltage SineVoltage CosineVoltage "
            "SineVoltageVariableFrequencyAndAmplitude CosineVoltageVariableFrequencyAndAmplitude "
            "ExpSineVoltage ExponentialsVoltage PulseVoltage SawToothVoltage TrapezoidVoltage "
            "LightningImpulseVoltage TableVoltage SupplyVoltage SignalCurrent ConstantCurrent "
            "StepCurrent RampCurrent SineCurrent CosineCurrent "
            "SineCurrentVariableFrequencyAndAmplitude CosineCurrentVariableFrequencyAndAmplitude "
            "ExpSineCurrent ExponentialsCurrent PulseCurrent SawToothCurrent TrapezoidCurrent "
            "LightningImpulseCurrent TableCurrent LightningImpulse DCPowerSupply"
        ),
    ),
    f"{_ANALOG}.Lines": ("electrical", _words("OLine M_OLine ULine TLine TLine1 TLine2 TLine3")),
    f"{_ANALOG}.Interfaces": (
        "electrical",
        _words(
            "Pin PositivePin NegativePin TwoPin OnePort FourPin TwoPort ConditionalHeatPort "
            "PartialConditionalHeatPort AbsoluteSensor RelativeSensor VoltageSource CurrentSource "
            "IdealSemiconductor IdealSwitch IdealSwitchWithArc"
        ),
    ),
    f"{_ANALOG}.Examples.OpAmps.OpAmpCircuits": (
        "electrical.op_amp_circuits",
        _words("PartialOpAmp Buffer Gain Add Feedback Der Integrator FirstOrder Derivative PI"),
    ),
    f"{_HEAT}.Components": (
        "thermal",
        _words(
            "HeatCapacitor ThermalConductor ThermalResistor Convection ConvectiveResistor "
            "BodyRadiation ThermalCollector ThermalCollectorMatrix "
            "GeneralHeatFlowToTemperatureAdaptor GeneralTemperatureToHeatFlowAdaptor"
        ),
    ),
    f"{_HEAT}.Sensors": (
        "thermal",
        _words(
            "TemperatureSensor RelTemperatureSensor HeatFlowSensor ConditionalFixedHeatFlowSensor"
        ),
    ),
    f"{_HEAT}.Sources": (
        "thermal",
        _words("FixedTemperature PrescribedTemperature FixedHeatFlow PrescribedHeatFlow"),
    ),
    f"{_HEAT}.Celsius": ("thermal.celsius", _SCALE),
    f"{_HEAT}.Fahrenheit": ("thermal.fahrenheit", _SCALE),
    f"{_HEAT}.Rankine": ("thermal.rankine", _SCALE),
    f"{_HEAT}.Examples.Utilities": (
        "thermal",
        _words("DirectCapacity InverseCapacity Conduction"),
    ),
    f"{_HEAT}.Interfaces": (
        "thermal",
        _words(
            "HeatPort HeatPort_a HeatPort_b Element1D PartialElementaryConditionalHeatPort "
            "PartialElementaryConditionalHeatPortWithoutT PartialConditionalHeatPort"
        ),
    ),
    f"{_FLUID}.Components": ("fluid", _words("Pipe Valve OpenTank Cylinder OneWayValve")),
    f"{_FLUID}.Sensors": (
        "fluid",
        _words(
            "PressureSensor TemperatureSensor RelPressureSensor RelTemperatureSensor MassFlowSensor "
            "VolumeFlowSensor EnthalpyFlowSensor"
        ),
    ),
    f"{_FLUID}.Sources": (
        "fluid",
        _words("Ambient AbsolutePressure VolumeFlow PressureIncrease IdealPump"),
    ),
    f"{_FLUID}.Media": (
        "fluid",
        _words(
            "Medium Air_30degC Air_70degC Water_10degC Water Water_90degC Gylcol20_20degC "
            "Gylcol50_20degC MineralOil"
        ),
    ),
    f"{_FLUID}.Interfaces": (
        "fluid",
        _words("FlowPort FlowPort_a FlowPort_b AbsoluteSensor RelativeSensor FlowSensor"),
    ),
    f"{_FLUID}.Examples.Utilities": ("fluid", _words("DoubleRamp")),
    f"{_FLUID}.BaseClasses": (
        "fluid",
        _words("SinglePortLeft SinglePortBottom TwoPort SimpleFriction"),
    ),
    f"{_FLUX}.Basic": (
        "magnetic",
        _words(
            "Ground ElectroMagneticConverter ElectroMagneticConverterWithLeakageInductance "
            "ConstantReluctance ConstantPermeance VariableReluctance VariablePermeance "
            "LeakageWithCoefficient EddyCurrent Idle Short Crossing"
        ),
    ),
    f"{_FLUX}.Shapes.FixedShape": (
        "magnetic",
        _words(
            "GenericFluxTube Cuboid HollowCylinderAxialFlux HollowCylinderRadialFlux "
            "HollowCylinderCircumferentialFlux Toroid"
        ),
    ),
    f"{_FLUX}.Shapes.Force": (
        "magnetic.force",
        _words(
            "HollowCylinderAxialFlux HollowCylinderRadialFlux CuboidParallelFlux "
            "CuboidOrthogonalFlux LeakageAroundPoles"
        ),
    ),
    f"{_FLUX}.Shapes.Leakage": (
        "magnetic.leakage",
        _words(
            "QuarterCylinder QuarterHollowCylinder HalfCylinder HalfHollowCylinder QuarterSphere "
            "QuarterHollowSphere EighthOfSphere EighthOfHollowSphere CoaxCylindersEndFaces"
        ),
    ),
    f"{_FLUX}.Shapes.HysteresisAndMagnets": (
        "magnetic",
        _words(
            "GenericLinearPermanentMagnet GenericHystTellinenSoft GenericHystTellinenHard "
            "GenericHystTellinenPermanentMagnet GenericHystTellinenTable GenericHystTellinenEverett "
            "GenericHystPreisachEverett"
        ),
    ),
    f"{_FLUX}.Sources": (
        "magnetic",
        _words(
            "ConstantMagneticPotentialDifference SignalMagneticPotentialDifference "
            "ConstantMagneticFlux SignalMagneticFlux"
        ),
    ),
    f"{_FLUX}.Sensors": (
        "magnetic",
        _words("MagneticPotentialDifferenceSensor MagneticFluxSensor"),
    ),
    f"{_FLUX}.Interfaces": (
        "magnetic",
        _words(
            "MagneticPort PositiveMagneticPort NegativeMagneticPort TwoPortElementary "
            "TwoPortExtended TwoPort ConditionalHeatPort"
        ),
    ),
    f"{_FLUX}.Material.SoftMagnetic.Steel": (
        "magnetic",
        _words("Steel_9SMnPb28 Steel_9SMn28K DC01 DC03 X6Cr17 AISI_1008 AISI_12L14"),
    ),
    f"{_FLUX}.Material.SoftMagnetic.ElectricSheet": (
        "magnetic",
        _words("M330_50A M350_50A M530_50A M700_100A M940_100A"),
    ),
    f"{_FLUX}.Material.SoftMagnetic.PureIron": ("magnetic", _words("RFe80 VacoferS2")),
    f"{_FLUX}.Material.SoftMagnetic.CobaltIron": ("magnetic", _words("Vacoflux50")),
    f"{_FLUX}.Material.SoftMagnetic.NickelIron": ("magnetic", _words("MuMetall Permenorm3601K3")),
    f"{_FLUX}.Material.HardMagnetic": (
        "magnetic.hard_magnetic",
        _words("HardFerrite NdFeB Sm2Co17 SmCo5 PlasticHardFerrite PlasticNdFeB PlasticSmCo"),
    ),
    f"{_BLOCKS}.Sources": (
        "blocks",
        _words(
            "RealExpression IntegerExpression BooleanExpression ContinuousClock Constant Step Ramp "
            "Sine Cosine SineVariableFrequencyAndAmplitude CosineVariableFrequencyAndAmplitude Sinc "
            "ExpSine Exponentials Pulse SawTooth Trapezoid LogFrequencySweep KinematicPTP "
            "KinematicPTP2 TimeTable CombiTimeTable BooleanConstant BooleanStep BooleanPulse "
            "SampleTrigger BooleanTable RadioButtonSource IntegerConstant IntegerStep IntegerTable"
        ),
    ),
    f"{_BLOCKS}.Math": (
        "blocks",
        _words(
            "InverseBlockConstraints Gain MatrixGain MultiSum MultiProduct MultiSwitch Sum Feedback "
            "Add Add3 Product Division Abs Sign Sqrt Sin Cos Tan Asin Acos Atan Atan2 Sinh Cosh "
            "Tanh Exp Exponentiation Power Log Log10 WrapAngle RealToInteger IntegerToReal "
            "BooleanToReal BooleanToInteger RealToBoolean IntegerToBoolean RectangularToPolar "
            "PolarToRectangular Mean RectifiedMean ContinuousMean RootMeanSquare Variance "
            "StandardDeviation Harmonic TotalHarmonicDistortion RealFFT Pythagoras Max Min MinMax "
            "LinearDependency Edge BooleanChange IntegerChange SignalExtrema "
            "ContinuousSignalExtrema"
        ),
    ),
    f"{_BLOCKS}.Math.UnitConversions": (
        "blocks",
        _words(
            "To_degC From_degC To_degF From_degF To_degRk From_degRk To_deg From_deg To_rpm "
            "From_rpm To_kmh From_kmh To_day From_day To_hour From_hour To_minute From_minute "
            "To_litre From_litre To_kWh From_kWh To_bar From_bar To_gps From_gps"
        ),
    ),
    f"{_BLOCKS}.Continuous": (
        "blocks",
        _words(
            "Integrator LimIntegrator Derivative FirstOrder SecondOrder PI PID LimPID "
            "TransferFunction StateSpace Der LowpassButterworth CriticalDamping Filter"
        ),
    ),
    f"{_BLOCKS}.Nonlinear": (
        "blocks",
        _words(
            "Limiter VariableLimiter SlewRateLimiter DeadZone FixedDelay PadeDelay VariableDelay"
        ),
    ),
    f"{_BLOCKS}.Logical": (
        "blocks",
        _words(
            "And Or Xor Nor Nand Not Pre Edge FallingEdge Change GreaterThreshold "
            "GreaterEqualThreshold LessThreshold LessEqualThreshold Greater GreaterEqual Less "
            "LessEqual ZeroCrossing LogicalSwitch Switch Hysteresis OnOffController "
            "TriggeredTrapezoid Timer LogicalDelay RSFlipFlop TerminateSimulation AssertCondition"
        ),
    ),
    f"{_BLOCKS}.Tables": (
        "blocks",
        _words("CombiTable1Ds CombiTable1Dv CombiTable2Ds CombiTable2Dv"),
    ),
    f"{_BLOCKS}.Routing": (
        "blocks",
        _words(
            "Replicator IntegerReplicator BooleanReplicator ExtractSignal Extractor Multiplex "
            "Multiplex2 Multiplex3 Multiplex4 Multiplex5 Multiplex6 DeMultiplex DeMultiplex2 "
            "DeMultiplex3 DeMultiplex4 DeMultiplex5 DeMultiplex6 RealPassThrough "
            "IntegerPassThrough BooleanPassThrough"
        ),
    ),
    f"{_BLOCKS}.Discrete": (
        "blocks.discrete",
        _words(
            "Sampler ZeroOrderHold FirstOrderHold UnitDelay TransferFunction StateSpace "
            "TriggeredSampler TriggeredMax"
        ),
    ),
    f"{_BLOCKS}.Interfaces": (
        "blocks",
        _words(
            "RealInput RealOutput BooleanInput BooleanOutput IntegerInput IntegerOutput "
            "RealVectorInput IntegerVectorInput BooleanVectorInput RealVectorOutput SO MO SISO SI2SO "
            "SIMO MISO PartialRealMISO MIMO MIMOs MI2MO SignalSource SVcontrol MVcontrol "
            "DiscreteBlock DiscreteSISO DiscreteMIMO DiscreteMIMOs SVdiscrete MVdiscrete "
            "BooleanSISO BooleanMIMOs MI2BooleanMOs SI2BooleanSO BooleanSignalSource IntegerSO "
            "IntegerMO IntegerSignalSource IntegerSIBooleanSO IntegerMIBooleanMOs PartialIntegerSISO "
            "PartialIntegerMISO partialBooleanSISO partialBooleanSI2SO partialBooleanSI3SO "
            "partialBooleanSI partialBooleanSO partialBooleanSource "
            "partialBooleanThresholdComparison partialBooleanComparison PartialBooleanSISO_small "
            "PartialBooleanMISO PartialConversionBlock PartialNoise"
        ),
    ),
}
"""Package of the Modelica Standard Library -> (module below `acausal.components`, names of its public classes)."""

ENUMERATIONS: tuple[str, ...] = (
    "AnalogFilter",
    "Extrapolation",
    "FilterType",
    "ImpulseApproximation",
    "Init",
    "LimiterHomotopy",
    "Regularization",
    "SimpleController",
    "Smoothness",
    "StateSelect",
    "TimeEvents",
    "VariableLimiterHomotopy",
)
"""Types whose values are written as a text, the last word of their name: ``Types.Init.SteadyState``."""
