//! Discrete-element bodies: particles in their places, bonded and calibrated.

use super::calibration::{self, Target, Unit};
use super::{Context, Refusal};
use crate::error::Fault;
use crate::scene::body::Body;
use crate::scene::check_notched_beam;
use crate::scene::de::{self, Arrangement as Kind, Calibrate, De};
use seam_solver::dem::arrangement::{Arrangement, Matter};
use seam_solver::dem::block::Block;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::bonding::{self, BondRecipe, Bonding, Pair};
use seam_solver::dem::grid::Boundary;
use seam_solver::dem::lattice::{LatticeKind, lattice};
use seam_solver::dem::network::Network;
use seam_solver::dem::notch::Notch;
use seam_solver::dem::packing::{PackingRecipe, pack};
use seam_solver::dem::section::{self, Section};
use seam_solver::dem::skin::Skin;
use seam_solver::space::{Space, Vec3};
use seam_solver::stage::{Stage, timed};

/// A facet smaller than this share of a mean cell's side is a rounding of four particles on one circle.
const LEAST_FACET: f64 = 1e-6;

/// Bonded particles, with the area of the Voronoi facet that each bond stands for (m²); `None` where they have none, or nobody asks.
#[derive(Debug, Clone)]
pub struct Filled {
    /// Particles and bonds.
    pub network: Network,
    /// Area of each bond.
    pub facets: Option<Vec<f64>>,
}

/// The body, filled with bonded particles.
pub fn network(
    context: &Context,
    name: &str,
    body: &Body,
    notes: &mut Vec<String>,
) -> Result<Filled, Refusal> {
    if let Some(files) = &body.network {
        let folder = &context.file.folder;
        let (particles, bonds) = (folder.file(&files.particles)?, folder.file(&files.bonds)?);
        let network = seam_solver::dem::network_csv::read(context.space, &particles, &bonds)?;
        return Ok(Filled { network, facets: None });
    }
    let key = format!("bodies.{name}");
    let (Some(de), Some(block)) = (&body.de, block(context, name, body)?) else {
        let message = "particles need a box or a notched beam, and the section `de`";
        return Err(Fault::new(key, message, "give both").into());
    };
    let rows = de.rows.count(context.values, 1, &format!("{key}.de.rows"))?;
    let filled = fill(context, &key, (body, de), (block, rows), notes)?;
    without_notch(context, &key, body, filled, &block)
}

/// The box that a body fills but for its notch.
pub fn block(context: &Context, name: &str, body: &Body) -> Result<Option<Block>, Refusal> {
    let key = format!("bodies.{name}");
    if let Some(beam) = &body.notched_beam {
        let shape = check_notched_beam::shape(beam, context.values, &key)?;
        let depth = context.hypothesis.thickness();
        let (half, height) = (0.5 * shape.length, shape.depth);
        return Ok(Some(Block::new(
            context.space,
            Vec3::new(-half, 0.0, 0.0),
            Vec3::new(half, height, depth),
        )?));
    }
    let Some(shape) = &body.cuboid else { return Ok(None) };
    let min = context.vector(&shape.min, &format!("{key}.box.min"))?;
    let max = context.vector(&shape.max, &format!("{key}.box.max"))?;
    Ok(Some(Block::new(context.space, min, max)?))
}

/// The filling of a box of a body, without the body's notch.
pub fn without_notch(
    context: &Context,
    key: &str,
    body: &Body,
    filled: Filled,
    block: &Block,
) -> Result<Filled, Refusal> {
    let Some(beam) = &body.notched_beam else { return Ok(filled) };
    let shape = check_notched_beam::shape(beam, context.values, key)?;
    let notch = Notch { tip: Vec3::new(0.0, shape.notch_depth, 0.0), angle: shape.angle };
    if !notch.meets(block) {
        return Ok(filled);
    }
    let cut = notch.cut(&filled.network, block)?;
    let facets = filled.facets.map(|areas| cut.bonds.iter().map(|&b| areas[b]).collect());
    Ok(Filled { network: cut.network, facets })
}

