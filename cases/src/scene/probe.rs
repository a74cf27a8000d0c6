//! `[probes.NAME]`: what is read off a solution, and where.

use super::number::Number;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// One probe: a value at a `point`, along a `line`, at a `support`, of a `switch` or of the whole model.
///
/// In a scene with `[dynamics]`, what is not read along a line gives a history: its value over time. Lines are
/// read at the end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Probe {
    /// What is read.
    pub read: Read,
    /// At a point, in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<Vec<Number>>,
    /// At stations of a line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<Line>,
    /// Reactions only: name of the support.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub support: Option<String>,
    /// `envelope-work` only: displacement up to which it is counted, in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub up_to_m: Option<Number>,
    /// Switches only: name of the switch; all of them if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub switch: Option<String>,
    /// The exact answer as a field of x, y, z, and of the time t (s) in a history: one number, or the displacement
    /// vector for `displacement-error`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub exact: Vec<Number>,
    /// Caption of the curve.
    #[serde(default)]
    pub title: String,
    /// Lines and histories only: curves of the scene with these variants, drawn beside; legend and variants.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub beside: BTreeMap<String, Vec<String>>,
    /// Half width of the band drawn around the reference, as a share of its largest value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub band: Option<f64>,
}

/// What a probe reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Read {
    /// Displacement along x, in m.
    Ux,
    /// Displacement along y, in m.
    Uy,
    /// Displacement along z, in m.
    Uz,
    /// Stress, in Pa; inside finite elements.
    Sxx,
    /// Stress, in Pa; inside finite elements.
    Syy,
    /// Stress, in Pa; inside finite elements.
    Sxy,
    /// Rotation of the line as `Δu_y/Δx` between neighbouring stations, in rad, given half-way between them.
    SecantRotation,
    /// Rotation of the cross-section as `−∂u_x/∂y` of a plane fitted to it, in rad.
    SectionRotation,
    /// Largest `|u − u_exact|` over nodes and particles, relative to the largest `|u_exact|`.
    DisplacementError,
    /// `√Σ|u − u_exact|² / √Σ|u_exact|²` over nodes and particles.
    DisplacementErrorRms,
    /// Elastic energy, in J.
    StrainEnergy,
    /// Force of a support along x, in N.
    ReactionX,
    /// Force of a support along y, in N.
    ReactionY,
    /// Force of a support along z, in N.
    ReactionZ,
    /// Run in time: kinetic energy, in J.
    KineticEnergy,
    /// Run in time: work of loads and moving supports, in J.
    ExternalWork,
    /// Run in time: energy that no entry of the balance accounts for, over the largest entry.
    EnergyClosure,
    /// Run in time: largest gap of the ties, in m; rows of mortar ties are means, rows of rotations times a length.
    Gap,
    /// Run in time: factor on the loads.
    LoadFactor,
    /// Run in time: largest tension at the rim of a bond, `F_n/A + |M| r/I` (Potyondy and Cundall 2004, eq. 14), in Pa.
    LargestBondStress,
    /// Run in time: number of particles.
    Particles,
    /// Run in time: bonds that have lost stiffness so far, each time counted.
    Losses,
    /// Run in time: energy that failing bonds have taken, in J.
    FractureWork,
    /// Run in time: energy that contacts have taken and not given back, in J.
    ContactWork,
    /// Jump of the strain energy over the energy before.
    SwitchEnergyJump,
    /// Jump of the momentum over `Σ m|v|`.
    SwitchMomentumJump,
    /// Jump of the angular momentum over `Σ m|v|` times the largest extent of the bodies.
    SwitchAngularMomentumJump,
    /// Largest jump of the force through a face of the region over the largest such force before.
    SwitchReactionJump,
    /// Unbalanced over internal forces, before the switch.
    SwitchUnbalancedBefore,
    /// Unbalanced over internal forces, as the run goes on.
    SwitchUnbalancedAfter,
    /// Time of the (last) switch, in s.
    SwitchTime,
    /// Share of all switches together in the wall time. Not deterministic.
    SwitchShareOfTime,
    /// Smallest x of all particles at the end, in m.
    RegionMinX,
    /// Largest x of all particles at the end, in m.
    RegionMaxX,
    /// Cracking: largest force along the path, in N. In a run in time: the load when half of the losses have happened, which under loads
    /// that grow slowly come at once.
    PeakForce,
    /// Cracking: displacement of the load at the largest force, in m.
    PeakDisplacement,
    /// Cracking: force over displacement before anything has failed, in N/m.
    FirstStiffness,
    /// Cracking: work under displacement control up to a displacement, in J.
    EnvelopeWork,
    /// Cracking: energy of the bonds that failed, in J.
    FractureEnergy,
    /// Cracking: energy that the bodies let go around them, in J; in motion it would be waves.
    RadiatedEnergy,
    /// Cracking: energy along the path that no entry accounts for, over the largest entry.
    PathClosure,
    /// Cracking: the same at the worst single failure, over the strain energy before it.
    FailureClosure,
    /// Cracking: number of failures.
    Failures,
    /// Cracking: number of points that were torn off.
    TornOff,
    /// Cracking: number of times the region of particles grew.
    Growths,
    /// Cracking: largest jump of force, stiffness and strain energy at held displacement as the region grew, as a share.
    GrowthJump,
    /// Cracking: counted work, one number for all kinds.
    CountedWork,
    /// Cracking, a curve: force (N) against displacement (m) of the load under displacement control.
    ForceDisplacement,
    /// Cracking, places: middles of the bonds that broke, y against x in m.
    CrackPath,
}

