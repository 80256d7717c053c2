//! Existing pictures through a filter: formats kept, folders walked, and nothing lost silently.

mod course;
mod formats;
mod places;

use dejag::capture::PictureFilter;
use dejag::methods::{METHODS, Spec};
use dejag::picture::{BitDepth, DisplayPicture};

use super::desk::{self, Desk};

/// The registry's first filter.
fn filter() -> &'static str {
    let takes_pictures = |name: &&str| Spec::parse(name).is_ok_and(|spec| PictureFilter::check(&spec).is_ok());
    METHODS.iter().map(|method| method.name).find(takes_pictures).expect("a filter is registered")
}

/// A bright, slanting half of a dark picture: edges for every filter.
fn jagged(width: u32, height: u32, alpha: f32) -> DisplayPicture {
    DisplayPicture::from_fn(width, height, |x, y| {
        let bright = x * height < y * width / 3 + width * height / 4;
        if bright { [0.9, 0.8, 0.7, alpha] } else { [0.1, 0.2, 0.3, alpha] }
    })
    .expect("a size")
}

fn put(desk: &Desk, name: &str, picture: &DisplayPicture) {
    picture.save_png(&desk.path(name), BitDepth::Eight, &[]).unwrap_or_else(|error| panic!("{name}: {error}"));
}

fn smoothed(desk: &Desk, arguments: &str) -> desk::Ran {
    let ran = desk.run(&format!("filter {arguments} -m {}", filter()));
    ran.succeeded();
    ran
}

fn refused(desk: &Desk, arguments: &str, code: i32, words: &[&str]) {
    desk.refuses(&format!("filter {arguments} -m {}", filter()), code, words);
}