/// Particles in a box, `rows` spacings across its height; `key` is the table that holds the section `de`.
pub fn fill(
    context: &Context,
    key: &str,
    (body, de): (&Body, &De),
    (block, rows): (Block, usize),
    notes: &mut Vec<String>,
) -> Result<Filled, Refusal> {
    let elasticity = context.elasticity(body)?;
    let matter = Matter { density: elasticity.density, thickness_m: context.hypothesis.thickness() };
    let filling = timed(Stage::Packing, || arrange(context, key, de, (block, rows), matter, notes))?;
    limit(context, key, &filling.arrangement)?;
    let target = Target { elasticity, hypothesis: context.hypothesis, thickness_m: matter.thickness_m };
    let recipe = recipe(context, key, de, &filling.made, &target, notes)?;
    bonded(context, &filling.arrangement, &filling.pairs, &recipe)
}

/// Refuses more particles than the scene allows.
pub fn limit(context: &Context, key: &str, arrangement: &Arrangement) -> Result<(), Fault> {
    let (count, limit) = (arrangement.particles.len(), context.scene.limits.particles);
    if count <= limit {
        return Ok(());
    }
    let message = format!("{count} particles are more than the limit of {limit}");
    Err(Fault::new(format!("{key}.de.rows"), message, "use fewer rows, or raise limits.particles"))
}

/// Bonds, and their facets where the scene has strengths.
pub fn bonded(
    context: &Context,
    arrangement: &Arrangement,
    pairs: &[Pair],
    recipe: &BondRecipe,
) -> Result<Filled, Refusal> {
    let network = bonding::bond_network(arrangement, pairs, recipe)?;
    let asked = !context.scene.failure.is_empty() || !context.scene.left_out.failure.is_empty();
    Ok(Filled { network, facets: asked.then(|| section::facets(arrangement, pairs)).flatten() })
}

/// Particles in their places, and which are bonded.
struct Filling {
    arrangement: Arrangement,
    pairs: Vec<Pair>,
    made: Made,
}

/// How the particles were placed: what calibration has to repeat.
pub enum Made {
    /// A lattice.
    Lattice(Unit),
    /// A random packing.
    Packing(Protocol),
}

/// Places the particles and says which are bonded.
fn arrange(
    context: &Context,
    key: &str,
    de: &De,
    (block, rows): (Block, usize),
    matter: Matter,
    notes: &mut Vec<String>,
) -> Result<Filling, Refusal> {
    if let Some(kind) = lattice_kind(de) {
        let lattice = lattice(kind, block, rows, matter)?;
        let spacing = 2.0 * lattice.arrangement.particles.radius[0];
        let unit = Unit { kind, spacing, stretch: lattice.stretch };
        return Ok(Filling {
            arrangement: lattice.arrangement,
            pairs: lattice.pairs,
            made: Made::Lattice(unit),
        });
    }
    let protocol = Protocol::of(context, key, de, 0.5 * block.sides().y / rows as f64)?;
    let recipe = PackingRecipe {
        space: context.space,
        block,
        boundary: Boundary::Closed,
        mean_radius_m: protocol.mean_radius_m,
        solid_fraction: protocol.solid_fraction,
        radius_spread: protocol.radius_spread,
        seed: protocol.seed,
    };
    let packing = pack(&recipe, matter)?;
    let pairs = protocol.bonding.pairs(&packing.arrangement)?;
    let report = &packing.report;
    context.packed(report.checks);
    notes.push(format!(
        "{key}: {} particles by {}, seed {}, solid fraction {:.3}, radii ±{:.0} %, {:.2} bonds per particle, largest overlap {:.1e}",
        report.particles,
        report.algorithm,
        report.seed,
        report.solid_fraction,
        100.0 * report.radius_spread,
        bonding::coordination(&packing.arrangement, &pairs),
        report.largest_overlap,
    ));
    Ok(Filling { arrangement: packing.arrangement, pairs, made: Made::Packing(protocol) })
}

