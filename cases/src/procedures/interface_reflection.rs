//! Waves along particles that meet elements twice as long: reflection in a time run against the exact one.
//!
//! Two chains of particles at spacing h, `h = 1` m, tied to the top and bottom of a row of elements of length 2h; only `u_x`
//! is free, so that both sides are bars. A pulse of narrow band runs towards the interface; a station half way reads
//! what goes and what comes back at the frequency of the pulse. The same in the plane ([`super::plane_reflection`]) is shown beside.

use super::Setting;
use super::compared::{exact, plot, series};
use super::plane_reflection::{self, Wave};
use super::scattering::{Lattice, equal_steps, frequency, reflection};
use super::straight::{Chain, hold, plane, rectangle};
use crate::error::Result;
use crate::result::{CaseResult, Observation, Role};
use rayon::prelude::*;
use seam_solver::coupling::{Method as Tying, Multipliers, Tie};
use seam_solver::dem::network::{BondStiffness, Network};
use seam_solver::dynamics::multirate::side::Stepping::Explicit;
use seam_solver::dynamics::multirate::{Method, Multirate, Rates};
use seam_solver::dynamics::newmark::start;
use seam_solver::dynamics::semidiscrete::Semidiscrete;
use seam_solver::fem::elasticity::Elasticity;
use seam_solver::fem::formulation::Formulation;
use seam_solver::model::{Model, Part};
use seam_solver::space::Vec3;
use seam_solver::work::Work;

/// Wavelengths over the length of an element, and their names.
const LENGTHS: [(f64, &str); 5] = [(20.0, "20"), (10.0, "10"), (8.0, "8"), (6.0, "6"), (4.0, "4")];
/// Above the cutoff of the elements, where the wave is as long as 2.8 of them at the step used.
const ABOVE_CUTOFF: f64 = 2.5;

/// Id, name, method and fine steps per coarse step.
const STEPS: [(&str, &str, Method, usize); 4] = [
    ("gc-1", "equal steps, Gravouil–Combescure", Method::GravouilCombescure, 1),
    ("ph-1", "equal steps, Prakash–Hjelmstad", Method::PrakashHjelmstad, 1),
    ("gc-2", "two to one, Gravouil–Combescure", Method::GravouilCombescure, 2),
    ("ph-2", "two to one, Prakash–Hjelmstad", Method::PrakashHjelmstad, 2),
];

/// Distances of pulse and station from the interface, and the length of the elements' side, in widths of the pulse: nothing else
/// that moves (what dispersion sends back, what the far ends return) reaches the station within [`END`].
const PULSE: f64 = 10.0;
const STATION: f64 = 5.0;
const COARSE: f64 = 6.0;
/// Time, in widths over the speed of the pulse.
const END: f64 = 20.0;

/// All wavelengths under equal steps and two to one.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let bar = Bar {
        young_pa: setting.number("young_Pa")?,
        density: setting.number("density_kg_m3")?,
        height: setting.number("height_m")?,
        courant: setting.number("courant")?,
        width: setting.number("width")?,
        least_width: setting.number("least_width_m")?,
    };
    let tolerance = setting.number("tolerance")?;
    // Under equal steps the methods are one: the second one is run where it is cheap.
    let needed = |s: usize, length: f64| s != 1 || length <= 6.0;
    let runs: Vec<(usize, f64, &str)> = (0..STEPS.len())
        .flat_map(|s| LENGTHS.iter().map(move |&(length, name)| (s, length, name)))
        .filter(|&(s, length, _)| needed(s, length))
        .chain([(0, ABOVE_CUTOFF, "cutoff"), (1, ABOVE_CUTOFF, "cutoff")])
        .collect();
    let measured = runs
        .par_iter()
        .map(|&(s, length, _)| bar.measure(2.0 * length, STEPS[s].2, STEPS[s].3))
        .collect::<seam_solver::error::Result<Vec<_>>>()
        .map_err(|e| setting.solver(e))?;
    for (&(s, length, name), &(value, work)) in runs.iter().zip(&measured) {
        result.work += work;
        let (id, words, method, ratio) = STEPS[s];
        let theory = bar.theory(2.0 * length, method, ratio);
        let source = match ratio {
            1 => "Celep and Bažant (1983), with the time step: (Z₁−Z₂)/(Z₁+Z₂), Z = √(km)√(1−(Ω/ω_c)²)",
            _ => {
                "scattering of a harmonic wave at this interface with its two steps, solved exactly (Floquet)"
            }
        };
        let why = "The formula is exact; the pulse has a band of finite width, up to 1e-3 where R is steep.";
        result.quantities.push(exact(
            [&format!("{id}-{name}"), &format!("|R| at λ/h = {length}, {words}"), "1"],
            value,
            theory,
            tolerance,
            [why, source],
        ));
    }
    for (id, title, ratio) in [
        ("equal", "Reflection under equal steps", 1),
        ("unequal", "Reflection, two fine steps per coarse step", 2),
    ] {
        let of_ratio = |s: usize| STEPS[s].3 == ratio;
        let mut lines = Vec::new();
        for (s, &(_, words, method, _)) in STEPS.iter().enumerate().filter(|(s, _)| of_ratio(*s)) {
            let points = runs.iter().zip(&measured).filter(|(r, _)| r.0 == s).map(|(r, m)| (r.1, m.0));
            lines.push(series(&format!("{words}, run"), Role::Data, points));
            if ratio == 2 || s == 0 {
                let name = if ratio == 1 { "exact".to_owned() } else { format!("{words}, exact") };
                let fine = (0..=70).map(|k| ABOVE_CUTOFF + 0.25 * k as f64);
                lines.push(series(
                    &name,
                    Role::Reference,
                    fine.map(|x| (x, bar.theory(2.0 * x, method, ratio))),
                ));
            }
        }
        result.curves.push(plot([id, title, "λ / element length (1)", "|R| (1)"], [true, true], lines));
    }
    in_the_plane(setting, &bar, result)
}

