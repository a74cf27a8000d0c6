//! The report page.

use super::fixture;
use seam_cases::result::Agreement;
use seam_reports::html::{page, write_report};
use seam_reports::judge::judge;
use seam_reports::race::{Lane, Race};
use seam_reports::record::Recorded;
use seam_reports::results::Results;

fn the_page() -> String {
    page(&fixture::results(), &fixture::cases()).unwrap()
}

#[test]
fn the_answer_comes_first() {
    let page = the_page();
    let order = [
        "id=\"answer\"",
        "id=\"claims\"",
        "id=\"numbers\"",
        "id=\"bias\"",
        "id=\"budget\"",
        "id=\"cost\"",
        "id=\"cases\"",
        "id=\"provenance\"",
        "id=\"machine\"",
    ];
    let places: Vec<usize> = order.iter().map(|id| page.find(id).unwrap_or_else(|| panic!("{id}"))).collect();
    assert!(places.is_sorted(), "{places:?}");
}

/// Sections without data are left out; with data they say which code, and where a race was run.
#[test]
fn other_codes_have_sections_of_their_own() {
    let mut results = fixture::results();
    let show = |results: &Results| page(results, &fixture::cases()).unwrap();
    let sections = ["id=\"agreement\"", "id=\"race\""];
    assert!(sections.iter().all(|id| !show(&results).contains(id)));
    results.cases[0].quantities[0].agreement = Some(Agreement {
        code: "YADE".to_owned(),
        version: "2023.02a".to_owned(),
        model: "chain network, at rest".to_owned(),
        compared: "displacement".to_owned(),
        same_model: true,
        ..Agreement::default()
    });
    let lane = |code: &str, threads: f64, seconds: f64| Lane {
        what: "network".to_owned(),
        size: 4000.0,
        threads,
        code: code.to_owned(),
        seconds,
        rate: [30e6 / seconds, 29e6 / seconds, 31e6 / seconds],
        times_seam: seconds,
        times_finite: (threads == 1.0).then_some(seconds / 3.0),
        ..Lane::default()
    };
    let lanes = vec![
        lane("seam", 1.0, 1.0),
        lane("seam-finite", 1.0, 3.0),
        lane("yade", 1.0, 12.0),
        lane("bandwidth", 1.0, 0.4),
    ];
    results.race = Some(Race { recorded: true, lanes, ..Race::default() });
    let page = show(&results);
    assert!(sections.iter().all(|id| page.contains(id)));
    for part in ["YADE 2023.02a", "chain network, at rest", "Recorded elsewhere", "Seam, finite rotations"] {
        assert!(page.contains(part), "{part}");
    }
    assert!(page.contains("YADE takes 12 times as long as Seam, 4 times as long as with finite rotations."));
    assert!(page.contains("Limit of memory: Seam&#x27;s speed is 40\u{a0}% of it."));
}

#[test]
fn the_page_needs_nothing_else() {
    let page = the_page();
    for outside in ["<link", "src=", "@import", "url(", "https://"] {
        assert!(!page.contains(outside), "{outside}");
    }
    // The namespace of SVG is a name, not an address to fetch.
    assert_eq!(page.matches("http://").count(), page.matches("xmlns=\"http://www.w3.org/2000/svg\"").count());
}

#[test]
fn every_link_within_the_page_leads_somewhere() {
    let page = the_page();
    for link in page.split("href=\"#").skip(1).filter_map(|rest| rest.split('"').next()) {
        assert!(page.contains(&format!("id=\"{link}\"")), "#{link}");
    }
}

#[test]
fn every_figure_can_be_read_aloud_and_follows_the_theme() {
    let page = the_page();
    let figures: Vec<&str> = page.split("<svg ").skip(1).filter_map(|s| s.split("</svg>").next()).collect();
    assert_eq!(
        figures.len(),
        10,
        "family, bias, budget, work, seconds, sketch, picture, curves, residuals, order"
    );
    for figure in figures {
        assert!(figure.contains("role=\"img\"") && figure.contains("<title>") && figure.contains("<desc>"));
        let hard = figure.split(['"', ' ']).find(|word| word.starts_with('#'));
        assert_eq!(hard, None, "a colour that no theme can change in {}", &figure[..200]);
        assert!(!figure.contains("NaN"));
    }
}

