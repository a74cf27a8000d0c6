//! What the switches of a case show: one column for each.

use crate::format::{self, percent, signed_percent};
use seam_cases::result::{Stages, SwitchRecord};
use serde::Serialize;

/// Table of the switches: names as heads, then one row for each thing that a switch reports.
#[derive(Serialize)]
pub(super) struct Switches {
    names: Vec<String>,
    rows: Vec<(&'static str, Vec<String>)>,
}

/// One row: its name and what it says of a switch.
type Row = (&'static str, fn(&SwitchRecord) -> String);

const ROWS: [Row; 9] = [
    ("time", |s| format!("{} s", format::value(s.time_s))),
    ("elements that went", |s| format::grouped(s.elements as u64)),
    ("particles that came", |s| format::grouped(s.particles as u64)),
    ("unbalanced over internal forces", |s| stages(s.unbalanced, percent)),
    ("strain energy (J)", |s| stages(s.strain_energy, format::value)),
    ("strain energy, jump", |s| signed_percent(s.strain_energy_jump)),
    ("kinetic energy (J)", |s| stages(s.kinetic_energy, format::value)),
    ("momentum, jump over Σ m|v|", |s| {
        let [linear, angular] = [s.momentum_jump, s.angular_momentum_jump].map(|j| format::significant(j, 2));
        format!("linear {linear}, angular {angular}")
    }),
    ("force through each face, jump", |s| {
        let jumps = s.reaction_jump.iter().map(|(face, jump)| format!("{face} {}", percent(*jump)));
        jumps.collect::<Vec<_>>().join(", ")
    }),
];

/// Elements → fields as mapped → as the run goes on.
fn stages(s: Stages, say: fn(f64) -> String) -> String {
    [s.before, s.mapped, s.after].map(say).join(" → ")
}

/// The table; `None` without switches.
pub(super) fn view(switches: &[SwitchRecord]) -> Option<Switches> {
    let names: Vec<String> = switches.iter().map(|s| s.name.clone()).collect();
    let row = |(name, say): &Row| (*name, switches.iter().map(say).collect());
    (!names.is_empty()).then(|| Switches { names, rows: ROWS.iter().map(row).collect() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_switch_has_a_column_with_all_that_it_reports() {
        let record = SwitchRecord {
            name: "middle".to_owned(),
            time_s: 0.0125,
            elements: 400,
            particles: 202,
            unbalanced: Stages { before: 0.0, mapped: 0.25, after: 0.125 },
            strain_energy: Stages { before: 2.0, mapped: 3.0, after: 2.5 },
            strain_energy_jump: 0.25,
            momentum_jump: 1e-16,
            angular_momentum_jump: 2e-16,
            reaction_jump: [("left".to_owned(), 0.5), ("right".to_owned(), 0.75)].into(),
            ..SwitchRecord::default()
        };
        let second = SwitchRecord { name: "middle-2".to_owned(), ..SwitchRecord::default() };
        let table = view(&[record, second]).unwrap();
        assert_eq!(table.names, ["middle", "middle-2"]);
        let of = |name: &str| table.rows.iter().find(|(n, _)| *n == name).unwrap().1[0].clone();
        assert_eq!(of("time"), "0.0125 s");
        assert_eq!(of("unbalanced over internal forces"), "0 % → 25 % → 12 %");
        assert_eq!(of("strain energy (J)"), "2 → 3 → 2.5");
        assert_eq!(of("strain energy, jump"), "+25 %");
        assert_eq!(of("momentum, jump over Σ m|v|"), "linear 1e-16, angular 2e-16");
        assert_eq!(of("force through each face, jump"), "left 50 %, right 75 %");
        assert!(table.rows.iter().all(|(_, texts)| texts.len() == 2));
        assert!(view(&[]).is_none());
    }
}
