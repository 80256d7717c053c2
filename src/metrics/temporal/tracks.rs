//! Where what a pixel shows was seen in earlier frames: surfaces followed back by exact motion, a frame at a time.
//!
//! A pixel's surface is found again in the frame before if one of the four pixels around its place there moves along with it, that
//! is, if the way back and the way forth between the two frames cancel. Where none does, another surface was in front: the pixel was
//! uncovered in between. Object ids are not asked: a wire thinner than a pixel has its id at as few pixels as an aliased picture
//! has its colour, and just those that flicker would be left out.

use rayon::prelude::*;

use super::ghost::{AGES, Uncovered};
use crate::error::{Error, Result};
use crate::picture::{DisplayPicture, Pixel};

/// How many frames back pictures are compared, each gap by itself: flicker at several frequencies.
pub const GAPS: usize = 4;

/// How far the motion of two surfaces may differ that move together, in pixels a frame.
const TOGETHER_PX: f64 = 0.25;

/// Places this near to a pixel's centre, in pixels, are the pixel.
const NEAR_PX: f64 = 1.0 / 1024.0;

/// Motion between a frame and the one before, un-jittered: a vector in pixels, right and down, for each pixel in reading order.
#[derive(Debug, Clone)]
pub struct Flow {
    size: [u32; 2],
    back: Vec<[f32; 2]>,
    forth: Vec<[f32; 2]>,
}

/// A place in a picture, in pixels from the centre of the first.
pub type Place = [f64; 2];

impl Flow {
    /// `back` has a vector for each pixel of the later frame, to where its surface was; `forth` one for each of the earlier frame, to
    /// where its surface goes.
    ///
    /// # Errors
    /// [`Error::Request`] if they are not as many as pixels.
    pub fn new(size: [u32; 2], back: Vec<[f32; 2]>, forth: Vec<[f32; 2]>) -> Result<Self> {
        let pixels = u64::from(size[0]) * u64::from(size[1]);
        if pixels == 0 || [&back, &forth].iter().any(|vectors| vectors.len() as u64 != pixels) {
            return Err(Error::Request(format!("motion of {}x{} pixels needs a vector for each", size[0], size[1])));
        }
        Ok(Self { size, back, forth })
    }

    /// Whether a pixel of the earlier frame goes to where `back` came from.
    fn goes_along(&self, back: [f64; 2], pixel: usize) -> bool {
        let forth = self.forth[pixel];
        (0..2).all(|axis| (back[axis] + f64::from(forth[axis])).abs() <= TOGETHER_PX)
    }

    /// Whether a neighbour of a pixel of the later frame moves otherwise: the border of another surface.
    fn is_border(&self, pixel: usize) -> bool {
        let [width, height] = self.size.map(|side| side as usize);
        let (x, y) = (pixel % width, pixel / width);
        let near = |at: usize, side: usize| at.saturating_sub(1)..(at + 2).min(side);
        let own = self.back[pixel];
        let other = |neighbour: usize| {
            let motion = self.back[neighbour];
            !(0..2).all(|axis| f64::from((motion[axis] - own[axis]).abs()) <= TOGETHER_PX)
        };
        near(y, height).any(|y| near(x, width).any(|x| other(y * width + x)))
    }
}

/// Where each pixel's surface was in the frames before.
#[derive(Debug, Clone)]
pub struct Tracks {
    size: [u32; 2],
    /// For each gap, for each pixel: none where it was hidden, off the picture, or before a cut.
    places: Vec<Vec<Option<Place>>>,
    uncovered: Vec<Uncovered>,
}

/// Of one pixel.
#[derive(Debug, Clone, Copy, Default)]
struct Track {
    places: [Option<Place>; GAPS],
    /// How many frames ago another surface was in front, and where.
    uncovered: Option<(usize, Place)>,
}

