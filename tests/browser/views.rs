//! An opened case: what its views show, and whether the numbers are right.

use dejag::picture::{BitDepth, DisplayPicture};
use dejag::suite::DiffOutcome;
use serde_json::Value;

use super::chromium::{self, Page};
use super::sample::{SIZE, Sample, case, earlier, mixed, picture};

fn opened(sample: &Sample, fragment: &str) -> Option<Page> {
    let mut page = chromium::start()?;
    page.open(&sample.page(), fragment);
    page.wait("document.getElementById('panes').dataset.ready === 'true'");
    Some(page)
}

const PRESSED: &str = "document.querySelector('button[data-view][aria-pressed=true]').dataset.view";
const SHOWN: &str = "document.getElementById('panes').dataset.shown";

fn visible(page: &mut Page, id: &str) -> bool {
    page.ask(&format!("getComputedStyle(document.getElementById('{id}')).visibility === 'visible'")) == true
}

#[test]
fn digits_choose_views_and_space_flips() {
    let sample = Sample::write(mixed(), &[]);
    let Some(mut page) = opened(&sample, "#case=disc%2F02-different") else { return };
    for (key, view) in ["1", "2", "3", "4", "5", "6"].into_iter().zip(["side", "slider", "flip", "blink", "difference", "heat"]) {
        page.key(key);
        assert_eq!(page.text(PRESSED), view);
    }
    page.wait("document.getElementById('heat').naturalWidth === 320");
    assert!(visible(&mut page, "heat") && !visible(&mut page, "expected"));
    page.key("3");
    assert!(visible(&mut page, "expected") && !visible(&mut page, "actual"));
    page.key(" ");
    assert_eq!(page.text(SHOWN), "actual");
    assert!(!visible(&mut page, "expected") && visible(&mut page, "actual"));
    assert_eq!(page.text("document.querySelector('#panes figcaption').textContent"), "actual");
    page.must_be_content();
}

#[test]
fn blinking_goes_by_itself_unless_motion_is_unwanted() {
    let sample = Sample::write(mixed(), &[]);
    let Some(mut page) = opened(&sample, "#case=disc%2F02-different") else { return };
    page.key("4");
    for side in ["actual", "expected", "actual"] {
        page.wait(&format!("{SHOWN} === '{side}'"));
    }
    page.key(" ");
    assert_eq!(page.text("document.getElementById('blink').getAttribute('aria-pressed')"), "false");
    page.key("1");
    page.prefer("", &[("prefers-reduced-motion", "reduce")]);
    page.key("4");
    assert_eq!(page.text("document.getElementById('blink').getAttribute('aria-pressed')"), "false");
    let still = page.text(&format!("new Promise((done) => setTimeout(() => done({SHOWN}), 1200))"));
    assert_eq!(still, "expected");
    page.key(" ");
    page.wait(&format!("{SHOWN} === 'actual'"));
    page.must_be_content();
}

#[test]
fn the_slider_is_moved_by_keys_and_by_its_handle() {
    let sample = Sample::write(mixed(), &[]);
    let Some(mut page) = opened(&sample, "#case=disc%2F02-different&view=slider") else { return };
    let split = "getComputedStyle(document.getElementById('panes')).getPropertyValue('--split')";
    page.ask("document.getElementById('split').focus()");
    (0..4).for_each(|_| page.key("ArrowRight"));
    assert_eq!((page.text(split), page.ask("document.getElementById('split').value")), ("52%".into(), "52".into()));
    assert!(page.text("getComputedStyle(document.getElementById('over')).clipPath").contains("52%"));
    let [left, width] =
        ["left", "width"].map(|side| page.ask(&format!("document.getElementById('one').getBoundingClientRect().{side}")));
    let (left, width) = (left.as_f64().expect("a number"), width.as_f64().expect("a number"));
    let y = page.ask("document.getElementById('one').getBoundingClientRect().top + 40").as_f64().expect("a number");
    // What is pressed is what the last frame shows: the handle has to be where it is going first.
    page.ask("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))");
    page.mouse("mouseMoved", [left + 0.52 * width, y]);
    page.mouse("mousePressed", [left + 0.52 * width, y]);
    page.mouse("mouseMoved", [left + 0.25 * width, y]);
    page.wait(&format!("{split} === '25%'"));
    page.mouse("mouseReleased", [left + 0.25 * width, y]);
    page.mouse("mouseMoved", [left + 0.75 * width, y]);
    assert_eq!(page.text(split), "25%", "let go, it stays");
    page.must_be_content();
}

