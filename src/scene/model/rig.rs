//! The nodes of a model and how they move.

use glam::{DAffine3, DQuat, DVec3};

use super::animation::Animation;

/// A tree of transforms over time.
#[derive(Debug)]
pub(in crate::scene) struct Rig {
    /// Parents before their children.
    nodes: Vec<RigNode>,
    animation: Animation,
}

/// A node of the tree.
#[derive(Debug, Clone)]
pub(super) struct RigNode {
    /// In the model's list.
    pub(super) index: usize,
    /// A place before this one.
    pub(super) parent: Option<usize>,
    pub(super) local: Local,
}

/// A node's transform against its parent.
#[derive(Debug, Clone, Copy)]
pub(super) enum Local {
    Matrix(DAffine3),
    Parts { translation: DVec3, rotation: DQuat, scale: DVec3 },
}

impl Local {
    fn transform(&self) -> DAffine3 {
        match *self {
            Self::Matrix(matrix) => matrix,
            Self::Parts { translation, rotation, scale } => {
                DAffine3::from_scale_rotation_translation(scale, rotation, translation)
            }
        }
    }
}

impl Rig {
    pub(super) fn new(nodes: Vec<RigNode>, animation: Animation) -> Self {
        Self { nodes, animation }
    }

    /// Every node's transform at a time in seconds, in the model's space.
    pub(in crate::scene) fn pose(&self, time: f64) -> Vec<DAffine3> {
        let mut locals: Vec<Local> = self.nodes.iter().map(|node| node.local).collect();
        self.animation.apply(time, &mut locals);
        let mut pose: Vec<DAffine3> = Vec::with_capacity(locals.len());
        for (node, local) in self.nodes.iter().zip(&locals) {
            let parent = node.parent.map_or(DAffine3::IDENTITY, |parent| pose[parent]);
            pose.push(parent * local.transform());
        }
        pose
    }

    /// Seconds until the animation begins again; 0 where nothing moves.
    pub(super) fn duration(&self) -> f64 {
        self.animation.duration
    }

    /// Times at which the model takes all its poses, roughly.
    pub(super) fn sample_times(&self) -> impl Iterator<Item = f64> {
        let steps = if self.duration() > 0.0 { 12 } else { 1 };
        (0..steps).map(move |k| self.duration() * f64::from(k) / 12.0)
    }

    /// How errors call the node at a place.
    pub(super) fn node_name(&self, place: usize) -> usize {
        self.nodes[place].index
    }
}
