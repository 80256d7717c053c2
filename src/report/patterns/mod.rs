//! Pictures of point sets, of what is measured on them, and their figures as rows of text.

mod csv;
mod panels;
mod raster;
mod series;
mod spectrum;
#[cfg(test)]
mod tests;

pub use csv::integral_csv;
pub use panels::{Panel, Panels};
pub use raster::{deviation_map, power_map};
pub use series::{DETAIL_PX, SeriesPicture, SeriesReport};
pub use spectrum::spectrum_svg;
