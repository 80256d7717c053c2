//! WGSL: parts joined into modules, places mapped back to the parts, and structs that both sides share.
//!
//! A shader is a list of parts, each a file under `shaders/`; there is no import syntax and no build script. Structs that cross
//! from Rust to WGSL are declared with `gpu_struct!`, and a test holds each against the module that reads it.

pub(crate) mod layout;
#[cfg(all(test, feature = "workbench"))]
mod tests;

pub use layout::{Field, Layout};

/// A WGSL module made of files.
#[derive(Debug, Clone, Copy)]
pub struct Source {
    /// Names the module in labels and errors.
    pub name: &'static str,
    /// File name and text of each part, in order.
    pub parts: &'static [Part],
}

/// One file of a module.
#[derive(Debug, Clone, Copy)]
pub struct Part {
    /// Path under `shaders/`.
    pub file: &'static str,
    /// The file's text.
    pub text: &'static str,
}

/// `part!("present.wgsl")`: a file under `shaders/`, embedded.
macro_rules! part {
    ($file:literal) => {
        $crate::shader::Part { file: $file, text: include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders/", $file)) }
    };
}
pub(crate) use part;

impl Source {
    /// The parts' texts, one after the other.
    #[must_use]
    pub fn text(&self) -> String {
        self.parts.iter().flat_map(|part| [part.text, "\n"]).collect()
    }

    /// File and line (from 1) of a line (from 1) of [`Source::text`].
    #[must_use]
    pub fn locate(&self, line: usize) -> (&'static str, usize) {
        let mut first = 1;
        for part in self.parts {
            let lines = part.text.matches('\n').count() + 1;
            if line < first + lines {
                return (part.file, line - first + 1);
            }
            first += lines;
        }
        (self.name, line)
    }

    /// Compiles the module. Errors arrive in the device's error scope.
    #[must_use]
    pub fn module(&self, device: &wgpu::Device) -> wgpu::ShaderModule {
        device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(self.name),
            source: wgpu::ShaderSource::Wgsl(self.text().into()),
        })
    }
}

#[cfg(test)]
mod places {
    use super::*;

    const TWO: Source = Source {
        name: "two",
        parts: &[Part { file: "a.wgsl", text: "one\ntwo\n" }, Part { file: "b.wgsl", text: "three\nfour" }],
    };

    #[test]
    fn places_map_back_to_their_files() {
        let text = TWO.text();
        for (number, line) in text.lines().enumerate() {
            let expected = match line {
                "one" => ("a.wgsl", 1),
                "two" => ("a.wgsl", 2),
                "three" => ("b.wgsl", 1),
                "four" => ("b.wgsl", 2),
                _ => continue,
            };
            assert_eq!(TWO.locate(number + 1), expected);
        }
        assert_eq!(TWO.locate(99), ("two", 99));
    }
}