/// Waves of two kinds in the plane, beside the formula of the chains: shown, not judged.
fn in_the_plane(setting: &Setting, bar: &Bar, result: &mut CaseResult) -> Result<()> {
    let lengths = LENGTHS.map(|(length, _)| length);
    let chains = lengths.map(|x| (x, bar.theory(2.0 * x, Method::GravouilCombescure, 1)));
    let mut lines = vec![series("chains, equal steps, exact", Role::Reference, chains)];
    for (wave, id, words) in [(Wave::Pressure, "p", "pressure wave"), (Wave::Shear, "s", "shear wave")] {
        let (values, work) = plane_reflection::measure(setting, wave, &lengths)?;
        result.work += work;
        for ((length, name), &value) in LENGTHS.iter().zip(&values) {
            result.quantities.push(Observation {
                id: format!("plane-{id}-{name}"),
                label: format!("|R| at λ/h = {length}, {words} in the plane"),
                unit: "1".to_owned(),
                value,
                ..Observation::default()
            });
        }
        lines.push(series(words, Role::Model, lengths.into_iter().zip(values)));
    }
    let title = "Reflection in the plane, triangular lattice, mortar, equal steps";
    result.curves.push(plot(["plane", title, "λ / element height (1)", "|R| (1)"], [true, true], lines));
    Ok(())
}

/// The two sides; spacing of the particles 1 m.
struct Bar {
    young_pa: f64,
    density: f64,
    /// Tall enough that the elements' shear, which the pulse does not call for, does not decide the critical step.
    height: f64,
    /// cΔt/h on the fine side.
    courant: f64,
    /// Of the pulse, in wavelengths.
    width: f64,
    /// Of the pulse at least, in m: short waves are where R is steep.
    least_width: f64,
}

impl Bar {
    fn speed(&self) -> f64 {
        (self.young_pa / self.density).sqrt()
    }

    /// Both sides as chains of springs: unit section, spacing 1 m and 2 m.
    fn lattices(&self, ratio: usize) -> [Lattice; 2] {
        let step = self.courant / self.speed();
        let fine = Lattice { spring: self.young_pa, mass: self.density, step };
        [fine, Lattice { spring: 0.5 * fine.spring, mass: 2.0 * fine.mass, step: step * ratio as f64 }]
    }

    fn theory(&self, wavelength: f64, method: Method, ratio: usize) -> f64 {
        let [fine, coarse] = self.lattices(ratio);
        let omega = frequency(self.speed(), wavelength);
        if ratio == 1 { equal_steps(fine, coarse, omega) } else { reflection(fine, coarse, method, omega) }
    }

