//! Several frames, several passes, several views: each picture comes out as if it were the only one.

use dejag::gpu::encode_texels;
use dejag::pass::{Inputs, Pass, Recorder, Surface};
use dejag::picture::Pixel;
use wgpu::{TextureFormat as Format, TextureUsages as Usages};

use super::filters;
use super::host::Host;
use super::picture::{SIZE, mirrored, shapes};

const CODED: Surface = Surface { format: Format::Rgba8Unorm, values: dejag::pass::Encoding::Display };

/// By a pass of its own, in an encoder of its own.
fn alone(host: &Host, method: &str, size: [u32; 2], pixels: &[Pixel]) -> Vec<u8> {
    let (color, output) = (host.picture(size, CODED.format, pixels), host.target(size, CODED.format));
    host.run(host.build(method, size, [CODED; 2]).as_mut(), &color, &output);
    host.bytes(&output)
}

/// Every filter takes both pictures by turns, twice, all in one encoder: the passes' private targets and the bind groups that they
/// keep must not carry anything over.
#[test]
fn passes_and_frames_share_an_encoder() {
    let host = Host::open();
    let pictures = [shapes(SIZE), mirrored(SIZE)];
    let inputs = pictures.each_ref().map(|pixels| host.picture(SIZE, CODED.format, pixels));
    let mut passes: Vec<(&str, Box<dyn Pass>)> =
        filters().into_iter().map(|method| (method, host.build(method, SIZE, [CODED; 2]))).collect();
    let mut outputs = Vec::new();
    let mut encoder = host.encoder();
    for turn in 0..4 {
        for (method, pass) in &mut passes {
            let output = host.target(SIZE, CODED.format);
            pass.record(&mut Recorder::new(&mut encoder), 0, &Inputs::picture(&inputs[turn % 2]), &output);
            outputs.push((*method, turn, output));
        }
    }
    host.queue.submit([encoder.finish()]);
    host.check("one encoder");
    for method in filters() {
        let expected = pictures.each_ref().map(|pixels| alone(&host, method, SIZE, pixels));
        assert_ne!(expected[0], expected[1]);
        for (_, turn, output) in outputs.iter().filter(|(of, ..)| *of == method) {
            assert!(host.bytes(output) == expected[turn % 2], "{method}, frame {turn}");
        }
    }
}

/// A pass goes by the views it is given: here one mip of one layer each, of textures that are larger and of another format.
#[test]
fn views_of_a_mip_and_a_layer_are_pictures() {
    let host = Host::open();
    let large = |usage| {
        host.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width: 2 * SIZE[0] + 1, height: 2 * SIZE[1], depth_or_array_layers: 3 },
            mip_level_count: 3,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: Format::Rgba8UnormSrgb,
            usage,
            view_formats: &[CODED.format],
        })
    };
    let input = large(Usages::TEXTURE_BINDING | Usages::COPY_DST);
    let output = large(Usages::RENDER_ATTACHMENT | Usages::COPY_SRC);
    let place = |texture, layer| wgpu::TexelCopyTextureInfo {
        texture,
        mip_level: 1,
        origin: wgpu::Origin3d { x: 0, y: 0, z: layer },
        aspect: wgpu::TextureAspect::All,
    };
    host.write(place(&input, 1), SIZE, &encode_texels(CODED.format, &shapes(SIZE)).expect("a picture's format"));
    let view = |texture: &wgpu::Texture, layer, mips| {
        texture.create_view(&wgpu::TextureViewDescriptor {
            format: Some(CODED.format),
            dimension: Some(wgpu::TextureViewDimension::D2),
            base_mip_level: 1,
            mip_level_count: Some(mips),
            base_array_layer: layer,
            array_layer_count: Some(1),
            ..Default::default()
        })
    };
    for method in filters() {
        let expected = alone(&host, method, SIZE, &shapes(SIZE));
        // Smaller mips in the view are not looked at.
        for mips in [1, 2] {
            let mut pass = host.build(method, SIZE, [CODED; 2]);
            host.run(pass.as_mut(), &view(&input, 1, mips), &view(&output, 2, 1));
            host.check(method);
            assert!(host.read(place(&output, 2), SIZE) == expected, "{method}, {mips} mips");
        }
    }
}

/// Another size is another pass: what an earlier one left on the device does not show.
#[test]
fn after_a_resize_pictures_are_as_if_never_resized() {
    for method in filters() {
        let sizes = [SIZE, [1, 1], [40, 50], SIZE];
        let host = Host::open();
        let resized = sizes.map(|size| alone(&host, method, size, &shapes(size)));
        for which in [1, 2] {
            let fresh = alone(&Host::open(), method, sizes[which], &shapes(sizes[which]));
            assert!(resized[which] == fresh, "{method} at {:?}", sizes[which]);
        }
        assert!(resized[3] == resized[0], "{method}");
    }
}

/// Other options are another pass; both may live at once.
#[test]
fn passes_of_other_options_live_beside_each_other() {
    let host = Host::open();
    let color = host.picture(SIZE, CODED.format, &shapes(SIZE));
    for options in
        [["fxaa", "fxaa:subpix=0"], ["mlaa", "mlaa:max_search=2"], ["smaa", "smaa:preset=low"], ["cmaa2", "cmaa2:sharp=on"]]
    {
        let mut passes = options.map(|method| host.build(method, SIZE, [CODED; 2]));
        let output = host.target(SIZE, CODED.format);
        let mut take = |which: usize| {
            host.run(passes[which].as_mut(), &color, &output);
            host.bytes(&output)
        };
        let (first, second, again) = (take(0), take(1), take(0));
        assert!(first == alone(&host, options[0], SIZE, &shapes(SIZE)) && first == again, "{}", options[0]);
        assert!(second == alone(&host, options[1], SIZE, &shapes(SIZE)), "{}", options[1]);
        assert!(first != second, "{} makes no difference", options[1]);
    }
}

/// A software adapter writes into a copy of the picture where it may; the picture is the same either way.
#[test]
fn textures_that_may_be_copied_give_the_same_picture() {
    let host = Host::open();
    for method in filters() {
        for format in [wgpu::TextureFormat::Rgba8Unorm, wgpu::TextureFormat::Rgba16Float, wgpu::TextureFormat::Rgba32Float] {
            let surface = Surface::display(format);
            let mut pass = host.build(method, SIZE, [surface; 2]);
            let [color, output] = host.copyable(SIZE, format, &shapes(SIZE));
            host.run(pass.as_mut(), &color, &output);
            let plain = host.target(SIZE, format);
            host.run(pass.as_mut(), &host.picture(SIZE, format, &shapes(SIZE)), &plain);
            assert!(host.bytes(&output) == host.bytes(&plain), "{method} {format:?}");
        }
    }
}