/// The middle of a pixel on the screen, by the place that its canvas has.
fn on_screen(page: &mut Page, canvas: &str, [x, y]: [u32; 2]) -> [f64; 2] {
    let at = page.ask(&format!(
        "(() => {{ const b = document.getElementById('{canvas}').getBoundingClientRect(); const z = b.width / {}; \
         return [b.left + ({x} + 0.5) * z, b.top + ({y} + 0.5) * z]; }})()",
        SIZE[0]
    ));
    [at[0].as_f64().expect("x"), at[1].as_f64().expect("y")]
}

/// What the line of values has to say of a pixel of the sample's two pictures.
fn words(at: [u32; 2]) -> String {
    let levels = |edge| {
        let levels = picture(edge, false).to_rgba8();
        let start = 4 * (at[1] as usize * SIZE[0] as usize + at[0] as usize);
        [0, 1, 2, 3].map(|c| i32::from(levels[start + c]))
    };
    let (a, b) = (levels(150.0), levels(151.5));
    let list = |of: [i32; 4]| of.map(|level| level.to_string()).join(", ");
    let signed = [0, 1, 2, 3].map(|c| match b[c] - a[c] {
        more @ 1.. => format!("+{more}"),
        0 => "0".into(),
        less => format!("−{}", -less),
    });
    let difference = signed.join(", ");
    format!("{},{} expected ({}) actual ({}) difference ({difference}) of 255", at[0], at[1], list(a), list(b))
}

#[test]
fn the_values_under_the_pointer_are_those_of_the_files() {
    let sample = Sample::write(mixed(), &[]);
    let Some(mut page) = opened(&sample, "#case=disc%2F02-different") else { return };
    let said = "document.getElementById('values').textContent";
    for (canvas, place) in [("expected", [150, 90]), ("actual", [151, 88]), ("expected", [0, 0]), ("actual", [319, 179])] {
        let at = on_screen(&mut page, canvas, place);
        page.mouse("mouseMoved", at);
        assert_eq!(page.text(said), words(place));
    }
    assert!(words([150, 90]).contains("(+"), "the sample differs there: {}", words([150, 90]));

    // The worst pixel, from near; then a step of the crosshair; then the same place in the other picture by the pointer.
    page.key("w");
    let worst = page.text("document.querySelector('.case[data-id=\"disc/02-different\"]').dataset.worst");
    let worst: Vec<u32> = worst.split(',').map(|n| n.parse().expect("a number")).collect();
    assert_eq!(page.text(said), words([worst[0], worst[1]]));
    page.key_with("ArrowRight", 8);
    assert_eq!(page.text(said), words([worst[0] + 1, worst[1]]));
    assert_eq!(page.text("document.getElementById('said').textContent"), words([worst[0] + 1, worst[1]]));
    let crosses = page.ask("Array.from(document.querySelectorAll('.cross'), (cross) => cross.getBoundingClientRect().width)");
    assert_eq!(crosses, Value::from(vec![16, 16]), "16 screen pixels a pixel, in both windows");
    let at = on_screen(&mut page, "actual", [worst[0] - 2, worst[1] + 3]);
    page.mouse("mouseMoved", at);
    assert_eq!(page.text(said), words([worst[0] - 2, worst[1] + 3]));
    page.must_be_content();
}

