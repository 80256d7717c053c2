//! The workbench's own device: which adapter, what it can do, textures in and out, and every error as an error.

mod adapter;
mod device;
mod readback;
mod texels;
mod texture;
mod upload;

pub use adapter::{AdapterChoice, Card, adapters};
pub use device::Gpu;
pub use texels::{decode_texels, encode_texels};
pub use texture::{TextureSpec, bytes_of};