/// The lattice of an arrangement; `None` if it is random.
pub fn lattice_kind(de: &De) -> Option<LatticeKind> {
    Some(match (de.arrangement, de.ends) {
        (Kind::Triangular, de::Ends::Completed) => LatticeKind::Triangular,
        (Kind::Triangular, de::Ends::Zigzag) => LatticeKind::TriangularZigzag,
        (Kind::Square, _) => LatticeKind::Square,
        (Kind::Sc, _) => LatticeKind::SimpleCubic,
        (Kind::Bcc, _) => LatticeKind::BodyCentredCubic,
        (Kind::Fcc, _) => LatticeKind::FaceCentredCubic,
        (Kind::Random, _) => return None,
    })
}

/// How a random packing is made and bonded, in a body as in its calibration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Protocol {
    /// Plane or solid.
    pub space: Space,
    /// Mean radius, in m: in the plane moduli depend on it, since bonds are round and the body is flat.
    pub mean_radius_m: f64,
    /// Share of the box inside particles.
    pub solid_fraction: f64,
    /// Radii vary by ± this share.
    pub radius_spread: f64,
    /// Seed.
    pub seed: u64,
    /// Who is bonded to whom.
    pub bonding: Bonding,
}

impl Protocol {
    fn of(context: &Context, key: &str, de: &De, mean_radius_m: f64) -> Result<Self, Fault> {
        let (fraction, coordination) = match context.space {
            Space::Plane => (0.84, 4.5),
            Space::Solid => (0.64, 6.2),
        };
        let mut protocol = Self {
            space: context.space,
            mean_radius_m,
            solid_fraction: fraction,
            radius_spread: 0.2,
            seed: 1,
            bonding: Bonding::Delaunay { least_share: LEAST_FACET },
        };
        let Some(packing) = &de.packing else { return Ok(protocol) };
        let value = |number: &crate::scene::number::Number, name: &str| {
            number.value(context.values, &format!("{key}.de.packing.{name}"))
        };
        protocol.seed = packing.seed;
        protocol.radius_spread = value(&packing.radius_spread, "radius_spread")?;
        if let Some(number) = &packing.solid_fraction {
            protocol.solid_fraction = value(number, "solid_fraction")?;
        }
        if packing.bonding == de::Bonding::Distance {
            let z = match &packing.coordination {
                Some(number) => value(number, "coordination")?,
                None => coordination,
            };
            protocol.bonding = Bonding::Coordination { z };
        }
        Ok(protocol)
    }
}

/// Section, material and skin of the bonds.
pub fn recipe(
    context: &Context,
    key: &str,
    de: &De,
    made: &Made,
    target: &Target,
    notes: &mut Vec<String>,
) -> Result<BondRecipe, Refusal> {
    let key = format!("{key}.de.bond");
    let number = |number: &Option<crate::scene::number::Number>, name: &str| match number {
        Some(number) => number.value(context.values, &format!("{key}.{name}")).map(Some),
        None => Ok(None),
    };
    let ratio = number(&de.bond.radius_ratio, "radius_ratio")?.unwrap_or(f64::NAN);
    let young_pa = number(&de.bond.young_pa, "young_Pa")?.unwrap_or(f64::NAN);
    let poisson = de.bond.poisson.value(context.values, &format!("{key}.poisson"))?;
    let section = match de.section {
        de::Section::Uniform => Section::Uniform { ratio },
        de::Section::Voronoi => Section::Voronoi { ratio },
    };
    let skin = match de.skin {
        de::Skin::Weighted => Skin::Weighted,
        de::Skin::SecondMoment => Skin::SecondMoment,
        de::Skin::Full => Skin::Full,
    };
    let given = BondRecipe { material: BondMaterial { young_pa, poisson }, section, skin };
    if de.bond.calibrate == Calibrate::None {
        return Ok(given);
    }
    let both = de.bond.calibrate == Calibrate::Both;
    let (found, work) = match made {
        Made::Lattice(unit) => calibration::lattice(*unit, target, &given, both)?,
        Made::Packing(protocol) => calibration::packing(protocol, target, &given, both)?,
    };
    context.calibrated(work);
    notes.push(format!(
        "{key}: radius ratio {:.4}, bond modulus {:.4e} Pa ({})",
        found.section.ratio(),
        found.material.young_pa,
        if both { "both calibrated" } else { "modulus calibrated, radius given" }
    ));
    Ok(found)
}