#[test]
fn every_number_says_what_it_is_evidence_of() {
    let page = the_page();
    let (table, _) = page.split_once("id=\"errors\"").unwrap().1.split_once("</table>").unwrap();
    let rows: Vec<&str> = table.split("<tr data-verdict").skip(1).collect();
    assert_eq!(rows.len(), 21);
    let of =
        |activity: &str| rows.iter().filter(|r| r.contains(&format!("data-activity=\"{activity}\""))).count();
    assert_eq!((of("verification"), of("benchmarking"), of("validation")), (20, 1, 0));
}

#[test]
fn every_figure_is_a_file_and_its_numbers_another() {
    let folder = tempfile::tempdir().unwrap();
    write_report(&fixture::results(), &fixture::cases(), folder.path()).unwrap();
    let figures = std::fs::read_dir(folder.path().join("figures")).unwrap();
    let mut names: Vec<String> = figures.map(|f| f.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    let drawn: Vec<&str> = names.iter().filter_map(|n| n.strip_suffix(".svg")).collect();
    let tables: Vec<&str> = names.iter().filter_map(|n| n.strip_suffix(".csv")).collect();
    assert_eq!(drawn, tables);
    assert_eq!(drawn.len(), the_page().matches("<svg ").count());
    for name in &tables {
        let text = std::fs::read_to_string(folder.path().join(format!("figures/{name}.csv"))).unwrap();
        let fields = text.lines().next().unwrap().split(',').count();
        assert!(fields >= 3 && text.lines().count() > 2, "{name}: {text}");
    }
}

#[test]
fn text_from_a_scene_is_escaped() {
    let mut cases = fixture::cases();
    let evil = "<script>alert(1)</script>";
    cases[0].title = evil.into();
    cases[0].purpose = evil.into();
    cases[0].families[0].statement = evil.into();
    cases[0].curves[0].title = evil.into();
    cases[0].curves[0].x_label = evil.into();
    cases[0].curves[0].series[1].name = evil.into();
    cases[0].budgets[0].parts[0].name = evil.into();
    cases[0].pictures[0].title = evil.into();
    cases[0].quantities[0].label = evil.into();
    cases[0].command = evil.into();
    let results = judge(&cases, fixture::provenance(), &Recorded::default());
    let page = page(&results, &cases).unwrap();
    assert!(!page.contains("<script>alert") && page.contains("&lt;script&gt;alert"));
}

#[test]
fn two_runs_differ_in_the_machine_block_only() {
    let again = |seconds: f64| {
        let mut cases = fixture::cases();
        cases[0].seconds = seconds;
        // Not all by the same factor: another setting may be the fastest.
        for (k, setting) in (1..).zip(&mut cases[0].costs[0].settings) {
            setting.points.iter_mut().for_each(|p| p.seconds *= seconds.powi(k));
        }
        let mut provenance = fixture::provenance();
        provenance.machine.started = format!("{seconds}");
        let page = page(&judge(&cases, provenance, &Recorded::default()), &cases).unwrap();
        let (before, rest) = page.split_once("<!-- machine: begin -->").unwrap();
        let (machine, after) = rest.split_once("<!-- machine: end -->").unwrap();
        (before.to_owned(), machine.to_owned(), after.to_owned())
    };
    let (one, two) = (again(1.0), again(7.0));
    assert!(one.0 == two.0 && one.2 == two.2);
    assert_ne!(one.1, two.1);
}

#[test]
fn degenerate_results_still_make_a_page() {
    let mut cases = fixture::cases();
    let beam = &mut cases[0];
    beam.families[0].members.clear();
    beam.budgets[0].parts.clear();
    beam.costs[0].settings[0].points.iter_mut().for_each(|p| p.error = None);
    beam.curves[0].series.truncate(1);
    beam.curves[0].series[0].y[3] = f64::NAN;
    beam.pictures[0].deformed_elements.clear();
    beam.pictures[0].bonds.push([0, 999]);
    beam.quantities[0].value = f64::INFINITY;
    cases[1].convergence[0].error = vec![0.0; 4];
    let results = judge(&cases, fixture::provenance(), &Recorded::default());
    let folder = tempfile::tempdir().unwrap();
    write_report(&results, &cases, folder.path()).unwrap();
    let page = std::fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert!(!page.contains("NaN") && page.contains("could not be measured"));
    assert!(seam_reports::html::page(&judge(&[], fixture::provenance(), &Recorded::default()), &[]).is_ok());
}
