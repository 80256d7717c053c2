//! A model's first animation: translations, rotations and scales of its nodes, over and over.

use glam::{DQuat, DVec3, DVec4};
use gltf::json;
use json::animation::{Interpolation, Property};
use json::validation::Checked;

use super::nodes::Tree;
use super::rig::Local;
use super::{Document, FARTHEST, Failure};
use crate::error::Result;
use crate::scene::camera::bracket;

/// What moves a tree of nodes.
#[derive(Debug, Default)]
pub(super) struct Animation {
    channels: Vec<Channel>,
    /// Seconds.
    pub(super) duration: f64,
}

/// One property of one node.
#[derive(Debug)]
struct Channel {
    /// Place in the tree.
    node: usize,
    target: Target,
    interpolation: Interpolation,
    /// At least one, in order of time.
    keys: Vec<Key>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Target {
    Translation,
    Rotation,
    Scale,
}

/// A value, and the tangents with which a cubic spline comes and goes. Vectors leave w alone.
#[derive(Debug, Clone, Copy)]
struct Key {
    /// Seconds.
    time: f64,
    arriving: DVec4,
    value: DVec4,
    leaving: DVec4,
}

impl Animation {
    /// Moves nodes to where they are at a time in seconds.
    pub(super) fn apply(&self, time: f64, locals: &mut [Local]) {
        let time = if self.duration > 0.0 { time.rem_euclid(self.duration) } else { 0.0 };
        for channel in &self.channels {
            let value = channel.at(time);
            let Local::Parts { translation, rotation, scale } = &mut locals[channel.node] else {
                continue;
            };
            match channel.target {
                Target::Translation => *translation = value.truncate(),
                Target::Scale => *scale = value.truncate(),
                Target::Rotation => *rotation = unit(value),
            }
        }
    }
}

/// A spline through rotations may pass close to no rotation at all.
fn unit(value: DVec4) -> DQuat {
    value.try_normalize().map_or(DQuat::IDENTITY, DQuat::from_vec4)
}

impl Channel {
    fn at(&self, time: f64) -> DVec4 {
        let (from, to, t) = bracket(&self.keys, |key| key.time, time);
        match self.interpolation {
            Interpolation::Step => from.value,
            Interpolation::Linear if self.target == Target::Rotation => unit(from.value).slerp(unit(to.value), t).into(),
            Interpolation::Linear => from.value.lerp(to.value, t),
            Interpolation::CubicSpline => hermite(from, to, t),
        }
    }
}

/// glTF 2.0 appendix C: tangents are per second.
fn hermite(from: &Key, to: &Key, t: f64) -> DVec4 {
    let span = to.time - from.time;
    let (t2, t3) = (t * t, t * t * t);
    from.value * (2.0 * t3 - 3.0 * t2 + 1.0)
        + from.leaving * (span * (t3 - 2.0 * t2 + t))
        + to.value * (3.0 * t2 - 2.0 * t3)
        + to.arriving * (span * (t3 - t2))
}

/// The model's first animation; one that does nothing where it has none.
pub(super) fn first(document: &mut Document, tree: &Tree) -> Result<Animation> {
    let Some(json) = document.root.animations.first().cloned() else {
        return Ok(Animation::default());
    };
    let mut animation = Animation::default();
    for (k, channel) in json.channels.iter().enumerate() {
        let what = format!("animation 0 channel {k}");
        if let Some(channel) = read_channel(document, &json, channel, tree, &what)? {
            let last = channel.keys.last().map_or(0.0, |key| key.time);
            animation.duration = animation.duration.max(last);
            animation.channels.push(channel);
        }
    }
    Ok(animation)
}

fn read_channel(
    document: &mut Document,
    animation: &json::Animation,
    channel: &json::animation::Channel,
    tree: &Tree,
    what: &str,
) -> Result<Option<Channel>> {
    let index = channel.target.node.value();
    // A node outside of the scene moves nothing that is seen.
    let Some(node) = *document.get(&tree.places, index, "node")? else {
        return Ok(None);
    };
    if let Local::Matrix(_) = tree.nodes[node].local {
        document.warn(format!("node {index} has a matrix; its animation is left out"));
        return Ok(None);
    }
    let target = match channel.target.path {
        Checked::Valid(Property::Translation) => Target::Translation,
        Checked::Valid(Property::Rotation) => Target::Rotation,
        Checked::Valid(Property::Scale) => Target::Scale,
        Checked::Valid(Property::MorphTargetWeights) => {
            document.warn("its animation moves morph targets; they are left out".into());
            return Ok(None);
        }
        Checked::Invalid => return Err(document.failure(format!("{what} moves a property that does not exist"))),
    };
    let sampler = document.get(&animation.samplers, channel.sampler.value(), "animation sampler")?;
    let Checked::Valid(interpolation) = sampler.interpolation else {
        return Err(document.failure(format!("{what} has an interpolation that does not exist")));
    };
    let times = times(document, sampler.input, what)?;
    let values = values(document, sampler.output, target, what)?;
    let keys = keys(&times, &values, interpolation).ok_or_else(|| {
        document.failure(format!("{what} has {} times and {} values, which do not go together", times.len(), values.len()))
    })?;
    Ok(Some(Channel { node, target, interpolation, keys }))
}

fn times(document: &Document, accessor: json::Index<json::Accessor>, what: &str) -> Result<Vec<f64>> {
    let times = document.floats::<1>(accessor, &format!("{what} input"))?;
    let times: Vec<f64> = times.into_iter().map(|[time]| f64::from(time)).collect();
    let in_order = times.windows(2).all(|pair| pair[0] < pair[1]);
    match times.first() {
        Some(&first) if first >= 0.0 && in_order && times.iter().all(|&time| time <= 1e6) => Ok(times),
        _ => Err(document.failure(format!("{what}: its times should be ascending, from 0 to a million seconds"))),
    }
}

fn values(document: &Document, accessor: json::Index<json::Accessor>, target: Target, what: &str) -> Result<Vec<DVec4>> {
    let what = format!("{what} output");
    let values: Vec<DVec4> = if target == Target::Rotation {
        document.floats::<4>(accessor, &what)?.into_iter().map(|v| DVec4::from(v.map(f64::from))).collect()
    } else {
        let extend = |v: [f32; 3]| DVec3::from(v.map(f64::from)).extend(0.0);
        document.floats::<3>(accessor, &what)?.into_iter().map(extend).collect()
    };
    if values.iter().any(|value| value.abs().max_element() > FARTHEST) {
        return Err(document.failure(format!("{what} holds a number beyond {FARTHEST:e}")));
    }
    Ok(values)
}

/// One value a time, or three for a cubic spline: arriving tangent, value, leaving tangent.
fn keys(times: &[f64], values: &[DVec4], interpolation: Interpolation) -> Option<Vec<Key>> {
    let per_key = if interpolation == Interpolation::CubicSpline { 3 } else { 1 };
    if times.is_empty() || values.len() != times.len().checked_mul(per_key)? {
        return None;
    }
    let key = |(&time, values): (&f64, &[DVec4])| match *values {
        [arriving, value, leaving] => Key { time, arriving, value, leaving },
        _ => Key { time, arriving: DVec4::ZERO, value: values[0], leaving: DVec4::ZERO },
    };
    Some(times.iter().zip(values.chunks_exact(per_key)).map(key).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(time: f64, value: f64, tangent: f64) -> Key {
        let tangent = DVec4::X * tangent;
        Key { time, arriving: tangent, value: DVec4::X * value, leaving: tangent }
    }

    fn channel(interpolation: Interpolation, keys: Vec<Key>) -> Channel {
        Channel { node: 0, target: Target::Translation, interpolation, keys }
    }

    #[test]
    fn interpolations_meet_their_keys_and_do_what_their_names_say() {
        let keys = || vec![key(1.0, 0.0, 2.0), key(3.0, 4.0, 2.0)];
        for interpolation in [Interpolation::Step, Interpolation::Linear, Interpolation::CubicSpline] {
            let channel = channel(interpolation, keys());
            assert_eq!(channel.at(0.0).x, 0.0, "before the first key");
            assert_eq!(channel.at(1.0).x, 0.0);
            assert_eq!(channel.at(3.0).x, 4.0);
            assert_eq!(channel.at(9.0).x, 4.0, "after the last key");
        }
        assert_eq!(channel(Interpolation::Step, keys()).at(2.9).x, 0.0);
        assert_eq!(channel(Interpolation::Linear, keys()).at(2.5).x, 3.0);
        // With the slope of the straight line at both ends the spline is the straight line.
        assert!((channel(Interpolation::CubicSpline, keys()).at(2.5).x - 3.0).abs() < 1e-12);
    }

    #[test]
    fn rotations_take_the_shorter_way_and_stay_unit() {
        let quarter = DVec4::from(DQuat::from_rotation_z(1.5));
        let rotation = |value| Key { time: 0.0, arriving: DVec4::ZERO, value, leaving: DVec4::ZERO };
        let keys = vec![rotation(DVec4::W), Key { time: 1.0, ..rotation(-quarter) }];
        let channel = Channel { node: 0, target: Target::Rotation, interpolation: Interpolation::Linear, keys };
        let half = unit(channel.at(0.5));
        assert!(half.is_normalized() && half.angle_between(DQuat::from_rotation_z(0.75)) < 1e-6, "{half}");
    }

    #[test]
    fn an_animation_begins_again() {
        let keys = vec![key(0.0, 0.0, 0.0), key(2.0, 4.0, 0.0)];
        let animation = Animation { channels: vec![channel(Interpolation::Linear, keys)], duration: 2.0 };
        let at = |time| {
            let mut locals = [Local::Parts { translation: DVec3::Y, rotation: DQuat::IDENTITY, scale: DVec3::ONE }];
            animation.apply(time, &mut locals);
            match locals[0] {
                Local::Parts { translation, .. } => translation.x,
                Local::Matrix(_) => panic!(),
            }
        };
        assert_eq!((at(0.5), at(2.5), at(4.5)), (1.0, 1.0, 1.0));
    }

    #[test]
    fn a_spline_needs_three_values_a_key() {
        let values = [DVec4::X; 6];
        assert!(keys(&[0.0, 1.0], &values, Interpolation::CubicSpline).is_some());
        assert!(keys(&[0.0, 1.0], &values, Interpolation::Linear).is_none());
        assert!(keys(&[], &[], Interpolation::Step).is_none());
    }
}
