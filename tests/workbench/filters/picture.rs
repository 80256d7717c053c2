//! Pictures to filter: made by rules, so that every run sees the same ones.

use dejag::picture::Pixel;

#[derive(Debug, Clone)]
pub(super) struct Picture {
    pub(super) size: [u32; 2],
    pub(super) pixels: Vec<Pixel>,
}

impl Picture {
    pub(super) fn from_fn(size: [u32; 2], pixel: impl Fn(u32, u32) -> Pixel) -> Self {
        let pixels = (0..size[0] * size[1]).map(|i| pixel(i % size[0], i / size[0])).collect();
        Self { size, pixels }
    }

    /// Opaque grey.
    pub(super) fn grey(size: [u32; 2], level: impl Fn(u32, u32) -> f32) -> Self {
        Self::from_fn(size, |x, y| grey(level(x, y)))
    }

    /// Black and white on either side of a line, seen at the pixels' centres: `distance` is below 0 on the black side.
    pub(super) fn half_plane(size: [u32; 2], distance: impl Fn(f64, f64) -> f64) -> Self {
        Self::grey(size, |x, y| f32::from(distance(f64::from(x) + 0.5, f64::from(y) + 0.5) > 0.0))
    }

    pub(super) fn at(&self, x: u32, y: u32) -> Pixel {
        self.pixels[(y * self.size[0] + x) as usize]
    }

    pub(super) fn at_mut(&mut self, x: u32, y: u32) -> &mut Pixel {
        &mut self.pixels[(y * self.size[0] + x) as usize]
    }

    pub(super) fn mirrored(&self) -> Self {
        Self::from_fn(self.size, |x, y| self.at(self.size[0] - 1 - x, y))
    }

    pub(super) fn upside_down(&self) -> Self {
        Self::from_fn(self.size, |x, y| self.at(x, self.size[1] - 1 - y))
    }

    pub(super) fn transposed(&self) -> Self {
        Self::from_fn([self.size[1], self.size[0]], |x, y| self.at(y, x))
    }

    pub(super) fn map(&self, pixel: impl Fn(Pixel) -> Pixel) -> Self {
        Self { size: self.size, pixels: self.pixels.iter().map(|p| pixel(*p)).collect() }
    }

    /// Whether both hold the very same bits.
    pub(super) fn same_bits(&self, other: &Self) -> bool {
        self.size == other.size && self.differing(other).is_empty()
    }

    /// Where bits differ.
    pub(super) fn differing(&self, other: &Self) -> Vec<[u32; 2]> {
        assert_eq!(self.size, other.size);
        let differ = |i: &usize| self.pixels[*i].map(f32::to_bits) != other.pixels[*i].map(f32::to_bits);
        let place = |i: usize| [i as u32 % self.size[0], i as u32 / self.size[0]];
        (0..self.pixels.len()).filter(differ).map(place).collect()
    }

    /// Largest difference of any channel.
    pub(super) fn largest_difference(&self, other: &Self) -> f32 {
        self.channel_differences(other).fold(0.0, f32::max)
    }

    pub(super) fn mean_difference(&self, other: &Self) -> f64 {
        let sum: f64 = self.channel_differences(other).map(f64::from).sum();
        sum / (4 * self.pixels.len()) as f64
    }

    fn channel_differences<'a>(&'a self, other: &'a Self) -> impl Iterator<Item = f32> + 'a {
        assert_eq!(self.size, other.size);
        let pairs = self.pixels.iter().flatten().zip(other.pixels.iter().flatten());
        pairs.map(|(a, b)| (a - b).abs())
    }
}

pub(super) fn grey(level: f32) -> Pixel {
    [level, level, level, 1.0]
}

/// Evenly spread over [0, 1), by number alone.
pub(super) fn random(seed: u32, index: u32) -> f32 {
    let mut z = (u64::from(seed) << 32 | u64::from(index)).wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 40) as f32 / (1 << 24) as f32
}

fn random_color(seed: u32, index: u32) -> Pixel {
    [random(seed, 3 * index), random(seed, 3 * index + 1), random(seed, 3 * index + 2), 1.0]
}

/// Each pixel a colour of its own.
pub(super) fn noise(size: [u32; 2], seed: u32) -> Picture {
    Picture::from_fn(size, |x, y| random_color(seed, y * size[0] + x))
}

pub(super) fn checkerboard(size: [u32; 2]) -> Picture {
    Picture::grey(size, |x, y| f32::from((x + y) % 2 == 1))
}

/// White wedges on black around a point off the middle: edges at all angles, thin towards the point.
pub(super) fn star(size: [u32; 2]) -> Picture {
    let [cx, cy] = [0.47, 0.55].map(|part| part * f64::from(size[0]));
    Picture::half_plane(size, |x, y| (11.0 * (y - cy).atan2(x - cx)).sin())
}

/// Rectangles and discs of all colours over one another: lines, corners and contrasts of every kind.
pub(super) fn confetti(size: [u32; 2], seed: u32) -> Picture {
    let side = size[0].max(size[1]) as f32;
    let shape = |k: u32, x: f32, y: f32| {
        let of = |n: u32| random(seed + 1, 8 * k + n);
        let (dx, dy) = (x - of(0) * side, y - of(1) * side);
        let (a, b) = (1.0 + of(2) * side / 6.0, 1.0 + of(3) * side / 6.0);
        if k.is_multiple_of(2) { dx.abs() < a && dy.abs() < b } else { dx.hypot(dy) < a }
    };
    Picture::from_fn(size, |x, y| {
        let top = (0..60).rev().find(|k| shape(*k, x as f32 + 0.5, y as f32 + 0.5));
        top.map_or([0.2, 0.3, 0.4, 1.0], |k| random_color(seed, k))
    })
}

/// Three edges between black and white that rise one pixel in 40, and a bar without an end.
pub(super) fn long_lines(size: [u32; 2]) -> Picture {
    let third = f64::from(size[1]) / 3.0;
    Picture::half_plane(size, |x, y| {
        let rise = x / 40.0;
        let inside = |k: f64| y > k * third - 4.0 + rise && y < k * third + rise;
        if inside(1.0) || inside(2.0) || (y > 2.0 && y < 3.0) { 1.0 } else { -1.0 }
    })
}

pub(super) const PICTURES: usize = 5;

/// Pictures that find faults.
pub(super) fn hard(size: [u32; 2]) -> [(&'static str, Picture); PICTURES] {
    [
        ("star", star(size)),
        ("confetti", confetti(size, 5)),
        ("noise", noise(size, 9)),
        ("checkerboard", checkerboard(size)),
        ("long lines", long_lines(size)),
    ]
}
