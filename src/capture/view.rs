//! Looking at what lies beside the colour: depth, motion, ids, and every intermediate of a method.

use crate::error::{Error, Result, unknown};
use crate::methods::Spec;
use crate::pass::Extras;
use crate::picture::{DisplayPicture, LinearPicture};
use crate::sampling::hash;

use super::geometry::read_drawn;
use super::shot::{Studio, Watch};

/// Something to look at.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ViewKind {
    /// The picture itself.
    Color,
    /// Reversed depth: 1 near, 0 at infinity.
    Depth,
    /// Motion vectors in pixels, from this frame to the previous one.
    Motion,
    /// Object ids, 0 for the background.
    Ids,
    /// A method's intermediate by name.
    Intermediate(String),
}

impl std::fmt::Display for ViewKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Color => "colour",
            Self::Depth => "depth",
            Self::Motion => "motion",
            Self::Ids => "ids",
            Self::Intermediate(name) => name,
        })
    }
}

impl std::str::FromStr for ViewKind {
    type Err = std::convert::Infallible;

    fn from_str(text: &str) -> std::result::Result<Self, Self::Err> {
        Ok(match text {
            "color" | "colour" => Self::Color,
            "depth" => Self::Depth,
            "motion" => Self::Motion,
            "ids" => Self::Ids,
            other => Self::Intermediate(other.to_owned()),
        })
    }
}

/// A view, as numbers and as a picture to look at.
#[derive(Debug, Clone)]
pub struct View {
    /// The numbers themselves; what an EXR file gets.
    pub data: LinearPicture,
    /// Mapped to colours; what a PNG file gets.
    pub display: DisplayPicture,
}

impl Studio<'_> {
    /// Draws one frame and reads a view of it. Depth, motion and ids are those at the pixels' centres, whatever the method.
    ///
    /// # Errors
    /// [`Error::Request`] for a view that the method does not have, with those it has.
    pub fn view(&mut self, kind: &ViewKind, spec: &Spec, frame: u32, size: [u32; 2], watch: &mut dyn Watch) -> Result<View> {
        match kind {
            ViewKind::Color => {
                let capture = self.capture(spec, frame, size, watch)?;
                let data = match capture.linear {
                    Some(linear) => linear,
                    None => capture.display.to_linear(),
                };
                Ok(View { data, display: capture.display })
            }
            ViewKind::Intermediate(name) => self.intermediate(name, spec, frame, size, watch),
            ViewKind::Depth | ViewKind::Motion | ViewKind::Ids => self.geometry(kind, frame, size),
        }
    }

    fn geometry(&mut self, kind: &ViewKind, frame: u32, size: [u32; 2]) -> Result<View> {
        let plain = Spec::parse("none")?;
        let extras = Extras { depth: true, motion: *kind == ViewKind::Motion, ids: *kind == ViewKind::Ids, ..Extras::default() };
        let mut shot = self.shot_of(&[("none", &*plain.stages[0].technique)], frame, size, extras)?;
        self.take(&mut shot, None, &mut ())?;
        let data = read_drawn(self, &shot, |targets| match kind {
            ViewKind::Motion => targets.motion.as_ref(),
            ViewKind::Ids => targets.ids.as_ref(),
            _ => Some(&targets.depth),
        })?;
        let display = match kind {
            ViewKind::Motion => colored(&data, motion_color),
            ViewKind::Ids => colored(&data, |p| id_color(p[0])),
            // The fourth root spreads what reversed depth crowds near 0.
            _ => colored(&data, |p| [p[0].clamp(0.0, 1.0).sqrt().sqrt(); 3]),
        };
        Ok(View { data, display: display? })
    }

    fn intermediate(&mut self, name: &str, spec: &Spec, frame: u32, size: [u32; 2], watch: &mut dyn Watch) -> Result<View> {
        let mut shot = self.shot(spec, frame, size)?;
        let others = ["colour", "depth", "motion", "ids"];
        check_view(spec, name, &[&others[..], &shot.views()].concat())?;
        self.take_alone(&mut shot, watch)?;
        let view = shot.view(self.gpu, name)?;
        let data = self.gpu.read_linear(view.texture())?;
        // Sums are 32 bit floats; a filter's weights, whose alpha is no weight of a sum, have no need of them.
        let sum = view.texture().format() == wgpu::TextureFormat::Rgba32Float;
        Ok(View::of_numbers(if sum { normalized(data)? } else { data }))
    }
}

impl View {
    /// Numbers as they are.
    pub(super) fn of_numbers(data: LinearPicture) -> Self {
        Self { display: data.to_display(), data }
    }
}

/// Whether there is a view of this name; else an error that lists those there are.
pub(super) fn check_view(spec: &Spec, name: &str, names: &[&str]) -> Result<()> {
    if names.is_empty() {
        return Err(Error::Request(format!("{spec} has no views")));
    }
    if names.contains(&name) { Ok(()) } else { Err(unknown(&format!("view of {spec}"), name, names)) }
}

/// Sums carry their weight in alpha: shows the mean they stand for.
fn normalized(data: LinearPicture) -> Result<LinearPicture> {
    let [width, height] = data.size();
    let mean = |[r, g, b, a]: [f32; 4]| {
        if a > 0.0 && a != 1.0 { [r / a, g / a, b / a, 1.0] } else { [r, g, b, a] }
    };
    LinearPicture::new(width, height, data.into_pixels().into_iter().map(mean).collect())
}

fn colored(data: &LinearPicture, color: impl Fn([f32; 4]) -> [f32; 3]) -> Result<DisplayPicture> {
    let pixels = data.pixels().iter().map(|p| {
        let [r, g, b] = color(*p);
        [r, g, b, 1.0]
    });
    DisplayPicture::new(data.width(), data.height(), pixels.collect())
}

/// Grey for rest; red grows to the right, green downward, full at 16 pixels a frame.
fn motion_color([x, y, _, _]: [f32; 4]) -> [f32; 3] {
    [0.5 + x / 32.0, 0.5 + y / 32.0, 0.5].map(|c| c.clamp(0.0, 1.0))
}

/// Black for the background, a bright colour of its own for each object.
fn id_color(id: f32) -> [f32; 3] {
    if id == 0.0 {
        return [0.0; 3];
    }
    let bits = hash(id as u64);
    [0, 8, 16].map(|shift| 0.3 + 0.7 * ((bits >> shift & 0xff) as f32 / 255.0))
}
