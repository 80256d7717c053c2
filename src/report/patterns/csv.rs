//! Errors of pixel means as comma-separated values (RFC 4180).

use crate::suite::IntegralRow;

/// A line for each pattern, part and number of samples, with a heading. The same rows give the same bytes.
#[must_use]
pub fn integral_csv(rows: &[IntegralRow]) -> String {
    let mut text = String::from("test,part,pattern,sets,spp,rms\n");
    for row in rows {
        let fields = [&row.test, &row.part, &row.pattern, &row.sets].map(|field| quoted(field));
        for error in &row.errors {
            text += &format!("{},{},{}\n", fields.join(","), error.spp, error.rms);
        }
    }
    text
}

/// In quotation marks where it has to be.
fn quoted(field: &str) -> String {
    if field.contains([',', '"', '\n', '\r']) { format!("\"{}\"", field.replace('"', "\"\"")) } else { field.to_owned() }
}