/// Where something is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Where {
    /// At a point or along a line.
    Place,
    /// Along a line only.
    Line,
    /// At a support.
    Support,
    /// Of the switches of a run.
    Switch,
    /// Of the whole model, in statics too.
    Model,
    /// Of the whole model, in a run only.
    Run,
    /// Of the whole model at the end of a run.
    End,
    /// Of a path of cracking.
    Crack,
}

impl Read {
    /// SI unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Ux | Self::Uy | Self::Uz | Self::Gap | Self::RegionMinX | Self::RegionMaxX => "m",
            Self::Sxx | Self::Syy | Self::Sxy | Self::LargestBondStress => "Pa",
            Self::SecantRotation | Self::SectionRotation => "rad",
            Self::StrainEnergy | Self::KineticEnergy | Self::ExternalWork => "J",
            Self::FractureWork | Self::ContactWork => "J",
            Self::Losses => "1",
            Self::ReactionX | Self::ReactionY | Self::ReactionZ => "N",
            Self::SwitchTime => "s",
            Self::DisplacementError | Self::DisplacementErrorRms => "1",
            Self::EnergyClosure | Self::LoadFactor | Self::Particles => "1",
            Self::SwitchEnergyJump | Self::SwitchMomentumJump | Self::SwitchAngularMomentumJump => "1",
            Self::SwitchReactionJump | Self::SwitchShareOfTime => "1",
            Self::SwitchUnbalancedBefore | Self::SwitchUnbalancedAfter => "1",
            Self::PeakForce | Self::ForceDisplacement => "N",
            Self::PeakDisplacement | Self::CrackPath => "m",
            Self::FirstStiffness => "N/m",
            Self::EnvelopeWork | Self::FractureEnergy | Self::RadiatedEnergy => "J",
            Self::PathClosure | Self::FailureClosure | Self::Failures | Self::TornOff => "1",
            Self::Growths | Self::GrowthJump | Self::CountedWork => "1",
        }
    }

    /// Where it is read.
    pub fn place(self) -> Where {
        match self {
            Self::Ux | Self::Uy | Self::Uz | Self::Sxx | Self::Syy | Self::Sxy => Where::Place,
            Self::SecantRotation | Self::SectionRotation => Where::Line,
            Self::ReactionX | Self::ReactionY | Self::ReactionZ => Where::Support,
            Self::DisplacementError | Self::DisplacementErrorRms | Self::StrainEnergy => Where::Model,
            Self::KineticEnergy | Self::ExternalWork | Self::EnergyClosure | Self::Gap => Where::Run,
            Self::LoadFactor | Self::LargestBondStress | Self::Particles => Where::Run,
            Self::Losses | Self::FractureWork | Self::ContactWork => Where::Run,
            Self::SwitchEnergyJump | Self::SwitchMomentumJump | Self::SwitchAngularMomentumJump => {
                Where::Switch
            }
            Self::SwitchReactionJump | Self::SwitchTime | Self::SwitchShareOfTime => Where::Switch,
            Self::SwitchUnbalancedBefore | Self::SwitchUnbalancedAfter => Where::Switch,
            Self::RegionMinX | Self::RegionMaxX => Where::End,
            Self::PeakForce | Self::PeakDisplacement | Self::FirstStiffness => Where::Crack,
            Self::EnvelopeWork | Self::FractureEnergy | Self::RadiatedEnergy => Where::Crack,
            Self::PathClosure | Self::FailureClosure | Self::Failures | Self::TornOff => Where::Crack,
            Self::Growths | Self::GrowthJump | Self::CountedWork => Where::Crack,
            Self::ForceDisplacement | Self::CrackPath => Where::Crack,
        }
    }

    /// Whether the same thing can be read off a reference model without switches: not what tells of particles and ties.
    pub fn has_counterpart(self) -> bool {
        self.place() != Where::Crack
            && !matches!(
                self,
                Self::EnergyClosure
                    | Self::Gap
                    | Self::LoadFactor
                    | Self::LargestBondStress
                    | Self::Particles
            )
    }

    /// Whether it gives a curve of a path of cracking.
    pub fn is_crack_curve(self) -> bool {
        matches!(self, Self::ForceDisplacement | Self::CrackPath)
    }

    /// Whether it is the distance from an exact displacement.
    pub fn is_error(self) -> bool {
        matches!(self, Self::DisplacementError | Self::DisplacementErrorRms)
    }
}

impl Probe {
    /// Whether it gives a history in a run: a value over time.
    pub fn is_history(&self) -> bool {
        let once = [Where::Switch, Where::End, Where::Crack].contains(&self.read.place());
        self.line.is_none() && !once && !self.read.is_error()
    }
}

/// Stations at equal distances, independent of any mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// First station, in m.
    pub from: Vec<Number>,
    /// Last station, in m.
    pub to: Vec<Number>,
    /// Intervals between stations.
    pub intervals: usize,
}
