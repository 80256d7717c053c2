//! The filters as a program that is not ours would use them: on its own device with WebGPU's downlevel limits and no features,
//! with its own formats, views and encoders.

mod creations;
mod formats;
mod frames;
mod history;
mod host;
mod modes;
mod picture;

use dejag::methods::{METHODS, Spec};
use dejag::pass::{Extras, Role};

/// Every method of the registry that takes a finished picture and nothing else, as it is without options.
fn filters() -> Vec<&'static str> {
    let takes_pictures = |name: &&str| {
        let needs = Spec::parse(name).expect("defaults parse").first_needs();
        matches!(needs.role, Role::Filters(_)) && needs.extras == Extras::default()
    };
    let found: Vec<_> = METHODS.iter().map(|method| method.name).filter(takes_pictures).collect();
    assert!(found.len() >= 4, "{found:?}");
    found
}

#[test]
fn filters_ask_for_no_features_and_one_sample() {
    for name in filters() {
        let needs = Spec::parse(name).expect("defaults parse").first_needs();
        assert_eq!((needs.features, needs.samples), (wgpu::Features::empty(), 1), "{name}");
    }
}

#[test]
fn what_goes_beyond_the_base_is_said() {
    let features = |spec: &str| Spec::parse(spec).expect("exists").first_needs().features;
    assert_eq!(features("none"), wgpu::Features::empty());
    // WebGPU guarantees four samples of every renderable format that can have them, and no other count.
    assert_eq!(features("msaa:samples=4"), wgpu::Features::empty());
    assert_eq!(features("msaa:samples=8"), wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES);
    assert_eq!(features("ssaa"), wgpu::Features::FLOAT32_BLENDABLE);
    // And a host that lacks it hears so before anything is built.
    let needs = Spec::parse("ssaa").expect("exists").first_needs();
    let refusal = needs.check("ssaa", wgpu::Features::empty(), &[1, 4]).expect_err("lacks it").to_string();
    assert!(refusal.contains("FLOAT32_BLENDABLE"), "{refusal}");
}
