//! No anti-aliasing: one sample at each pixel's centre, as drawn. What every other method is measured from.

use crate::error::Result;
use crate::pass::{Context, Draw, FrameFacts, Inputs, Method, Needs, Pass, Recorder, Target, Technique};

pub(super) const METHOD: Method = Method {
    name: "none",
    summary: "one sample a pixel, as drawn",
    source: "",
    options: &[],
    configure: |_| Ok(Box::new(None)),
    shaders: &[],
    layouts: &[],
};

#[derive(Debug)]
struct None;

impl Technique for None {
    fn needs(&self) -> Needs {
        Needs::default()
    }

    fn build(&self, _: &Context<'_>) -> Result<Box<dyn Pass>> {
        Ok(Box::new(None))
    }
}

impl Pass for None {
    fn next_draw(&mut self, k: u32, _: &FrameFacts) -> Option<Draw> {
        (k == 0).then(|| Draw { target: Target::Output, ..Draw::default() })
    }

    fn record(&mut self, _: &mut Recorder<'_>, _: u32, _: &Inputs<'_>, _: &wgpu::TextureView) {}
}