    /// |reflected| / |incident|, and the work.
    fn measure(
        &self,
        wavelength: f64,
        method: Method,
        ratio: usize,
    ) -> seam_solver::error::Result<(f64, Work)> {
        let c = self.speed();
        let [fine, coarse] = self.lattices(ratio);
        let omega = frequency(c, wavelength);
        let wave_number = fine.phase(omega);
        // dω/dk.
        let speed = c * (0.5 * wave_number).cos() / (0.5 * omega * fine.step).cos();
        let width = (self.width * wavelength).max(self.least_width);
        let model = self.model((2.0 * PULSE * width) as usize, (COARSE * width / 2.0).ceil() as usize)?;
        let mut work = Work::default();
        let system = Semidiscrete::new(&model, &mut work)?;
        let at = |k: usize| {
            let (part, point, _) = system.numbering.locate(system.free[k]);
            model.parts[part].positions()[point].x
        };
        // u = exp(−s²/2) cos(kx − ωt), s = (x − v_g t)/width.
        let pulse = |x: f64| {
            let s = x / width;
            let (sin, cos) = (wave_number * x).sin_cos();
            let envelope = (-0.5 * s * s).exp();
            (envelope * cos, envelope * (speed * s / width * cos + omega * sin))
        };
        let n = system.free.len();
        let (u, v) = (0..n).map(|k| pulse(at(k) + PULSE * width)).unzip();
        let station = (0..n).find(|&k| at(k) >= -STATION * width).unwrap_or(0);
        let (motion, lambda) = start(&system, (u, v), 0.0, 0.0, 0.0, &mut work)?;
        let rates = Rates {
            method,
            coarse_step: coarse.step,
            ratio,
            coarse: Explicit,
            fine: Explicit,
            fine_parts: vec![0],
        };
        let mut run = Multirate::new(&model, &system, &rates, (&motion, lambda), &mut work)?;
        let end = END * width / speed;
        let mut amplitudes = [[0.0; 2]; 2];
        while run.motion().time < end {
            run.step(|_| 0.0, &mut work)?;
            let motion = run.motion();
            let which = usize::from(motion.time > 0.5 * end);
            let (sin, cos) = (omega * motion.time).sin_cos();
            amplitudes[which][0] += motion.u[station] * cos;
            amplitudes[which][1] += motion.u[station] * sin;
        }
        let [incident, reflected] = amplitudes.map(|[a, b]: [f64; 2]| a.hypot(b));
        Ok((reflected / incident, work))
    }

    fn model(&self, fine: usize, coarse: usize) -> seam_solver::error::Result<Model> {
        let corner = |x: f64, y: f64| Vec3::new(x, y, 0.0);
        let elasticity = Elasticity { young_pa: self.young_pa, poisson: 0.0, density: self.density };
        let corners = [corner(0.0, 0.0), corner(2.0 * coarse as f64, self.height)];
        let body = rectangle("coarse", corners, [coarse, 1], elasticity, 1.0, Formulation::Plain)?;
        let tie = Tie {
            name: "middle".to_owned(),
            first: (0, "right".to_owned()),
            second: (1, "left".to_owned()),
            method: Tying::Pointwise,
            multipliers: Multipliers::Auto,
            rotations: false,
        };
        let chains = Part::Discrete { name: "fine".to_owned(), network: self.chains(fine) };
        let mut model = plane(vec![chains, Part::Continuum(body)]);
        model.ties.push(tie);
        hold(&mut model, 1, |_| true);
        Ok(model)
    }

    /// Two chains up to x = 0, each with half the section of the bar.
    fn chains(&self, bonds: usize) -> Network {
        let half_section = 0.5 * self.height;
        let stiffness = BondStiffness { kn: self.young_pa * half_section, ..BondStiffness::default() };
        let mass = self.density * half_section;
        let chain = Chain { bonds, spacing: 1.0, stiffness, mass, inertia: mass };
        let [mut both, upper] = [0.0, self.height].map(|y| chain.network(Vec3::new(-(bonds as f64), y, 0.0)));
        let count = both.particles.len();
        both.particles.position.extend(upper.particles.position);
        both.particles.radius.extend(upper.particles.radius);
        both.particles.mass.extend(upper.particles.mass);
        both.particles.inertia.extend(upper.particles.inertia);
        both.bonds.ends.extend(upper.bonds.ends.iter().map(|ends| ends.map(|p| p + count)));
        both.bonds.radius.extend(upper.bonds.radius);
        both.bonds.stiffness.extend(upper.bonds.stiffness);
        both.bonds.weight.extend(upper.bonds.weight);
        both.faces = [("right".to_owned(), vec![count - 1, 2 * count - 1])].into();
        both
    }
}
