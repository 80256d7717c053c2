//! Annotations and summaries for GitHub.

use dejag::report::{annotations, job_summary};
use dejag::suite::DiffOutcome;

use super::checks::{HOSTILE, results};

/// Annotations of a kind that GitHub shows.
const SHOWN: usize = 10;

#[test]
fn what_is_not_the_same_is_an_error_up_to_nine() {
    for (wrong, lines, more) in [(0, 0, None), (9, 9, None), (10, 10, Some(1)), (500, 10, Some(491))] {
        let outcomes = [vec![DiffOutcome::Same; 3], vec![DiffOutcome::Missing; wrong]].concat();
        let said = annotations(&results(&outcomes), "dejag.toml");
        assert_eq!(said.len(), lines, "{wrong}");
        assert!(said.iter().all(|line| line.starts_with("::error file=dejag.toml,title=")), "{said:?}");
        if let Some(more) = more {
            assert_eq!(
                said.last().map(String::as_str),
                Some(&*format!("::error file=dejag.toml,title=dejag check::and {more} more"))
            );
        }
    }
    let said = annotations(&results(&[DiffOutcome::Different]), "a,b:c.toml");
    let start = "::error file=a%2Cb%3Ac.toml,title=different%3A case/0::3 of 768 pixels differ (0.3907%25), all within";
    assert!(said[0].starts_with(start), "{said:?}");
}

#[test]
fn causes_and_unused_goldens_are_said_once() {
    let mut results = results(&[DiffOutcome::Different; 40]);
    results.cases.iter_mut().for_each(|case| case.likely_causes = vec!["another driver".into()]);
    results.unused_goldens = vec!["llvmpipe/old.png".into(), "llvmpipe/older.png".into()];
    let said = annotations(&results, "dejag.toml");
    assert_eq!(said.len(), SHOWN + 2);
    assert_eq!(said[SHOWN], "::notice file=dejag.toml,title=likely causes::another driver");
    let unused = "::warning file=dejag.toml,title=goldens that no case uses%3A 2::llvmpipe/old.png%0Allvmpipe/older.png";
    assert_eq!(said[SHOWN + 1], unused);
}

#[test]
fn no_name_gives_a_command() {
    let mut results = results(&[DiffOutcome::Failed; 2]);
    for case in &mut results.cases {
        (case.id, case.pair.why) = (HOSTILE.into(), Some(HOSTILE.repeat(500)));
    }
    for line in annotations(&results, HOSTILE) {
        assert!(!line.contains(['\n', '\r']), "{line:?}");
        let (properties, _) = line.strip_prefix("::error ").and_then(|rest| rest.split_once("::")).expect("a command");
        let keys: Vec<&str> = properties.split(',').filter_map(|property| Some(property.split_once('=')?.0)).collect();
        assert_eq!(keys, ["file", "title"]);
    }
}

#[test]
fn the_summary_has_a_row_for_what_is_not_the_same() {
    let page = job_summary(&results(&[DiffOutcome::Same, DiffOutcome::Different, DiffOutcome::New]));
    assert!(page.starts_with("### dejag check: 1 same, 1 different, 1 new\n"), "{page}");
    let rows: Vec<&str> = page.lines().filter(|line| line.starts_with("| case/")).collect();
    let passes = "--max-pixels 3&#59; --per-channel 9/255&#59; --max-flip 0&#46;0321";
    assert_eq!(rows[0], format!("| case/1 | different | 3 | 0.0321 | --max-flip 0&#46;01 | {passes} |"));
    assert_eq!(rows[1], "| case/2 | new | – | – |  |  |");
    assert!(!job_summary(&results(&[DiffOutcome::Same])).contains("| case"));
}

#[test]
fn no_name_gives_markup() {
    let mut results = results(&[DiffOutcome::Failed]);
    (results.cases[0].id, results.cases[0].pair.why) = (HOSTILE.into(), Some(HOSTILE.into()));
    results.environment.key = HOSTILE.into();
    let page = job_summary(&results);
    let plain = job_summary(&self::results(&[DiffOutcome::Failed]));
    for mark in ['<', '>', '`', '*', '_', '[', '@', '"', '\n', '\u{1b}'] {
        let count = |text: &str| text.matches(mark).count();
        assert_eq!(count(&page), count(&plain), "{mark:?} in {page}");
    }
    assert_eq!(page.matches('|').count(), plain.matches('|').count());
}

#[test]
fn the_summary_stays_below_what_github_takes() {
    let mut results = results(&[DiffOutcome::Different; 2_000]);
    for case in &mut results.cases {
        case.id = "<é€>".repeat(10_000);
        case.pair.knobs[2].option = "&".repeat(10_000);
    }
    let page = job_summary(&results);
    assert!(page.len() < 1 << 20, "{} bytes", page.len());
    let rows = page.lines().filter(|line| line.starts_with("| &")).count();
    assert!(rows > 100 && page.ends_with(&format!("\n{} rows are left out; the report has all.\n", 2_000 - rows)), "{rows}");
}
