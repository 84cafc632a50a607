"""Units of the types of `Modelica.Units.SI`, which version 3.2.3 calls `Modelica.SIunits`."""

from __future__ import annotations

from typing import Any

_NAMES = """
rad: Angle PhaseDifference LossAngle BraggAngle
sr: SolidAngle
m: Length PathLength Position Distance Breadth Height Thickness Radius Diameter Wavelength
    SoundParticleDisplacement MeanFreePath NuclearRadius ElectronRadius ComptonWavelength
    HalfThickness MeanLinearRange SlowingDownLength DiffusionLength MigrationLength
    LondonPenetrationDepth CoherenceLength
m2: Area EquivalentAbsorptionArea NuclearQuadrupoleMoment CrossSection TotalCrossSection
    AtomicAttenuationCoefficient SlowingDownArea DiffusionArea MigrationArea
m3: Volume SectionModulus
s: Time Duration Period ReverberationTime MeanLife HalfLife ReactorTimeConstant RelaxationTime
    CarrierLifeTime
rad/s: AngularVelocity AngularFrequency
rad/s2: AngularAcceleration
rad/s3: AngularJerk
m/s: Velocity SoundParticleVelocity VelocityOfSound NeutronSpeed
m/s2: Acceleration SoundParticleAcceleration
m/s3: Jerk
Hz: Frequency
m-1: WaveNumber AttenuationCoefficient PhaseCoefficient PropagationCoefficient
    LinearAttenuationCoefficient LinearAbsorptionCoefficient MacroscopicCrossSection
    TotalMacroscopicCrossSection LinearIonization CircularWavenumber FermiCircularWavenumber
    DebyeCircularWavenumber
rad/m: CircularWaveNumber
dB: AmplitudeLevelDifference PowerLevelDifference SoundPressureLevel SoundPowerLevel
    SoundReductionIndex
s-1: DampingCoefficient Damping LarmorAngularFrequency NuclearPrecessionAngularFrequency
    CyclotronAngularFrequency DecayConstant DebyeCircularFrequency
1/S: LogarithmicDecrement
kg: Mass MassOfMolecule AtomicMassConstant MassOfElectron MassOfProton MassOfNeutron MassExcess
    MassDefect EffectiveMass
kg/m3: Density MassConcentration
1: RelativeDensity Strain LinearStrain ShearStrain VolumeStrain PoissonNumber CoefficientOfFriction
    Efficiency RatioOfSpecificHeatCapacities IsentropicExponent RelativePermittivity
    ElectricSusceptibility CouplingCoefficient LeakageCoefficient RelativePermeability
    MagneticSusceptibility QualityFactor PowerFactor Emissivity SpectralEmissivity
    DirectionalSpectralEmissivity LuminousEfficiency SpectralLuminousEfficiency
    CIESpectralTristimulusValues ChromaticityCoordinates SpectralAbsorptionFactor
    SpectralReflectionFactor SpectralTransmissionFactor SpectralRadianceFactor RefractiveIndex
    DissipationCoefficient ReflectionCoefficient TransmissionCoefficient
    AcousticAbsorptionCoefficient RelativeAtomicMass RelativeMolecularMass NumberOfMolecules
    MassFraction VolumeFraction MoleFraction AbsoluteActivity StandardAbsoluteActivity
    ActivityCoefficient ActivityOfSolute ActivityCoefficientOfSolute
    StandardAbsoluteActivityOfSolute ActivityOfSolvent OsmoticCoefficientOfSolvent
    StandardAbsoluteActivityOfSolvent StoichiometricNumber StoichiometricCoefficient
    MicrocanonicalPartitionFunction CanonicalPartitionFunction GrandCanonicalPartitionFunction
    MolecularPartitionFunction StatisticalWeight ThermalDiffusionRatio ThermalDiffusionFactor
    ChargeNumberOfIon DegreeOfDissociation TransportNumberOfIonic ProtonNumber NeutronNumber
    NucleonNumber GFactorOfAtom GFactorOfNucleus RelativeMassExcess RelativeMassDefect
    PackingFraction BindingFraction TotalIonization ResonanceEscapeProbability Lethargy
    NeutronYieldPerFission NeutronYieldPerAbsorption FastFissionFactor ThermalUtilizationFactor
    NonLeakageProbability Reactivity ReynoldsNumber EulerNumber FroudeNumber GrashofNumber
    WeberNumber MachNumber KnudsenNumber StrouhalNumber FourierNumber PecletNumber RayleighNumber
    NusseltNumber BiotNumber StantonNumber FourierNumberOfMassTransfer PecletNumberOfMassTransfer
    GrashofNumberOfMassTransfer NusseltNumberOfMassTransfer StantonNumberOfMassTransfer
    PrandtlNumber SchmidtNumber LewisNumber MagneticReynoldsNumber AlfvenNumber HartmannNumber
    CowlingNumber OrderOfReflexion ShortRangeOrderParameter LongRangeOrderParameter
    DebyeWallerFactor GrueneisenParameter MadelungConstant MobilityRatio LandauGinzburgParameter
    PerUnit DimensionlessRatio
m3/kg: SpecificVolume
kg/m: LinearDensity
kg/m2: SurfaceDensity MeanMassRange
kg.m/s: Momentum
N.s: Impulse
kg.m2/s: AngularMomentum
N.m.s: AngularImpulse
kg.m2: MomentOfInertia Inertia
N: Force Weight ImpulseFlowRate MomentumFlux
N/m: TranslationalSpringConstant SurfaceTension
N.s/m: TranslationalDampingConstant MechanicalImpedance
N.m: Torque MomentOfForce AngularImpulseFlowRate AngularMomentumFlux
N.m/A: ElectricalTorqueConstant
N.m/rad: RotationalSpringConstant
N.m.s/rad: RotationalDampingConstant
Pa: Pressure AbsolutePressure PressureDifference BulkModulus Stress NormalStress ShearStress
    ModulusOfElasticity ShearModulus StaticPressure SoundPressure PartialPressure Fugacity
    OsmoticPressure
Pa/s: PressureSlope
m4: SecondMomentOfArea SecondPolarMomentOfArea
Pa.s: DynamicViscosity
m2/s: KinematicViscosity ThermalDiffusivity DiffusionCoefficient ThermalDiffusionCoefficient
J: Work Energy PotentialEnergy KineticEnergy Heat InternalEnergy Enthalpy HelmholtzFreeEnergy
    GibbsFreeEnergy RadiantEnergy HartreeEnergy LevelWidth AlphaDisintegrationEnergy
    MaximumBetaParticleEnergy BetaDisintegrationEnergy ReactionEnergy ResonanceEnergy EnergyImparted
    MeanEnergyImparted
J/m3: EnergyDensity ElectromagneticEnergyDensity RadiantEnergyDensity SoundEnergyDensity
W: Power EnergyFlowRate EnthalpyFlowRate HeatFlowRate InstantaneousPower ActivePower RadiantPower
    SoundPower
kg/s: MassFlowRate
m3/s: VolumeFlowRate RecombinationCoefficient
K: ThermodynamicTemperature Temperature TemperatureDifference DebyeTemperature FermiTemperature
    CurieTemperature NeelTemperature
K/s: TemperatureSlope
1/K: LinearTemperatureCoefficient LinearExpansionCoefficient CubicExpansionCoefficient
    RelativePressureCoefficient
1/K2: QuadraticTemperatureCoefficient
Pa/K: PressureCoefficient DerPressureByTemperature
1/Pa: Compressibility IsothermalCompressibility IsentropicCompressibility
W/m2: HeatFlux DensityOfHeatFlowRate PoyntingVector RadiantEnergyFluenceRate RadiantExitance
    Irradiance SoundIntensity EnergyFluenceRate
W/(m.K): ThermalConductivity
W/(m2.K): CoefficientOfHeatTransfer SurfaceCoefficientOfHeatTransfer
m2.K/W: ThermalInsulance
K/W: ThermalResistance
W/K: ThermalConductance
J/K: HeatCapacity Entropy MassieuFunction PlanckFunction
J/(kg.K): SpecificHeatCapacity SpecificHeatCapacityAtConstantPressure
    SpecificHeatCapacityAtConstantVolume SpecificHeatCapacityAtSaturation SpecificEntropy
J/(K.s): EntropyFlowRate
J/kg: SpecificEnergy SpecificInternalEnergy SpecificEnthalpy SpecificHelmholtzFreeEnergy
    SpecificGibbsFreeEnergy
kg.s2/m5: DerDensityByEnthalpy
s2/m2: DerDensityByPressure
kg/(m3.K): DerDensityByTemperature
J.m.s2/kg2: DerEnthalpyByPressure
J.m3/kg: DerEnergyByDensity
J.m.s2/kg: DerEnergyByPressure
Pa.m3/kg: DerPressureByDensity
A: ElectricCurrent Current MagneticPotential MagneticPotentialDifference MagnetomotiveForce
    CurrentLinkage
A/s: CurrentSlope
C: ElectricCharge Charge ElectricFlux ElementaryCharge
C/m3: VolumeDensityOfCharge
C/m2: SurfaceDensityOfCharge ElectricFluxDensity ElectricPolarization
V/m: ElectricFieldStrength Electrization
V: ElectricPotential Voltage PotentialDifference ElectromotiveForce ThermoelectromotiveForce
    PeltierCoefficient
V.s: VoltageSecond
V/s: VoltageSlope
F: Capacitance
F/m: CapacitancePerUnitLength Permittivity PermittivityOfVacuum
F/m2: CapacitancePerArea
C.m: ElectricDipoleMoment ElectricDipoleMomentOfMolecule
A/m2: CurrentDensity
A/m: LinearCurrentDensity MagneticFieldStrength Magnetization
T: MagneticFluxDensity MagneticPolarization
Wb: MagneticFlux FluxoidQuantum
Wb/m: MagneticVectorPotential
H: Inductance SelfInductance MutualInductance Permeance
H/m: InductancePerUnitLength
V.s/(A.m): Permeability PermeabilityOfVacuum
A.m2: ElectromagneticMoment MagneticMomentOfParticle BohrMagneton NuclearMagneton
Wb.m: MagneticDipoleMoment
Ohm: Resistance Impedance ModulusOfImpedance Reactance
Ohm/m: ResistancePerUnitLength ImpedancePerUnitLength ReactancePerUnitLength
Ohm.m: Resistivity ResidualResistivity
S/m: Conductivity ConductancePerUnitLength AdmittancePerUnitLength SusceptancePerUnitLength
    ElectrolyticConductivity
H-1: Reluctance
S: Conductance Admittance ModulusOfAdmittance Susceptance
V.A: ApparentPower
var: ReactivePower
Ohm/K: LinearTemperatureCoefficientResistance
Ohm/K2: QuadraticTemperatureCoefficientResistance
A/V2: Transconductance
1/V: InversePotential
N/A: ElectricalForceConstant
J/m4: SpectralRadiantEnergyDensity
W/sr: RadiantIntensity
W/(sr.m2): Radiance
cd: LuminousIntensity
lm: LuminousFlux
lm.s: QuantityOfLight
cd/m2: Luminance
lm/m2: LuminousExitance
lx: Illuminance
lx.s: LightExposure
lm/W: LuminousEfficacy SpectralLuminousEfficacy
m2/mol: MolarAbsorptionCoefficient MolarAttenuationCoefficient
Pa.s/m3: AcousticImpedance
Pa.s/m: SpecificAcousticImpedance
phon: LoudnessLevel
sone: Loudness
mol: AmountOfSubstance
mol/kg: Molality MolalConcentration IonicStrength
kg/mol: MolarMass
m3/mol: MolarVolume
mol/m3: MolarDensity Molarity MolarConcentration Concentration
J/mol: MolarEnergy MolarInternalEnergy MolarEnthalpy ChemicalPotential Affinity
J/(mol.K): MolarHeatCapacity MolarEntropy
mol/s: MolarFlowRate
m-3: NumberDensityOfMolecules MolecularConcentration IonNumberDensity NeutronNumberDensity
    ElectronNumberDensity HoleNumberDensity IntrinsicNumberDensity DonorNumberDensity
    AcceptorNumberDensity
C.m2/V: ElectricPolarizabilityOfAMolecule
C/mol: FaradayConstant
S.m2/mol: MolarConductivity
A.m2/(J.s): GyromagneticCoefficient
Bq: Activity
Bq/kg: SpecificActivity
m2/sr: AngularCrossSection
m2/J: SpectralCrossSection
m2/(sr.J): SpectralAngularCrossSection
m-2: ParticleFluence
s-1.m2: ParticleFluenceRate
J/m2: EnergyFluence
m-2.s-1: CurrentDensityOfParticles
m2/kg: MassAttenuationCoefficient MassEnergyTransferCoefficient
J/m: TotalLinearStoppingPower LinearEnergyTransfer
J.m2: TotalAtomicStoppingPower
J.m2/kg: TotalMassStoppingPower
m2/(V.s): Mobility
s-1.m-2: NeutronFluenceRate
s-1.m-3: TotalNeutronSourceDensity SlowingDownDensity
Gy: SpecificEnergyImparted AbsorbedDose Kerma
Sv: DoseEquivalent
Gy/s: AbsorbedDoseRate KermaRate
C/kg: Exposure
C/(kg.s): ExposureRate
s/m3: SpectralConcentration
J-1/m-3: DensityOfStates
V2/K2: LorenzCoefficient
m3/C: HallCoefficient
V/K: SeebeckCoefficient ThomsonCoefficient
A/(m2.K2): RichardsonConstant
eV: FermiEnergy GapEnergy DonorIonizationEnergy AcceptorIonizationEnergy ActivationEnergy
    ExchangeIntegral
1/s: TimeAging
1/(A.s): ChargeAging
degC: Temperature_degC
degF: Temperature_degF
degRk: Temperature_degRk
deg: Angle_deg
rev/min: AngularVelocity_rpm
km/h: Velocity_kmh
d: Time_day
h: Time_hour
min: Time_minute
l: Volume_litre
A.h: ElectricCharge_Ah
W.h: Energy_Wh
kW.h: Energy_kWh
bar: Pressure_bar
g/s: MassFlowRate_gps
cm2: Area_cm
1/cm2: PerArea_cm
cm2/(V.s): Area_cmPerVoltageSecond
"""
"""By unit its types; a line that is indented goes on."""

UNITS: dict[str, str] = {
    name: unit
    for unit, _, names in (line.partition(": ") for line in _NAMES.replace("\n ", " ").split("\n"))
    for name in names.split()
}
"""Name of a type -> its unit."""

ATTRIBUTES: dict[str, dict[str, Any]] = {
    "Temperature": {"start": 288.15, "nominal": 300.0},
    "ThermodynamicTemperature": {"start": 288.15, "nominal": 300.0},
    "Temp_K": {"start": 288.15, "nominal": 300.0},
    "AbsolutePressure": {"nominal": 1e5},
}
"""Attributes of types besides their unit."""
