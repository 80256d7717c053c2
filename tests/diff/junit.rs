//! JUnit XML, read back by a reader of XML.

use dejag::report::check_junit;
use dejag::suite::DiffOutcome;
use quick_xml::Reader;
use quick_xml::escape::unescape;
use quick_xml::events::{BytesStart, Event};

use super::checks::{ALL, HOSTILE, results};

/// An element with its attributes and the text directly in it.
#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    attributes: Vec<(String, String)>,
    pub(super) text: String,
}

impl Element {
    fn of(tag: &BytesStart<'_>) -> Self {
        let attributes = tag.attributes().map(|attribute| {
            let attribute = attribute.expect("an attribute");
            (attribute.key.as_ref().to_owned(), unescape(&attribute.value).expect("escaped").into_owned())
        });
        Self { name: tag.name().as_ref().to_owned(), attributes: attributes.collect(), text: String::new() }
    }

    #[track_caller]
    pub(super) fn get(&self, key: &str) -> &str {
        self.attributes.iter().find(|(name, _)| name == key).map_or_else(|| panic!("no {key} in {self:?}"), |(_, value)| value)
    }
}

/// All elements, in the order in which they begin. Fails if it is not well-formed.
pub(super) fn read(xml: &str) -> Vec<Element> {
    let mut reader = Reader::from_str(xml);
    let mut elements: Vec<Element> = Vec::new();
    let mut open = Vec::new();
    loop {
        let text = match reader.read_event().expect("well-formed") {
            Event::Start(tag) => {
                open.push(elements.len());
                elements.push(Element::of(&tag));
                continue;
            }
            Event::Empty(tag) => {
                elements.push(Element::of(&tag));
                continue;
            }
            Event::End(_) => {
                open.pop();
                continue;
            }
            Event::Text(text) => text.xml10_content().into_owned(),
            Event::GeneralRef(reference) => unescape(&format!("&{};", &*reference)).expect("known").into_owned(),
            Event::Decl(_) => continue,
            Event::Eof => break,
            other => panic!("{other:?} is not expected"),
        };
        if let Some(&index) = open.last() {
            elements[index].text.push_str(&text);
        }
    }
    assert!(open.is_empty(), "{open:?}");
    elements
}

/// Those of this name.
pub(super) fn named<'a>(elements: &'a [Element], name: &str) -> Vec<&'a Element> {
    elements.iter().filter(|element| element.name == name).collect()
}

#[test]
fn every_outcome_is_a_case_that_passes_fails_or_errs() {
    let elements = read(&check_junit(&results(&ALL)));
    let [suite] = named(&elements, "testsuite")[..] else { panic!("one suite: {elements:?}") };
    assert_eq!(["tests", "failures", "errors", "time"].map(|key| suite.get(key)), ["9", "6", "2", "2.250"]);
    let types = |name: &str| named(&elements, name).iter().map(|element| element.get("type")).collect::<Vec<_>>().join(" ");
    assert_eq!(types("failure"), "different size profile missing new uncounted");
    assert_eq!(types("error"), "unreadable failed");
    let cases = named(&elements, "testcase");
    assert_eq!(["name", "classname", "time"].map(|key| cases[1].get(key)), ["case/1", "case", "0.250"]);
    let properties: Vec<&str> = named(&elements, "property").into_iter().map(|property| property.get("name")).collect();
    let known = ["dejag", "command", "manifest", "environment", "platform", "adapter", "driver", "backend"];
    assert_eq!(properties, known);
}

#[test]
fn files_stand_in_the_output_of_a_case() {
    let elements = read(&check_junit(&results(&[DiffOutcome::Different])));
    let [files] = named(&elements, "system-out")[..] else { panic!("one output: {elements:?}") };
    assert_eq!(files.text, "expected: goldens/0.png\nactual: candidates/0.png\ndifference: differences/case.heat.png");
}

#[test]
fn no_name_breaks_the_xml() {
    let mut results = results(&[DiffOutcome::Failed]);
    let case = &mut results.cases[0];
    (case.id, case.entry) = (HOSTILE.into(), HOSTILE.into());
    (case.pair.why, case.likely_causes) = (Some(HOSTILE.into()), vec![HOSTILE.into()]);
    results.command = vec![HOSTILE.into()];
    let xml = check_junit(&results);
    let forbidden = |c: char| (c < ' ' && !"\t\n\r".contains(c)) || matches!(c, '\u{fffe}' | '\u{ffff}');
    assert!(!xml.contains(forbidden) && !xml.contains("]]>"), "{xml}");
    let elements = read(&xml);
    let shown = HOSTILE.replace(forbidden, "\u{fffd}");
    let ([case], [error]) = (&named(&elements, "testcase")[..], &named(&elements, "error")[..]) else { panic!("{elements:?}") };
    assert_eq!([case.get("name"), case.get("classname"), error.get("message")], [&*shown; 3]);
    assert_eq!(error.text, format!("{shown}\nlikely cause: {shown}"));
    assert_eq!(named(&elements, "property")[1].get("value"), shown);
}
