//! Numbers out of a model's buffers. Every access is checked against its view and its buffer before it is made, whatever the
//! model claims.

use gltf::json;
use json::accessor::{ComponentType, Type};
use json::validation::Checked;

use super::{Document, Failure};
use crate::error::Result;

/// Elements of an accessor that has no bytes of its own to bound it.
const MOST_ZEROS: usize = 1 << 24;

type AccessorIndex = json::Index<json::Accessor>;

/// An accessor whose claims have been checked.
struct Elements<'a> {
    bytes: &'a [u8],
    stride: usize,
    count: usize,
    component: ComponentType,
    components: usize,
    normalized: bool,
}

impl Document {
    /// All elements as `N` floats each; integers are converted as their `normalized` says. All of them are finite.
    pub(super) fn floats<const N: usize>(&self, index: AccessorIndex, what: &str) -> Result<Vec<[f32; N]>> {
        let accessor = self.accessor(index)?;
        if self.multiplicity(accessor, what)? != N {
            return Err(self.failure(format!("{what} should have {N} components each")));
        }
        let mut values = match self.dense(accessor, what)? {
            Some(elements) => (0..elements.count).map(|k| elements.floats(k)).collect(),
            None => vec![[0.0; N]; self.zeros(accessor, what)?],
        };
        if let Some((places, sparse)) = self.sparse(accessor, what)? {
            for (k, place) in places.into_iter().enumerate() {
                match values.get_mut(place as usize) {
                    Some(value) => *value = sparse.floats(k),
                    None => return Err(self.failure(format!("{what}: a sparse index is beyond the accessor's {}", values.len()))),
                }
            }
        }
        if values.iter().flatten().all(|value| value.is_finite()) {
            return Ok(values);
        }
        Err(self.failure(format!("{what} holds a number that is not finite")))
    }

    /// All elements as unsigned integers.
    pub(super) fn indices(&self, index: AccessorIndex, what: &str) -> Result<Vec<u32>> {
        let accessor = self.accessor(index)?;
        let elements = self.dense(accessor, what)?.filter(|elements| elements.components == 1 && accessor.sparse.is_none());
        let elements = elements.ok_or_else(|| self.failure(format!("{what} should be plain unsigned integers")))?;
        self.integers(&elements, what)
    }

    fn integers(&self, elements: &Elements<'_>, what: &str) -> Result<Vec<u32>> {
        let all: Option<Vec<u32>> = (0..elements.count).map(|k| elements.integer(k)).collect();
        all.ok_or_else(|| self.failure(format!("{what} should be unsigned integers of 8, 16 or 32 bits")))
    }

    fn accessor(&self, index: AccessorIndex) -> Result<&json::Accessor> {
        self.get(&self.root.accessors, index.value(), "accessor")
    }

    fn multiplicity(&self, accessor: &json::Accessor, what: &str) -> Result<usize> {
        match &accessor.type_ {
            Checked::Valid(kind @ (Type::Scalar | Type::Vec2 | Type::Vec3 | Type::Vec4)) => Ok(kind.multiplicity()),
            _ => Err(self.failure(format!("{what}: its accessor's type should be SCALAR or a vector"))),
        }
    }

    fn component(&self, accessor: &json::Accessor, what: &str) -> Result<ComponentType> {
        match accessor.component_type {
            Checked::Valid(json::accessor::GenericComponentType(component)) => Ok(component),
            Checked::Invalid => Err(self.failure(format!("{what}: its accessor's componentType does not exist"))),
        }
    }

