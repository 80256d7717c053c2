//! Objects as they are drawn: what they are made of, where they stand, and how they come to a frame's instances.

use std::sync::Arc;

use glam::DAffine3;

use super::Mesh;
use super::frame::{Instance, View};
use super::model::Rig;
use super::motion::Motion;
use super::replicas::Replica;
use super::shapes::Wire;

/// An object with all its copies.
#[derive(Debug, Clone)]
pub(super) struct Group {
    pub(super) name: Option<String>,
    pub(super) motion: Motion,
    pub(super) replicas: Vec<Replica>,
    pub(super) parts: Vec<Part>,
    /// What moves the parts against each other, in a glTF model.
    pub(super) rig: Option<Arc<Rig>>,
}

/// A mesh and its material.
#[derive(Debug, Clone)]
pub(super) struct Part {
    pub(super) geometry: Geometry,
    pub(super) material: usize,
    /// The node of the rig that it hangs on.
    pub(super) node: usize,
}

/// Triangles, or what becomes triangles once the view is known.
#[derive(Debug, Clone)]
pub(super) enum Geometry {
    Mesh(Arc<Mesh>),
    Wire(Arc<Wire>),
}

impl Geometry {
    /// The largest coordinate.
    pub(super) fn reach(&self) -> f64 {
        match self {
            Self::Mesh(mesh) => mesh.bounds().map_or(0.0, |(low, high)| low.abs().max(high.abs()).max_element()),
            Self::Wire(wire) => wire.reach(),
        }
    }

    /// Triangles of one instance, at most.
    pub(super) fn triangle_limit(&self) -> usize {
        match self {
            Self::Mesh(mesh) => mesh.indices.len() / 3,
            Self::Wire(wire) => wire.triangle_limit(),
        }
    }
}

/// A moment: when, and what the camera sees of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moment {
    /// Seconds, now and one frame earlier.
    pub(super) times: [f64; 2],
    pub(super) view: View,
    pub(super) size: [u32; 2],
}

impl Group {
    /// How many ids the group takes, whether all its instances show or not.
    pub(super) fn id_count(&self) -> usize {
        self.replicas.len() * self.parts.len()
    }

    /// Everything of the group that shows at a moment. `first_id` is the group's first.
    pub(super) fn instances(&self, moment: &Moment, first_id: u32, out: &mut Vec<Instance>) {
        let own = moment.times.map(|time| self.motion.at(time));
        let poses = self.rig.as_ref().map(|rig| moment.times.map(|time| rig.pose(time)));
        let mut id = first_id;
        for replica in &self.replicas {
            for part in &self.parts {
                let world = [0, 1].map(|k| {
                    let node = poses.as_ref().map_or(DAffine3::IDENTITY, |poses| poses[k][part.node]);
                    replica.place(&own[k]) * node
                });
                out.extend(part.instance(world, moment, id));
                id += 1;
            }
        }
    }
}

impl Part {
    /// The part where it stands now and stood before; nothing where it has no extent or lies behind the camera.
    fn instance(&self, [now, before]: [DAffine3; 2], moment: &Moment, id: u32) -> Option<Instance> {
        if !has_extent(&now) {
            return None;
        }
        // An animation may come from beyond all bounds; then there is no motion to tell.
        let before = if before.is_finite() { before } else { now };
        let instance = |mesh, now, before| Instance {
            mesh,
            material: self.material,
            world_from_object: now,
            previous_world_from_object: before,
            id,
        };
        match &self.geometry {
            Geometry::Mesh(mesh) => Some(instance(mesh.clone(), now, before)),
            Geometry::Wire(wire) => {
                // A ribbon is made in world space; it moves as the points it was made from.
                let ribbon = wire.ribbon(id, &now, &moment.view, moment.size);
                let before = if before == now { DAffine3::IDENTITY } else { before * now.inverse() };
                (!ribbon.indices.is_empty()).then(|| instance(ribbon, DAffine3::IDENTITY, before))
            }
        }
    }
}

/// Whether a transform is finite and keeps a volume; an animation may shrink things to nothing.
pub(super) fn has_extent(transform: &DAffine3) -> bool {
    let m = &transform.matrix3;
    let lengths = [m.x_axis, m.y_axis, m.z_axis].map(glam::DVec3::length);
    transform.is_finite()
        && lengths.iter().all(|length| (1e-15..=1e18).contains(length))
        && m.determinant().abs() > 1e-9 * lengths.iter().product::<f64>()
}
