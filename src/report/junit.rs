//! Results as JUnit XML, which CI systems show as tests: a pair is a test case.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesText, Event};

use super::pair_words::{name, sentences};
use crate::suite::{CheckResults, CheckedCase, DiffOutcome, DiffPair, DiffResults, Environment};

/// Results of `dejag diff`. Times are 0, so that the same files give the same bytes.
#[must_use]
pub fn diff_junit(results: &DiffResults) -> String {
    let cases = results.pairs.iter();
    let cases = cases.map(|pair| Case { name: name(pair), class_name: "dejag.diff", seconds: 0.0, pair, likely_causes: &[] });
    let properties = vec![("dejag", results.dejag.clone()), ("skipped files", results.skipped.to_string())];
    Suite { name: "dejag diff", properties, cases: cases.collect() }.xml()
}

/// Results of `dejag check`, with times in seconds; a case's class is its entry of the manifest.
#[must_use]
pub fn check_junit(results: &CheckResults) -> String {
    let cases = results.cases.iter().map(|CheckedCase { id, entry, likely_causes, pair, timing, .. }| Case {
        name: id,
        class_name: entry,
        seconds: timing.seconds,
        pair,
        likely_causes,
    });
    Suite { name: "dejag check", properties: properties(results), cases: cases.collect() }.xml()
}

fn properties(results: &CheckResults) -> Vec<(&'static str, String)> {
    let Environment { key, platform, stamp } = &results.environment;
    let mut properties = vec![
        ("dejag", results.dejag.clone()),
        ("command", results.command.join(" ")),
        ("manifest", results.manifest.clone()),
        ("environment", key.clone()),
        ("platform", platform.clone()),
    ];
    if let Some(stamp) = stamp {
        properties.push(("adapter", stamp.adapter.clone()));
        properties.push(("driver", format!("{} {}", stamp.driver, stamp.driver_version)));
        properties.push(("backend", stamp.backend.clone()));
    }
    if let Some(shard) = &results.shard {
        properties.push(("shard", format!("{}/{}", shard.index, shard.count)));
    }
    properties
}

struct Suite<'a> {
    name: &'static str,
    properties: Vec<(&'static str, String)>,
    cases: Vec<Case<'a>>,
}

struct Case<'a> {
    name: &'a str,
    class_name: &'a str,
    seconds: f64,
    pair: &'a DiffPair,
    likely_causes: &'a [String],
}

/// The element that says that a case did not pass; none if it did.
fn verdict(outcome: DiffOutcome) -> Option<&'static str> {
    match outcome {
        DiffOutcome::Same => None,
        DiffOutcome::Unreadable | DiffOutcome::Failed => Some("error"),
        DiffOutcome::Different
        | DiffOutcome::Size
        | DiffOutcome::Profile
        | DiffOutcome::Missing
        | DiffOutcome::New
        | DiffOutcome::Uncounted => Some("failure"),
    }
}

impl Suite<'_> {
    fn xml(&self) -> String {
        let mut writer = Writer::new_with_indent(Vec::new(), b' ', 2);
        self.write(&mut writer).expect("memory takes what is written");
        let mut text = String::from_utf8(writer.into_inner()).expect("only text was written");
        text.push('\n');
        text
    }

    fn write(&self, writer: &mut Writer<Vec<u8>>) -> io::Result<()> {
        writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
        writer.create_element("testsuites").write_inner_content(|writer| self.write_suite(writer))?;
        Ok(())
    }

    fn write_suite(&self, writer: &mut Writer<Vec<u8>>) -> io::Result<()> {
        let ended = |element| self.cases.iter().filter(|case| verdict(case.pair.outcome) == Some(element)).count().to_string();
        let suite = writer.create_element("testsuite").with_attributes([
            ("name", self.name),
            ("tests", &self.cases.len().to_string()),
            ("failures", &ended("failure")),
            ("errors", &ended("error")),
            ("skipped", "0"),
            ("time", &seconds(self.cases.iter().map(|case| case.seconds).sum())),
        ]);
        suite.write_inner_content(|writer| {
            writer.create_element("properties").write_inner_content(|writer| {
                for (name, value) in &self.properties {
                    let value = legal(value);
                    writer.create_element("property").with_attributes([("name", *name), ("value", &value)]).write_empty()?;
                }
                Ok(())
            })?;
            self.cases.iter().try_for_each(|case| case.write(writer))
        })?;
        Ok(())
    }
}

impl Case<'_> {
    fn write(&self, writer: &mut Writer<Vec<u8>>) -> io::Result<()> {
        let case = writer.create_element("testcase").with_attributes([
            ("name", legal(self.name).as_str()),
            ("classname", &legal(self.class_name)),
            ("time", &seconds(self.seconds)),
        ]);
        case.write_inner_content(|writer| {
            if let Some(element) = verdict(self.pair.outcome) {
                self.write_verdict(element, writer)?;
            }
            let files = self.files();
            if !files.is_empty() {
                writer.create_element("system-out").write_text_content(BytesText::new(&legal(&files.join("\n"))))?;
            }
            Ok(())
        })?;
        Ok(())
    }

    fn write_verdict(&self, element: &str, writer: &mut Writer<Vec<u8>>) -> io::Result<()> {
        let outcome = self.pair.outcome.as_str();
        let mut said = sentences(self.pair);
        let message = said.first().map_or(outcome.to_owned(), |first| legal(first));
        said.extend(self.likely_causes.iter().map(|cause| format!("likely cause: {cause}")));
        let element = writer.create_element(element).with_attributes([("type", outcome), ("message", &message)]);
        element.write_text_content(BytesText::new(&legal(&said.join("\n"))))?;
        Ok(())
    }

    /// The two pictures, and those of their differences.
    fn files(&self) -> Vec<String> {
        let sides = [("expected", &self.pair.expected), ("actual", &self.pair.actual)];
        let sides = sides.into_iter().filter_map(|(side, path)| Some(format!("{side}: {}", path.as_ref()?)));
        sides.chain(self.pair.pictures.iter().map(|path| format!("difference: {path}"))).collect()
    }
}

/// To the millisecond.
fn seconds(seconds: f64) -> String {
    format!("{seconds:.3}")
}

/// The text without characters that XML 1.0 has no way to write, escaped or not.
fn legal(text: &str) -> String {
    let legal = |c| matches!(c, '\t' | '\n' | '\r' | ' '..='\u{fffd}' | '\u{10000}'..);
    text.chars().map(|c| if legal(c) { c } else { '\u{fffd}' }).collect()
}