    /// The elements that stand in a buffer view; none where the accessor has no view.
    fn dense(&self, accessor: &json::Accessor, what: &str) -> Result<Option<Elements<'_>>> {
        let (component, components) = (self.component(accessor, what)?, self.multiplicity(accessor, what)?);
        let count = self.size(accessor.count, what)?;
        let Some(view) = accessor.buffer_view else { return Ok(None) };
        let offset = accessor.byte_offset.unwrap_or_default();
        let (bytes, stride) = self.elements(view, offset, count, component.size() * components, what)?;
        Ok(Some(Elements { bytes, stride, count, component, components, normalized: accessor.normalized }))
    }

    /// How many zeros an accessor without a view stands for.
    fn zeros(&self, accessor: &json::Accessor, what: &str) -> Result<usize> {
        let count = self.size(accessor.count, what)?;
        if count <= MOST_ZEROS {
            return Ok(count);
        }
        Err(self.failure(format!("{what}: {count} elements without bytes; expected at most {MOST_ZEROS}")))
    }

    /// The places of the elements that differ, and those elements.
    fn sparse(&self, accessor: &json::Accessor, what: &str) -> Result<Option<(Vec<u32>, Elements<'_>)>> {
        let Some(sparse) = &accessor.sparse else { return Ok(None) };
        let count = self.size(sparse.count, what)?;
        let Checked::Valid(json::accessor::IndexComponentType(place)) = sparse.indices.component_type else {
            return Err(self.failure(format!("{what}: its sparse indices' componentType does not exist")));
        };
        let indices = &sparse.indices;
        let (bytes, stride) = self.elements(indices.buffer_view, indices.byte_offset, count, place.size(), what)?;
        let places = Elements { bytes, stride, count, component: place, components: 1, normalized: false };
        let (component, components) = (self.component(accessor, what)?, self.multiplicity(accessor, what)?);
        let values = &sparse.values;
        let (bytes, stride) =
            self.elements(values.buffer_view, values.byte_offset, count, component.size() * components, what)?;
        let values = Elements { bytes, stride, count, component, components, normalized: accessor.normalized };
        Ok(Some((self.integers(&places, what)?, values)))
    }

    /// The bytes of `count` elements from `offset` in a view, and the distance from one to the next.
    fn elements(
        &self,
        view: json::Index<json::buffer::View>,
        offset: json::validation::USize64,
        count: usize,
        size: usize,
        what: &str,
    ) -> Result<(&[u8], usize)> {
        let (bytes, stride) = self.view(view, what)?;
        let stride = stride.unwrap_or(size);
        if stride < size {
            return Err(self.failure(format!("{what}: its view's byteStride of {stride} is less than an element's {size} bytes")));
        }
        let offset = self.size(offset, what)?;
        let length = count.checked_sub(1).map_or(Some(0), |steps| steps.checked_mul(stride)?.checked_add(size));
        let end = length.and_then(|length| offset.checked_add(length));
        match end.and_then(|end| bytes.get(offset..end)) {
            Some(bytes) => Ok((bytes, stride)),
            None => Err(self.failure(format!("{what}: its accessor reaches beyond its buffer view of {} bytes", bytes.len()))),
        }
    }

    /// A buffer view's bytes, and its stride where it has one.
    pub(super) fn view(&self, index: json::Index<json::buffer::View>, what: &str) -> Result<(&[u8], Option<usize>)> {
        let view = self.get(&self.root.buffer_views, index.value(), "buffer view")?;
        let buffer = self.get(&self.buffers, view.buffer.value(), "buffer")?;
        let offset = self.size(view.byte_offset.unwrap_or_default(), what)?;
        let end = offset.checked_add(self.size(view.byte_length, what)?);
        match end.and_then(|end| buffer.get(offset..end)) {
            Some(bytes) => Ok((bytes, view.byte_stride.map(|stride| stride.0))),
            None => Err(self.failure(format!("{what}: its buffer view reaches beyond its buffer of {} bytes", buffer.len()))),
        }
    }

    fn size(&self, size: json::validation::USize64, what: &str) -> Result<usize> {
        usize::try_from(size.0).map_err(|_| self.failure(format!("{what}: {} is too large", size.0)))
    }
}

impl Elements<'_> {
    /// An element's bytes; `elements` has seen that they are there.
    fn component_bytes<const B: usize>(&self, element: usize, component: usize) -> [u8; B] {
        let start = element * self.stride + component * B;
        self.bytes.get(start..).and_then(<[u8]>::first_chunk).copied().unwrap_or([0; B])
    }

    fn floats<const N: usize>(&self, element: usize) -> [f32; N] {
        std::array::from_fn(|component| self.float(element, component))
    }

    /// As glTF 2.0 section 3.11 (animations) and KHR_mesh_quantization convert integers.
    fn float(&self, element: usize, component: usize) -> f32 {
        let (value, largest) = match self.component {
            ComponentType::F32 => return f32::from_le_bytes(self.component_bytes(element, component)),
            ComponentType::I8 => (f32::from(i8::from_le_bytes(self.component_bytes(element, component))), 127.0),
            ComponentType::U8 => (f32::from(u8::from_le_bytes(self.component_bytes(element, component))), 255.0),
            ComponentType::I16 => (f32::from(i16::from_le_bytes(self.component_bytes(element, component))), 32_767.0),
            ComponentType::U16 => (f32::from(u16::from_le_bytes(self.component_bytes(element, component))), 65_535.0),
            ComponentType::U32 => (u32::from_le_bytes(self.component_bytes(element, component)) as f32, u32::MAX as f32),
        };
        if self.normalized { (value / largest).max(-1.0) } else { value }
    }

    fn integer(&self, element: usize) -> Option<u32> {
        match self.component {
            ComponentType::U8 => Some(u32::from(u8::from_le_bytes(self.component_bytes(element, 0)))),
            ComponentType::U16 => Some(u32::from(u16::from_le_bytes(self.component_bytes(element, 0)))),
            ComponentType::U32 => Some(u32::from_le_bytes(self.component_bytes(element, 0))),
            ComponentType::I8 | ComponentType::I16 | ComponentType::F32 => None,
        }
    }
}
