//! Half planes at all angles, sampled off the pixels' centres: with areas for where the samples lie, the filtered pictures' mean is
//! nearer to exact coverage than 1x; with those of the mirrored places it is worse than 1x.

use glam::DVec2;
use wgpu::TextureFormat::Rgba8Unorm;

use super::{FOUR, Place, TWO};
use crate::capture::analytic::half_plane_share;
use crate::gpu::{AdapterChoice, Gpu};
use crate::methods::morphology::LineFilter;
use crate::methods::smaa::tests::{bytes, texture};
use crate::methods::smaa::{METHOD, rules};
use crate::pass::{Context, Inputs, Options, Recorder, Surface};
use crate::picture::{Pixel, srgb_decode};

const SIZE: [u32; 2] = [96, 96];
/// Lines that the picture's borders cut off end anywhere.
const BORDER: u32 = 24;
const CENTRE: [Place; 1] = [[0.0; 2]];

/// Where `normal . point` is at least `distance` it is white.
#[derive(Debug, Clone, Copy)]
struct HalfPlane {
    normal: DVec2,
    distance: f64,
}

impl HalfPlane {
    /// At every angle but those that need no anti-aliasing, each a little off the middle.
    fn all() -> impl Iterator<Item = Self> {
        (0..72).map(|i| {
            let normal = DVec2::from_angle((f64::from(i) * 5.0 + 1.3).to_radians());
            let middle = DVec2::new(f64::from(SIZE[0]), f64::from(SIZE[1])) / 2.0;
            Self { normal, distance: normal.dot(middle) + (f64::from(i) * 0.618).fract() - 0.5 }
        })
    }

    /// One sample a pixel at this place.
    fn sampled(self, [x, y]: Place) -> Vec<Pixel> {
        let white = |pixel: DVec2| self.normal.dot(pixel + 0.5 + DVec2::new(x, y)) >= self.distance;
        pixels().map(|pixel| [f32::from(white(pixel)); 3]).map(|[r, g, b]| [r, g, b, 1.0]).collect()
    }
}

fn pixels() -> impl Iterator<Item = DVec2> {
    (0..SIZE[0] * SIZE[1]).map(|i| DVec2::new(f64::from(i % SIZE[0]), f64::from(i / SIZE[0])))
}

/// The filter with areas for any of some places.
struct Lab {
    gpu: Gpu,
    filter: LineFilter,
    places: Vec<Place>,
}

impl Lab {
    fn new(places: Vec<Place>) -> Self {
        let gpu = Gpu::open(&AdapterChoice::Software).expect("an adapter");
        let rules = rules(&Options::parse("smaa", METHOD.options, None).expect("valid"));
        let surface = Surface::display(Rgba8Unorm);
        let context =
            Context { device: &gpu.device, queue: &gpu.queue, size: SIZE, input: surface, input_samples: 1, output: surface };
        let areas = rules.exact_areas(&context, &places);
        let filter = rules.build_with(&context, areas).expect("builds");
        Self { gpu, filter, places }
    }

    /// In linear light, sampled at one place and filtered as if at another.
    fn filtered(&mut self, edge: HalfPlane, sampled: Place, taken_for: Place) -> Vec<f64> {
        let place = self.places.iter().position(|place| *place == taken_for).expect("has areas");
        let [input, output] = [(); 2].map(|()| texture(&self.gpu, SIZE));
        self.gpu.upload(input.texture(), &edge.sampled(sampled)).expect("uploads");
        let mut encoder = self.gpu.encoder();
        self.filter.record_at(&mut Recorder::new(&mut encoder), place, &Inputs::picture(&input), &output);
        self.gpu.submit(encoder).expect("runs");
        bytes(&self.gpu, &output).chunks(4).map(|pixel| srgb_decode(f64::from(pixel[1]) / 255.0)).collect()
    }

    /// RMS error of the filtered pictures' mean, over the pixels that edges go through.
    fn error(&mut self, places: &[Place], taken_for: impl Fn(Place) -> Place) -> f64 {
        let (mut sum, mut count) = (0.0_f64, 0.0);
        for edge in HalfPlane::all() {
            let samples: Vec<_> = places.iter().map(|place| self.filtered(edge, *place, taken_for(*place))).collect();
            for (i, corner) in pixels().enumerate() {
                let inside = [corner.x, corner.y].iter().all(|at| (BORDER..SIZE[0] - BORDER).contains(&(*at as u32)));
                let exact = half_plane_share(corner, edge.normal, edge.distance);
                if inside && exact > 0.0 && exact < 1.0 {
                    let mean = samples.iter().map(|sample| sample[i]).sum::<f64>() / samples.len() as f64;
                    sum += (mean - exact).powi(2);
                    count += 1.0;
                }
            }
        }
        (sum / count).sqrt()
    }
}

#[test]
fn areas_count_for_where_the_samples_lie() {
    let mirrored = |[x, y]: Place| [-x, -y];
    let all = CENTRE.iter().chain(&TWO).chain(&FOUR).copied();
    let mut lab = Lab::new(all.flat_map(|place| [place, mirrored(place)]).collect());
    let once = lab.error(&CENTRE, |place| place);
    for (name, places) in [("two", &TWO[..]), ("four", &FOUR[..])] {
        let right = lab.error(places, |place| place);
        let centred = lab.error(places, |_| CENTRE[0]);
        let wrong = lab.error(places, mirrored);
        println!("{name} places: RMS {right:.4}; as if centred {centred:.4}, mirrored {wrong:.4}; one place {once:.4}");
        assert!(right < 0.75 * once && right < 0.65 * centred, "{name}: {right}, {centred}, {once}");
        assert!(wrong > 2.0 * right && wrong > once, "{name}: {wrong}, {right}, {once}");
    }
}

/// Each axis by itself: samples off along x alone or y alone want their own areas too.
#[test]
fn each_axis_has_its_own_areas() {
    for [a, b] in [[[0.25, 0.0], [-0.25, 0.0]], [[0.0, 0.25], [0.0, -0.25]]] {
        let pair = [a, b];
        let exchanged = |[x, y]: Place| [y, x];
        let mut lab = Lab::new(pair.into_iter().flat_map(|place| [place, exchanged(place)]).collect());
        let right = lab.error(&pair, |place| place);
        let wrong = lab.error(&pair, exchanged);
        println!("{pair:?}: RMS {right:.4}; axes exchanged {wrong:.4}");
        assert!(wrong > 1.2 * right, "{pair:?}: {wrong}, {right}");
    }
}
