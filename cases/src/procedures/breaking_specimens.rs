//! Notched networks whose bonds break: a strip with a slit that is pulled, and a beam with a V-notch that is bent.

use super::Setting;
use super::bond_for_bond_networks::Kit;
use crate::error::Result;
use seam_solver::dem::block::Block;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::network::Network;
use seam_solver::dem::notch::Notch;
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::space::Vec3;

/// What a code is given beside the network: which bonds may break, and how strong they are.
pub(crate) struct Specimen {
    /// The network; some of its particles are held, others moved by one metre at load factor one.
    pub model: Model,
    /// Micro material of its bonds.
    pub material: BondMaterial,
    /// Which bonds may break.
    pub breakable: Vec<bool>,
    /// Tension at the rim of a bond that breaks it, in Pa.
    pub strength_pa: f64,
    /// Bonds to be broken.
    pub events: usize,
    /// In words, for the table of agreements.
    pub about: &'static str,
}

/// Both ends gripped, the right one pulled; a slit halfway, from below.
pub(super) fn pulled(setting: &Setting) -> Result<Specimen> {
    let kit = Kit::new(setting)?;
    let (shape, at, row) = shape(setting, &kit)?;
    let network = slit(shape, at, setting.number("notch_rows")? * row);
    let model = kit.pulled(network);
    specimen(setting, &kit, model, [at, f64::INFINITY], "notched network, pulled apart")
}

/// On two points at the ends of the lowest row, pressed down at mid-span; a V-notch from below.
///
/// Supports: `u_x = u_y = 0` left, `u_y = 0` right. The particles of the top row within the patch move down alike, and
/// are free to turn and to move along the beam.
pub(super) fn bent(setting: &Setting) -> Result<Specimen> {
    let kit = Kit::new(setting)?;
    let (shape, at, row) = shape(setting, &kit)?;
    let half = 0.5 * setting.number("spacing_m")?;
    let margin = Vec3::new(half, half, 0.0);
    let corner = |pick: fn(f64, f64) -> f64, start: f64| {
        let of = |axis: usize| shape.particles.position.iter().map(|x| x[axis]).fold(start, pick);
        Vec3::new(of(0), of(1), 0.0)
    };
    let (low, high) = (corner(f64::min, f64::INFINITY), corner(f64::max, f64::NEG_INFINITY));
    let refuse = |e| setting.solver(e);
    let block = Block::new(shape.space, low - margin, high + margin).map_err(refuse)?;
    let tip = Vec3::new(at, setting.number("notch_rows")? * row, 0.0);
    let notch = Notch { tip, angle: setting.number("angle_deg")?.to_radians() };
    let network = notch.cut(&shape, &block).map_err(refuse)?.network;

    let position = &network.particles.position;
    let lowest: Vec<usize> = (0..position.len()).filter(|&p| position[p].y < 0.5 * row).collect();
    let by_x = |a: &&usize, b: &&usize| position[**a].x.total_cmp(&position[**b].x);
    let ends = lowest.iter().min_by(by_x).zip(lowest.iter().max_by(by_x));
    let patch = setting.number("patch_m")?;
    let pressed = (0..position.len())
        .filter(|&p| position[p].y > high.y - 0.5 * row && (position[p].x - at).abs() < patch);
    let value = |point: usize, component: usize, value: f64| PointValue { part: 0, point, component, value };
    let held = ends.map(|(&left, &right)| [value(left, 0, 0.0), value(left, 1, 0.0), value(right, 1, 0.0)]);
    let supports = held.into_iter().flatten().chain(pressed.map(|p| value(p, 1, -1.0))).collect();
    let space = network.space;
    let body = Part::Discrete { name: "beam".to_owned(), network };
    let model = Model { space, parts: vec![body], ties: Vec::new(), supports, loads: Vec::new() };
    specimen(setting, &kit, model, [at, setting.number("top_m")?], "V-notched beam network, bent")
}

/// Shaken lattice, the middle of its length (m), and the distance of its rows (m).
fn shape(setting: &Setting, kit: &Kit) -> Result<(Network, f64, f64)> {
    let spacing = setting.number("spacing_m")?;
    let (columns, rows) = (setting.count("columns", 4)?, setting.count("rows", 3)?);
    let network = kit.triangular_shaken(columns, rows, setting.number("shake")?);
    Ok((network, (0.5 * columns as f64 - 0.25) * spacing, 0.75f64.sqrt() * spacing))
}

/// Bonds may break whose middle is near the plane x = `at` and below `top` (m).
fn specimen(
    setting: &Setting,
    kit: &Kit,
    model: Model,
    [at, top]: [f64; 2],
    about: &'static str,
) -> Result<Specimen> {
    let zone = setting.number("zone_m")?;
    let networks = model.parts.iter().filter_map(|part| match part {
        Part::Discrete { network, .. } => Some(network),
        Part::Continuum(_) => None,
    });
    let breakable = |network: &Network| -> Vec<bool> {
        let middle =
            |&[i, j]: &[usize; 2]| 0.5 * (network.particles.position[i] + network.particles.position[j]);
        let near = |x: Vec3| (x.x - at).abs() < zone && x.y < top;
        network.bonds.ends.iter().map(|ends| near(middle(ends))).collect()
    };
    Ok(Specimen {
        breakable: networks.flat_map(breakable).collect(),
        material: kit.material(),
        strength_pa: setting.number("strength_Pa")?,
        events: setting.count("events", 1)?,
        about,
        model,
    })
}

/// Without the bonds that cross `x = at` below `depth` (m).
fn slit(mut network: Network, at: f64, depth: f64) -> Network {
    let position = &network.particles.position;
    let crosses = |[i, j]: [usize; 2]| {
        let (a, b) = (position[i], position[j]);
        let t = (at - a.x) / (b.x - a.x);
        (0.0..=1.0).contains(&t) && a.y + t * (b.y - a.y) < depth
    };
    let bonds = &mut network.bonds;
    let kept: Vec<usize> = (0..bonds.len()).filter(|&b| !crosses(bonds.ends[b])).collect();
    bonds.ends = kept.iter().map(|&b| bonds.ends[b]).collect();
    bonds.radius = kept.iter().map(|&b| bonds.radius[b]).collect();
    bonds.stiffness = kept.iter().map(|&b| bonds.stiffness[b]).collect();
    bonds.weight = kept.iter().map(|&b| bonds.weight[b]).collect();
    network
}
