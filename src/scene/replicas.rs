//! Many copies of an object: rows of rows, and random places.

use glam::{DAffine3, DMat3, DVec3};

use super::document::{ObjectDoc, Region, RepeatDoc, ScatterDoc};
use super::motion::rotation_xyz;
use super::place::Place;
use super::random::Pcg32;
use crate::error::Result;

/// Instances of a scene, and copies of an object that are joined into one mesh.
pub(super) const MOST_INSTANCES: usize = 65_535;
const MOST_JOINED: usize = 1_000_000;

/// One of an object's copies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Replica {
    /// Applied in world space.
    outer: DAffine3,
    /// Applied about the object's position.
    turn: DMat3,
    /// Applied in the object's own space.
    inner: DMat3,
    /// Factor on the vertex colours.
    pub(super) shade: f64,
}

impl Replica {
    /// The object itself.
    pub(super) const ITSELF: Self = Self { outer: DAffine3::IDENTITY, turn: DMat3::IDENTITY, inner: DMat3::IDENTITY, shade: 1.0 };

    fn moved(offset: DVec3) -> Self {
        Self { outer: DAffine3::from_translation(offset), ..Self::ITSELF }
    }

    /// Where the copy is when the object itself is there.
    pub(super) fn place(&self, own: &DAffine3) -> DAffine3 {
        self.outer * DAffine3::from_mat3_translation(self.turn * own.matrix3 * self.inner, own.translation)
    }
}

/// All copies of an object, itself among them.
pub(super) fn replicas(doc: &ObjectDoc, at: &Place<'_>) -> Result<Vec<Replica>> {
    check_total(doc, at)?;
    let mut copies = vec![Replica::ITSELF];
    let repeats = at.key("repeat");
    for (k, repeat) in doc.repeat.iter().enumerate() {
        let row = row(repeat, &repeats.item(k))?;
        copies = copies.iter().flat_map(|copy| row.iter().map(|next| combine(copy, next))).collect();
    }
    if !doc.places.is_empty() {
        let places: Vec<Replica> = doc.places.iter().map(|&place| Replica::moved(place.into())).collect();
        copies = copies.iter().flat_map(|copy| places.iter().map(|next| combine(copy, next))).collect();
    }
    if let Some(scatter) = &doc.scatter {
        let places = scattered(scatter, doc.join, &at.key("scatter"))?;
        copies = copies.iter().flat_map(|copy| places.iter().map(|next| combine(copy, next))).collect();
    }
    Ok(copies)
}

/// Refuses too many before any is made.
fn check_total(doc: &ObjectDoc, at: &Place<'_>) -> Result<()> {
    let most = if doc.join { MOST_JOINED } else { MOST_INSTANCES };
    let mut total: usize = 1;
    let mut multiply = |count: usize, at: &Place<'_>| {
        total = total.saturating_mul(count);
        if total <= most {
            return Ok(());
        }
        Err(at.error(format!("{total} copies are too many; expected at most {most} in all")))
    };
    let repeats = at.key("repeat");
    for (k, repeat) in doc.repeat.iter().enumerate() {
        let place = repeats.item(k);
        let place = place.key("count");
        multiply(place.count(repeat.count, 1..=MOST_JOINED as u32)? as usize, &place)?;
    }
    if !doc.places.is_empty() {
        multiply(doc.places.len(), &at.key("places"))?;
    }
    if let Some(scatter) = &doc.scatter {
        let place = at.key("scatter");
        let place = place.key("count");
        multiply(place.count(scatter.count, 1..=MOST_JOINED as u32)? as usize, &place)?;
    }
    Ok(())
}

fn combine(first: &Replica, second: &Replica) -> Replica {
    Replica {
        outer: first.outer * second.outer,
        turn: first.turn * second.turn,
        inner: first.inner * second.inner,
        shade: first.shade * second.shade,
    }
}

fn row(doc: &RepeatDoc, at: &Place<'_>) -> Result<Vec<Replica>> {
    let factor = at.key("scale").within(doc.scale, 0.01..=100.0)?;
    let size_of_last = factor.powf(f64::from(doc.count - 1));
    if !(1e-6..=1e6).contains(&size_of_last) {
        return Err(at
            .key("scale")
            .error(format!("the last copy would be {size_of_last:e} times as large; expected 1e-6 to 1e6")));
    }
    let copy = |k: u32| {
        let k = f64::from(k);
        let turn = rotation_xyz(DVec3::from(doc.rotate_deg) * k);
        let step = DVec3::from(doc.step) * k;
        let (outer, turn) = match doc.around.map(DVec3::from) {
            Some(around) => (DAffine3::from_mat3_translation(turn, around - turn * around + step), DMat3::IDENTITY),
            None => (DAffine3::from_translation(step), turn),
        };
        Replica { outer, turn, inner: DMat3::from_diagonal(DVec3::splat(factor.powf(k))), shade: 1.0 }
    };
    Ok((0..doc.count).map(copy).collect())
}

fn scattered(doc: &ScatterDoc, joined: bool, at: &Place<'_>) -> Result<Vec<Replica>> {
    let (min, max) = (DVec3::from(doc.min), DVec3::from(doc.max));
    if min.cmpgt(max).any() {
        return Err(at.key("max").error("a coordinate is below that of `min`; expected the box's upper corner"));
    }
    let scale = range(doc.scale.0, &at.key("scale"))?;
    let shade = match doc.shade {
        Some(_) if !joined => {
            return Err(at.key("shade").error("copies that differ in shade must be one mesh; add `join = true`"));
        }
        Some(shade) => range(shade.0, &at.key("shade"))?,
        None => [1.0; 2],
    };
    let mut random = Pcg32::new(u64::from(doc.seed));
    let copy = |_| {
        let offset = min + (max - min) * point(&mut random, doc.within);
        let turn = DVec3::from(doc.rotate_deg.0.map(|limit| random.between(-limit, limit)));
        let size = random.between(scale[0], scale[1]);
        Replica {
            outer: DAffine3::from_translation(offset),
            turn: rotation_xyz(turn),
            inner: DMat3::from_diagonal(DVec3::splat(size)),
            shade: random.between(shade[0], shade[1]),
        }
    };
    Ok((0..doc.count).map(copy).collect())
}

/// A point of the region in the unit cube.
fn point(random: &mut Pcg32, region: Region) -> DVec3 {
    // Half of the cube lies in the ball, so this ends at once.
    loop {
        let point = DVec3::new(random.unit(), random.unit(), random.unit());
        if region == Region::Box || point.distance(DVec3::splat(0.5)) <= 0.5 {
            return point;
        }
    }
}

fn range([low, high]: [f64; 2], at: &Place<'_>) -> Result<[f64; 2]> {
    if (1e-3..=1e3).contains(&low) && low <= high && high <= 1e3 {
        return Ok([low, high]);
    }
    Err(at.error(format!("[{low}, {high}] is not a range of factors; expected the smaller first, from 0.001 to 1000")))
}