/// A canvas would forget the colour under a small alpha, and the lower 8 bits of 16.
#[test]
fn what_is_translucent_or_deep_shows_its_own_levels() {
    let sample = Sample::without_report();
    let count = (SIZE[0] * SIZE[1]) as usize;
    let deep: Vec<u16> = (0..4 * count).map(|i| (i * 7919 % 65_536) as u16).collect();
    let picture = DisplayPicture::from_rgba16(SIZE[0], SIZE[1], &deep).expect("a size");
    picture.save_png(&sample.path("expected"), BitDepth::Sixteen, &[]).expect("written");
    let colors: Vec<u8> = (0..3 * count).map(|i| (i / 5 * 37 % 251 + i % 3) as u8).collect();
    for filter in [png::Filter::NoFilter, png::Filter::Sub, png::Filter::Up, png::Filter::Avg, png::Filter::Paeth] {
        let mut encoder = png::Encoder::new(std::fs::File::create(sample.path("actual")).expect("made"), SIZE[0], SIZE[1]);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_filter(filter);
        encoder.write_header().and_then(|mut writer| writer.write_image_data(&colors)).expect("written");
        sample.report(vec![case("deep", DiffOutcome::Size)], &[]);
        let Some(mut page) = opened(&sample, "#case=deep") else { return };
        for place in [[0, 0], [1, 0], [17, 1], [319, 179], [160, 90]] {
            let at = on_screen(&mut page, "expected", place);
            page.mouse("mouseMoved", at);
            let pixel = (place[1] * SIZE[0] + place[0]) as usize;
            let [expected, actual] = [
                deep[4 * pixel..4 * pixel + 4].to_vec(),
                colors[3 * pixel..3 * pixel + 3].iter().map(|level| u16::from(*level)).chain([255]).collect(),
            ]
            .map(|levels| levels.iter().map(u16::to_string).collect::<Vec<_>>().join(", "));
            let said = page.text("document.getElementById('values').textContent");
            let start = format!("{},{} expected ({expected}) actual ({actual}) difference (", place[0], place[1]);
            assert!(said.starts_with(&start) && said.ends_with(" of 65535"), "{filter:?}: {said}, not {start}");
        }
        page.must_be_content();
    }
}

#[test]
fn the_difference_is_that_of_the_levels_amplified() {
    let sample = Sample::write(mixed(), &[]);
    let Some(mut page) = opened(&sample, "#case=disc%2F02-different&view=difference") else { return };
    // Read from a copy: the page never reads its own canvas.
    let pixel = |page: &mut Page, x: u32, y: u32| {
        page.ask(&format!(
            "(() => {{ const copy = document.createElement('canvas').getContext('2d', {{ willReadFrequently: true }}); \
             copy.drawImage(document.getElementById('difference'), -{x}, -{y}); return Array.from(copy.getImageData(0, 0, 1, 1).data); }})()"
        ))
    };
    let [a, b] = [150.0, 151.5].map(|edge| picture(edge, false).to_rgba8());
    let start = 4 * (90 * SIZE[0] as usize + 150);
    for gain in [1u32, 16] {
        page.ask(&format!(
            "(() => {{ const gain = document.getElementById('gain'); gain.value = '{gain}'; gain.dispatchEvent(new Event('change')); }})()"
        ));
        let apart = |c: usize| (u32::from(a[start + c].abs_diff(b[start + c])) * gain).min(255);
        assert_eq!(pixel(&mut page, 150, 90), Value::from(vec![apart(0), apart(1), apart(2), 255]));
        assert_eq!(pixel(&mut page, 10, 10), Value::from(vec![0, 0, 0, 255]));
    }
    page.must_be_content();
}

#[test]
fn what_is_not_at_hand_is_said() {
    let sample = Sample::write(mixed(), &earlier());
    let Some(mut page) = opened(&sample, "#case=disc%2F06-new") else { return };
    assert_eq!(page.text("document.querySelector('#panes figcaption').textContent"), "expected (not at hand)");
    assert!(page.text("document.getElementById('facts').textContent").contains("The expected picture is not at hand."));
    let at = on_screen(&mut page, "actual", [5, 5]);
    page.mouse("mouseMoved", at);
    let said = page.text("document.getElementById('values').textContent");
    assert!(said.contains("expected none") && said.contains("difference none"), "{said}");
    page.key("6");
    assert_eq!(page.text("document.querySelector('#panes figcaption').textContent"), "no heat map was made");

    page.open(&sample.page(), "#case=disc%2F02-different");
    page.wait("document.getElementById('name').textContent === 'disc/02-different'");
    let facts = page.text("document.getElementById('facts').textContent");
    for word in ["dejag bless disc/02-different", "Mesa 22.3.5", "missed", "flip-ldr/1.7@67.0206", "no case", "not comparable"] {
        assert!(facts.contains(word), "{word}: {facts}");
    }
    page.must_be_content();
}