impl Tracks {
    /// Follows every pixel through the flows, the latest first: the one between this frame and the one before, then the one before
    /// that. A cut ends the list; an empty one is a first frame.
    #[must_use]
    pub fn follow(size: [u32; 2], flows: &[&Flow]) -> Self {
        let pixels = size[0] as usize * size[1] as usize;
        let tracks: Vec<Track> = (0..pixels).into_par_iter().map(|pixel| track(flows, pixel)).collect();
        let gaps = flows.len().min(GAPS);
        let places = (0..gaps).map(|gap| tracks.iter().map(|track| track.places[gap]).collect()).collect();
        // At a border the other surface may well be part of the right answer.
        let uncovered = tracks.iter().enumerate().filter_map(|(pixel, track)| {
            let (age, place) = track.uncovered?;
            (!flows[0].is_border(pixel)).then_some(Uncovered { pixel, age, place })
        });
        Self { size, places, uncovered: uncovered.collect() }
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Where each pixel's surface was `gap` frames ago, from 1; none if no frame is known that long ago.
    #[must_use]
    pub fn places(&self, gap: usize) -> Option<&[Option<Place>]> {
        self.places.get(gap.checked_sub(1)?).map(Vec::as_slice)
    }

    /// The share of pixels that are found again after `gap` frames.
    #[must_use]
    pub fn followed(&self, gap: usize) -> f64 {
        self.places(gap).map_or(0.0, |places| places.iter().flatten().count() as f64 / places.len() as f64)
    }

    /// Pixels whose surface another one hid not long ago.
    #[must_use]
    pub fn uncovered(&self) -> &[Uncovered] {
        &self.uncovered
    }
}

fn track(flows: &[&Flow], pixel: usize) -> Track {
    let mut track = Track::default();
    let Some(width) = flows.first().map(|flow| flow.size[0] as usize) else { return track };
    let mut place = [(pixel % width) as f64, (pixel / width) as f64];
    let mut at = pixel;
    for (k, flow) in flows.iter().take(AGES).enumerate() {
        let back = flow.back[at].map(f64::from);
        place = settled([place[0] + back[0], place[1] + back[1]]);
        let Some(taps) = taps(place, flow.size) else { break };
        // Of those that go along, the nearest; the first where two are as near.
        let along = taps.iter().filter(|(pixel, weight)| *weight > 0.0 && flow.goes_along(back, *pixel));
        let nearest = along.fold(None, |best: Option<&(usize, f64)>, tap| match best {
            Some(found) if found.1 >= tap.1 => best,
            _ => Some(tap),
        });
        let Some((pixel, _)) = nearest else {
            track.uncovered = Some((k + 1, place));
            break;
        };
        at = *pixel;
        if k < GAPS {
            track.places[k] = Some(place);
        }
    }
    track
}

/// The pixel's centre where that is near enough: a motion by whole pixels then reads whole pixels.
fn settled(place: Place) -> Place {
    place.map(|x| if (x - x.round()).abs() <= NEAR_PX { x.round() } else { x })
}

/// The four pixels around a place and their bilinear weights; none off the picture.
fn taps([x, y]: Place, size: [u32; 2]) -> Option<[(usize, f64); 4]> {
    let [right, bottom] = size.map(|side| f64::from(side - 1));
    if !((0.0..=right).contains(&x) && (0.0..=bottom).contains(&y)) {
        return None;
    }
    let axis = |at: f64, last: f64| [(at.floor(), 1.0 - at.fract()), ((at.floor() + 1.0).min(last), at.fract())];
    let [[left, next], [top, below]] = [axis(x, right), axis(y, bottom)];
    let tap = |(x, u): (f64, f64), (y, v): (f64, f64)| (y as usize * size[0] as usize + x as usize, u * v);
    Some([tap(left, top), tap(next, top), tap(left, below), tap(next, below)])
}

/// A picture's colour at a place on it, bilinear.
pub(super) fn fetch(picture: &DisplayPicture, place: Place) -> Option<[f64; 3]> {
    let pixels: &[Pixel] = picture.pixels();
    let mut sum = [0.0; 3];
    for (pixel, weight) in taps(place, picture.size())? {
        if weight > 0.0 {
            let color = super::rgb(pixels[pixel]);
            sum = [0, 1, 2].map(|c| sum[c] + weight * color[c]);
        }
    }
    Some(sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::temporal::sample::{box_over_wall, pan};

    #[test]
    fn a_pan_is_followed_to_the_border() {
        let flow = pan([8, 2], [1.5, 0.0]);
        let tracks = Tracks::follow([8, 2], &[&flow, &flow]);
        let along = |gap| tracks.places(gap).expect("two flows").iter().take(8).flatten().map(|p| p[0]).collect::<Vec<_>>();
        assert_eq!(along(1), [1.5, 2.5, 3.5, 4.5, 5.5, 6.5]);
        assert_eq!(along(2), [3.0, 4.0, 5.0, 6.0, 7.0]);
        assert!(tracks.places(3).is_none() && tracks.places(0).is_none());
        assert_eq!(tracks.followed(1), 0.75);
        assert!(tracks.uncovered().is_empty());
    }

    #[test]
    fn what_a_thing_hid_is_uncovered_and_grows_older() {
        // Four pixels wide, two pixels a frame to the right; at x = 10 now.
        let flows: Vec<Flow> = (0..3).map(|ago| box_over_wall([24, 3], 10 - 2 * ago, 4, 2)).collect();
        let tracks = Tracks::follow([24, 3], &flows.iter().collect::<Vec<_>>());
        let middle = |age: usize| {
            let found = tracks.uncovered().iter().filter(|u| u.age == age && u.pixel / 24 == 1);
            found.map(|u| u.pixel % 24).collect::<Vec<_>>()
        };
        // The pixel beside the box is a border.
        assert_eq!(middle(1), [8]);
        assert_eq!(middle(2), [6, 7]);
        assert_eq!(middle(3), [4, 5]);
        // The box itself is found again.
        assert_eq!(tracks.places(1).expect("known")[24 + 11], Some([9.0, 1.0]));
    }

    #[test]
    fn motion_that_is_no_number_ends_a_track() {
        let flow = Flow::new([2, 1], vec![[f32::NAN, 0.0], [0.0, f32::INFINITY]], vec![[0.0; 2]; 2]).expect("two pixels");
        let tracks = Tracks::follow([2, 1], &[&flow]);
        assert_eq!(tracks.followed(1), 0.0);
        assert!(tracks.uncovered().is_empty());
    }

    #[test]
    fn a_vector_a_pixel() {
        assert!(Flow::new([2, 1], vec![[0.0; 2]; 2], vec![[0.0; 2]]).is_err());
        assert!(Flow::new([0, 1], Vec::new(), Vec::new()).is_err());
    }

    #[test]
    fn places_between_pixels_are_blended() {
        let ramp = DisplayPicture::from_fn(3, 2, |x, y| [x as f32, y as f32, 0.0, 1.0]).expect("a size");
        assert_eq!(fetch(&ramp, [0.5, 0.25]), Some([0.5, 0.25, 0.0]));
        assert_eq!(fetch(&ramp, [2.0, 1.0]), Some([2.0, 1.0, 0.0]));
        assert_eq!(fetch(&ramp, [2.1, 0.0]), None);
        assert_eq!(fetch(&ramp, [f64::NAN, 0.0]), None);
    }
}
