//! A model's node tree, flattened so that parents come before their children.

use glam::{DAffine3, DMat3, DQuat, DVec3};
use gltf::json;

use super::rig::{Local, RigNode};
use super::{Document, Failure};
use crate::error::Result;

/// The nodes of the model's scene.
pub(super) struct Tree {
    pub(super) nodes: Vec<RigNode>,
    /// Place in `nodes` of each node of the model that is in the scene.
    pub(super) places: Vec<Option<usize>>,
    /// A node's place and the index of its mesh.
    pub(super) meshes: Vec<(usize, usize)>,
}

/// Walks the default scene, or the first one, or every node without a parent.
pub(super) fn tree(document: &mut Document) -> Result<Tree> {
    let mut tree = Tree { nodes: Vec::new(), places: vec![None; document.root.nodes.len()], meshes: Vec::new() };
    // Last in, first out; reversed, so that nodes are met in the model's order.
    let mut open: Vec<(usize, Option<usize>)> = roots(document)?.into_iter().rev().map(|root| (root, None)).collect();
    while let Some((index, parent)) = open.pop() {
        let node = document.get(&document.root.nodes, index, "node")?.clone();
        if tree.places[index].is_some() {
            return Err(document.failure(format!("node {index} is met twice: it has two parents or is its own ancestor")));
        }
        let place = tree.nodes.len();
        tree.places[index] = Some(place);
        tree.nodes.push(RigNode { index, parent, local: local(document, &node, index)? });
        if let Some(mesh) = node.mesh {
            tree.meshes.push((place, mesh.value()));
        }
        if node.skin.is_some() {
            document.warn(format!("node {index} has a skin; its mesh is drawn as it was bound"));
        }
        open.extend(node.children.iter().flatten().rev().map(|child| (child.value(), Some(place))));
    }
    Ok(tree)
}

fn roots(document: &Document) -> Result<Vec<usize>> {
    let root = &document.root;
    let scene = match root.scene {
        Some(scene) => Some(document.get(&root.scenes, scene.value(), "scene")?),
        None => root.scenes.first(),
    };
    if let Some(scene) = scene {
        return Ok(scene.nodes.iter().map(json::Index::value).collect());
    }
    let mut has_parent = vec![false; root.nodes.len()];
    for child in root.nodes.iter().flat_map(|node| node.children.iter().flatten()) {
        if let Some(flag) = has_parent.get_mut(child.value()) {
            *flag = true;
        }
    }
    Ok((0..root.nodes.len()).filter(|&node| !has_parent[node]).collect())
}

fn local(document: &Document, node: &json::Node, index: usize) -> Result<Local> {
    if let Some(m) = node.matrix {
        let m = m.map(f64::from);
        if !m.iter().all(|x| x.is_finite()) || [m[3], m[7], m[11], m[15]] != [0.0, 0.0, 0.0, 1.0] {
            return Err(document.failure(format!("node {index}: its matrix is not an affine transform")));
        }
        let column = |k: usize| DVec3::new(m[k], m[k + 1], m[k + 2]);
        let linear = DMat3::from_cols(column(0), column(4), column(8));
        return Ok(Local::Matrix(DAffine3::from_mat3_translation(linear, column(12))));
    }
    let rotation = DQuat::from_array(node.rotation.unwrap_or_default().0.map(f64::from));
    let translation = DVec3::from(node.translation.unwrap_or_default().map(f64::from));
    let scale = DVec3::from(node.scale.unwrap_or([1.0; 3]).map(f64::from));
    if !(rotation.is_finite() && rotation.length() > 1e-6 && translation.is_finite() && scale.is_finite()) {
        return Err(
            document.failure(format!("node {index}: its translation, rotation or scale is not finite, or no rotation at all"))
        );
    }
    Ok(Local::Parts { translation, rotation: rotation.normalize(), scale })
}
