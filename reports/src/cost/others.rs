//! Other codes on the axes of a diagram: the very network or mesh of a point, at the speed of a race.
//!
//! The answer is then Seam's own, and so is its error; time is what the code would have to do over its rate.

use crate::race::{Lane, Race, scaled, unit};
use seam_cases::result::{CostDiagram, CostPoint, Elsewhere};

/// One code on the networks or meshes of one setting. Not deterministic where the race is not.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Other {
    /// Name of the code.
    pub code: String,
    /// The setting whose networks or meshes they are.
    pub setting: String,
    /// Slowest and fastest rate that was taken from the race, in `unit`.
    pub rate: [f64; 2],
    /// Unit of the rate.
    pub unit: &'static str,
    /// Time (s) and error (fraction), coarse to fine.
    pub points: Vec<[f64; 2]>,
}

/// Every code of a race, on one thread, for each setting whose work it could have done.
pub fn others(diagram: &CostDiagram, race: &Race) -> Vec<Other> {
    let mut all: Vec<Other> = Vec::new();
    for setting in &diagram.settings {
        let mut codes: Vec<&str> = race.lanes.iter().filter(|l| !l.is_seam()).map(Lane::title).collect();
        codes.sort_unstable();
        codes.dedup();
        for code in codes {
            let points: Vec<(f64, [f64; 2], &str)> =
                setting.points.iter().filter_map(|p| at(p, code, race)).collect();
            let Some((_, _, what)) = points.first() else { continue };
            let rates = points.iter().map(|(rate, _, what)| scaled(what, *rate));
            all.push(Other {
                code: code.to_owned(),
                setting: setting.name.clone(),
                rate: rates.fold([f64::INFINITY, 0.0], |[low, high], r| [low.min(r), high.max(r)]),
                unit: unit(what),
                points: points.iter().map(|(_, point, _)| *point).collect(),
            });
        }
    }
    all
}

/// Rate, time and error of a code at one point, and what it was raced on; `None` if that is not what it does.
fn at<'a>(point: &CostPoint, code: &str, race: &'a Race) -> Option<(f64, [f64; 2], &'a str)> {
    let (what, size, work) = match point.elsewhere? {
        Elsewhere::BondUpdates(updates) => ("network", point.particles as f64, updates),
        Elsewhere::Unknowns(unknowns) => ("mesh", unknowns as f64, unknowns),
    };
    let lanes = race.of_kind(what).filter(|lane| lane.title() == code && lane.threads == 1.0);
    let away = |lane: &&Lane| (lane.size / size).ln().abs();
    let lane = lanes.min_by(|a, b| away(a).total_cmp(&away(b)))?;
    let rate = lane.rate[0];
    Some((rate, [work as f64 / rate, point.error?], lane.what.as_str()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use seam_cases::result::CostSetting;

    fn lane(what: &str, code: &str, size: f64, rate: f64) -> Lane {
        let rate = [rate; 3];
        Lane { what: what.to_owned(), code: code.to_owned(), size, threads: 1.0, rate, ..Lane::default() }
    }

    fn point(particles: usize, elsewhere: Option<Elsewhere>) -> CostPoint {
        CostPoint { error: Some(0.01), particles, elsewhere, ..CostPoint::default() }
    }

    #[test]
    fn each_code_is_timed_at_the_size_nearest_to_that_of_the_point() {
        let lanes = vec![
            lane("network", "yade", 1e3, 2e6),
            lane("network", "yade", 1e5, 4e6),
            lane("network", "seam", 1e3, 6e7),
            lane("mesh", "calculix", 1e3, 1e4),
        ];
        let race = Race { lanes, ..Race::default() };
        let updates = |particles, n| point(particles, Some(Elsewhere::BondUpdates(n)));
        let setting = |name: &str, points: Vec<CostPoint>| CostSetting { name: name.to_owned(), points };
        let diagram = CostDiagram {
            settings: vec![
                setting("all particles", vec![updates(500, 8_000_000), updates(50_000, 8_000_000)]),
                setting("all finite elements", vec![point(0, Some(Elsewhere::Unknowns(5000)))]),
                setting("coupled", vec![point(500, None)]),
            ],
            ..CostDiagram::default()
        };
        let found = others(&diagram, &race);
        let short: Vec<_> = found.iter().map(|o| (o.code.as_str(), o.setting.as_str(), &o.points)).collect();
        assert_eq!(
            short,
            [
                ("YADE", "all particles", &vec![[4.0, 0.01], [2.0, 0.01]]),
                ("CalculiX", "all finite elements", &vec![[0.5, 0.01]]),
            ]
        );
        assert_eq!((found[0].rate, found[0].unit), ([2.0, 4.0], "million bond updates/s"));
    }
}
