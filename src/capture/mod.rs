//! Scene and method to pictures.
//!
//! A [`Studio`] is a device with a scene on it. It prepares a [`Shot`] (a method on one frame at one size), which can be taken again
//! and again, with or without a clock; what comes of it is a [`Capture`]. A [`Reference`] is a shot too, of very many samples,
//! kept in a [`Cache`] and delivered with its own error. Scenes made of flat colours have an exact answer besides ([`analytic`]).

pub mod analytic;
mod cache;
mod geometry;
mod picture_filter;
mod present;
mod reference;
mod shot;
mod view;

pub use cache::{Cache, CacheEntry};
pub use geometry::{Geometry, GeometryShot};
pub use picture_filter::PictureFilter;
pub use present::Present;
pub use reference::{Halves, REFERENCE_SPEC, Reference, reference_key};
pub use shot::{Capture, Shot, Studio, Watch};
pub use view::{View, ViewKind};
