//! Where outputs go, and where they must not.

use dejag::picture::load;

use super::{Desk, filter, jagged, put, refused, smoothed};

#[test]
fn folders_are_walked_and_paths_kept() {
    let desk = Desk::new();
    for folder in ["in", "in/deep", "in/deep/er", "in/none"] {
        desk.make_folder(folder);
    }
    for name in ["in/b.png", "in/a.PNG", "in/deep/a.png", "in/deep/er/c.png", "d.png"] {
        put(&desk, name, &jagged(16, 9, 1.0));
    }
    desk.write("in/readme.txt", "words");
    desk.write("in/deep/noname", "words");
    let ran = smoothed(&desk, "in d.png -o new/out -v");
    let out: Vec<String> =
        desk.names().into_iter().filter(|name| name.starts_with("new/out/") && desk.path(name).is_file()).collect();
    assert_eq!(out, ["new/out/a.PNG", "new/out/b.png", "new/out/d.png", "new/out/deep/a.png", "new/out/deep/er/c.png"]);
    let lines: Vec<&str> = ran.stderr.lines().skip_while(|line| line.starts_with("adapter")).collect();
    let said = ["a.PNG", "b.png", "deep/a.png", "deep/er/c.png", "d.png"].map(|name| format!("new/out/{name}: 16x9"));
    assert_eq!(lines[..5], said, "in the order of the inputs");
    assert_eq!(lines[5..], [format!("new/out: 5 pictures with {}; 2 other files skipped", filter())]);
    // A folder that is there takes one picture too.
    smoothed(&desk, "d.png -o in/none");
    smoothed(&desk, "d.png -o fresh/");
    assert!(desk.path("in/none/d.png").is_file() && desk.path("fresh/d.png").is_file());
}

#[test]
fn an_output_folder_inside_the_input_is_not_read() {
    let desk = Desk::new();
    desk.make_folder("in");
    put(&desk, "in/a.png", &jagged(16, 9, 1.0));
    smoothed(&desk, "in -o in/out");
    let (names, bytes) = (desk.names(), desk.read("in/out/a.png"));
    smoothed(&desk, "in -o in/out");
    assert_eq!((desk.names(), desk.read("in/out/a.png")), (names, bytes));
}

#[test]
fn outputs_that_would_meet_are_2_before_anything_is_written() {
    let desk = Desk::new();
    desk.make_folder("in");
    desk.make_folder("other");
    for name in ["in/a.png", "other/a.png", "in/z.png"] {
        put(&desk, name, &jagged(16, 9, 1.0));
    }
    refused(&desk, "in other -o out", 2, &["in/a.png", "other/a.png", "out/a.png", "different folders"]);
    refused(&desk, "in in -o out", 2, &["in/a.png is named twice", "once"]);
    refused(&desk, "in/a.png in/z.png -o in/b.png", 2, &["in/b.png names one picture", "name a folder"]);
    refused(&desk, "in/a.png in/z.png -o other/a.png", 2, &["other/a.png is a file", "folder"]);
    refused(&desk, "in/a.png -o out", 2, &["out has no extension", ".webp"]);
    refused(&desk, "in/a.png -o out.gif", 2, &["ends in .gif", ".webp"]);
}

#[test]
fn an_input_is_replaced_only_by_force() {
    let desk = Desk::new();
    desk.make_folder("in");
    put(&desk, "in/a.png", &jagged(64, 48, 1.0));
    put(&desk, "in/b.png", &jagged(48, 64, 1.0));
    let before = desk.read("in/a.png");
    refused(&desk, "in/a.png -o in/a.png", 2, &["is the input itself", "--force"]);
    refused(&desk, "in -o in", 2, &["in/a.png is the input itself", "--force"]);
    refused(&desk, "in/a.png -o in/../in/a.png", 2, &["is the input itself"]);
    assert_eq!(desk.read("in/a.png"), before);
    smoothed(&desk, "in -o in --force");
    assert_ne!(desk.read("in/a.png"), before);
    // Another input is never replaced: which of them came first would matter.
    for folder in ["more", "more/in", "out", "out/in"] {
        desk.make_folder(folder);
    }
    put(&desk, "more/in/c.png", &jagged(16, 9, 1.0));
    put(&desk, "out/in/c.png", &jagged(16, 9, 1.0));
    refused(&desk, "more out/in/c.png -o out --force", 2, &["more/in/c.png would replace out/in/c.png, another input"]);
}

#[test]
fn places_that_cannot_be_written_are_3() {
    let desk = Desk::new();
    desk.write("file", "a file");
    put(&desk, "in.png", &jagged(16, 9, 1.0));
    refused(&desk, "in.png -o no/such/out.png", 3, &["could not write into no/such", "check the path"]);
    refused(&desk, "in.png in.png -o file/out", 3, &["could not write into file"]);
}

#[test]
fn hostile_names_are_names() {
    let desk = Desk::new();
    desk.make_folder("in");
    let names = ["with space.png", "-m.png", "line\nbreak.png", "ünïcödé.png", "%s{}.png", "..png", "a.png.png"];
    for name in names {
        put(&desk, &format!("in/{name}"), &jagged(8, 8, 1.0));
    }
    smoothed(&desk, "in -o out");
    for name in names {
        let (input, output) = (desk.path(&format!("in/{name}")), desk.path(&format!("out/{name}")));
        assert_eq!(load(&output).expect(name).size(), load(&input).expect(name).size());
    }
}

#[cfg(target_os = "linux")]
#[test]
fn names_that_are_no_text_links_and_pipes() {
    use std::os::unix::ffi::OsStrExt as _;
    let desk = Desk::new();
    desk.make_folder("in");
    put(&desk, "in/a.png", &jagged(8, 8, 1.0));
    let odd = desk.path("in").join(std::ffi::OsStr::from_bytes(b"\xff.png"));
    std::fs::rename(desk.path("in/a.png"), odd).expect("renamed");
    put(&desk, "b.png", &jagged(8, 8, 1.0));
    std::os::unix::fs::symlink("../b.png", desk.path("in/link.png")).expect("a link");
    std::os::unix::fs::symlink(".", desk.path("in/circle")).expect("a link");
    let made = std::process::Command::new("mkfifo").arg(desk.path("in/pipe.png")).status().expect("mkfifo runs");
    assert!(made.success());
    let ran = smoothed(&desk, "in -o out");
    assert!(ran.stderr.ends_with("2 pictures with smaa; 2 other files skipped\n".replace("smaa", filter()).as_str()), "{ran}");
    assert!(desk.path("out").join(std::ffi::OsStr::from_bytes(b"\xff.png")).is_file());
    assert!(!desk.path("out/link.png").is_symlink());
    refused(&desk, "in/pipe.png -o pipe.png", 2, &["neither a file nor a folder"]);
}
