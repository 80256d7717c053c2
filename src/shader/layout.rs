//! Structs shared by Rust and WGSL: declared once in Rust, held against WGSL by a test.

/// A Rust struct that a shader reads, as the test needs it.
#[derive(Debug, Clone, Copy)]
pub struct Layout {
    /// Of the struct, the same on both sides.
    pub name: &'static str,
    /// Bytes.
    pub size: usize,
    /// In order.
    pub fields: &'static [Field],
}

/// A field of a shared struct.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Field {
    /// The same on both sides.
    pub name: &'static str,
    /// Bytes from the struct's start.
    pub offset: usize,
    /// In WGSL's words, such as `vec4<f32>`.
    pub kind: &'static str,
}

/// A Rust type with a WGSL twin.
pub(crate) trait Twin {
    /// The twin's name in WGSL.
    const KIND: &'static str;
}

macro_rules! twins {
    ($($rust:ty = $wgsl:literal),* $(,)?) => { $(impl Twin for $rust { const KIND: &'static str = $wgsl; })* };
}
twins! {
    f32 = "f32",
    u32 = "u32",
    i32 = "i32",
    [f32; 2] = "vec2<f32>",
    [f32; 4] = "vec4<f32>",
    [u32; 2] = "vec2<u32>",
    [i32; 2] = "vec2<i32>",
    [u32; 4] = "vec4<u32>",
    [[f32; 4]; 3] = "mat3x4<f32>",
    [[f32; 4]; 4] = "mat4x4<f32>",
}

/// Declares a plain struct for a buffer, with its [`Layout`] for the test.
macro_rules! gpu_struct {
    ($(#[$meta:meta])* struct $name:ident { $($(#[$field_meta:meta])* $field:ident: $kind:ty,)* }) => {
        $(#[$meta])*
        #[repr(C)]
        #[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
        pub(crate) struct $name { $($(#[$field_meta])* pub(crate) $field: $kind,)* }

        impl $name {
            /// For the test that holds it against WGSL.
            pub(crate) const LAYOUT: $crate::shader::layout::Layout = $crate::shader::layout::Layout {
                name: stringify!($name),
                size: size_of::<Self>(),
                fields: &[$($crate::shader::layout::Field {
                    name: stringify!($field),
                    offset: std::mem::offset_of!($name, $field),
                    kind: <$kind as $crate::shader::layout::Twin>::KIND,
                },)*],
            };
        }
    };
}
pub(crate) use gpu_struct;
