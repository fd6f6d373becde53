//! What goes wrong is said once, with the place and a way out, and nothing is written.

use std::fs;

use crate::program::{rayloom, rayloom_without_adapter, rayloom_without_display};

/// A folder with one network file, and the paths of that file and of a picture beside it.
fn with_network(text: &str) -> (tempfile::TempDir, String, String) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("a path in UTF-8").to_owned();
    let (network, picture) = (path("network.json"), path("picture.png"));
    fs::write(&network, text).expect("a file");
    (folder, network, picture)
}

/// A network of these processors and connections.
fn text(processors: &str, connections: &str) -> String {
    format!(r#"{{"rayloom": 1, "processors": [{processors}], "connections": [{connections}]}}"#)
}

const SOURCE: &str = r#"{"id": "source", "type": "volume_generator"}"#;
const SLICE: &str = r#"{"id": "slice", "type": "slice_view"}"#;
const CANVAS: &str = r#"{"id": "canvas", "type": "canvas"}"#;
const FEEDS: &str = r#""source.volume -> slice.volume""#;
const SHOWS: &str = r#""slice.image -> canvas.image""#;

fn slice() -> String {
    text(&[SOURCE, SLICE, CANVAS].join(","), &[FEEDS, SHOWS].join(","))
}

#[test]
fn malformed_networks_name_file_and_place() {
    let cases = [
        (String::new(), "is not JSON"),
        ("{".to_owned(), ":1:1: this is not JSON"),
        ("[]".to_owned(), "expected an object"),
        ("{}".to_owned(), "`rayloom`"),
        (r#"{"rayloom": 999}"#.to_owned(), "newer"),
        (r#"{"rayloom": "1"}"#.to_owned(), "expected a whole number"),
        (r#"{"rayloom": 1, "processors": 3}"#.to_owned(), "processors: found 3, expected an array"),
        (r#"{"rayloom": 1, "procesors": []}"#.to_owned(), "Did you mean `processors`"),
        (text(r#"{"type": "canvas"}"#, ""), "processors[0]"),
        (text(&[CANVAS, CANVAS].join(","), ""), "processors[1].id"),
        (text(r#"{"id": "canvas", "type": "canvas", "properties": {"size": [0, 5]}}"#, ""), "properties.size"),
        (text(r#"{"id": "canvas", "type": "canvas", "properties": {"size": "big"}}"#, ""), "an array of 2 numbers"),
        (text(&[SOURCE, CANVAS].join(","), r#""source.volume -> canvas.image""#), "connections[0]"),
        (text(&[SLICE, CANVAS].join(","), r#""slice.imag -> canvas.image""#), "Did you mean `image`"),
        (text(SLICE, r#""slice.image""#), "processor.outport -> processor.inport"),
        (slice().replace("\"rayloom\": 1", "\"rayloom\": 1, \"rayloom\": 1"), "appears twice"),
    ];
    for (network, expected) in cases {
        let (_folder, file, picture) = with_network(&network);
        for arguments in [vec!["check", &file], vec!["render", &file, "-o", &picture]] {
            let error = rayloom(arguments).error();
            assert!(error.contains(&file) && error.contains(expected), "{network}\ngave {error}");
        }
        assert!(!fs::exists(&picture).expect("a folder that can be read"), "{network}");
    }
}

#[test]
fn networks_that_are_not_ready_say_why() {
    let unknown = r#"{"id": "slice", "type": "slice_veiw"}"#;
    let file_source = r#"{"id": "source", "type": "volume_source"}"#;
    let gone = r#"{"id": "source", "type": "volume_source", "properties": {"file": "gone.nii"}}"#;
    let both = [FEEDS, SHOWS].join(",");
    let cases = [
        (text("", ""), "no canvas"),
        (text(CANVAS, ""), "canvas: input `image` is not connected"),
        (
            text(&[SLICE, CANVAS].join(","), SHOWS),
            "canvas waits for slice.image; slice: input `volume` is not connected",
        ),
        (text(&[file_source, SLICE, CANVAS].join(","), &both), "source: no file chosen"),
        (text(&[gone, SLICE, CANVAS].join(","), &both), "gone.nii"),
        (text(&[SOURCE, unknown, CANVAS].join(","), &both), "slice_veiw"),
    ];
    for (network, expected) in cases {
        let (_folder, file, picture) = with_network(&network);
        for arguments in [vec!["check", &file], vec!["render", &file, "-o", &picture]] {
            let ran = rayloom(arguments);
            assert_eq!(ran.code, 1, "{network}");
            assert!(
                ran.stderr.contains(expected) && !ran.stderr.contains("panicked"),
                "{network}\ngave {}",
                ran.stderr
            );
        }
    }
}

#[test]
fn the_root_cause_comes_first_and_what_waits_for_it_last() {
    let (_folder, file, picture) = with_network(&text(
        &[r#"{"id": "source", "type": "volume_source", "properties": {"file": "gone.nii"}}"#, SLICE, CANVAS].join(","),
        &[FEEDS, SHOWS].join(","),
    ));
    let error = rayloom(["render", &file, "-o", &picture]).error();
    let lines: Vec<&str> = error.lines().collect();
    assert!(lines[0].starts_with("`source` (volume_source) failed: ") && lines[0].contains("gone.nii"), "{error}");
    assert!(lines[1].contains("`slice`"), "{error}");
}

#[test]
fn mistyped_names_are_answered_with_the_closest() {
    let (folder, file, picture) = with_network(&slice());
    let set = |setting: &str| rayloom(["render", &file, "-o", &picture, "--set", setting]).error();
    assert!(set("slcie.axis=x").contains("Did you mean `slice`"), "{}", set("slcie.axis=x"));
    assert!(set("canvas.sizes=[1, 2]").contains("Did you mean `size`"));
    assert!(set("canvas.size=[1]").contains("an array of 2 numbers"));
    let port = |port: &str| rayloom(["render", &file, "-o", &picture, "--port", port]).error();
    assert!(port("slcie.image").contains("did you mean `slice`"));
    assert!(port("slice.imge").contains("did you mean `image`"));
    assert!(port("source.volume").contains("a volume") && port("source.volume").contains("slice.image"));
    let near = folder.path().join("netwrk.json").display().to_string();
    assert!(rayloom(["check", &near]).error().contains("network.json"));
    let error = rayloom(["check", "/no/such/folder/network.json"]).error();
    assert!(error.contains("/no/such/folder"), "{error}");
}

#[test]
fn files_that_cannot_be_written_or_read_are_named() {
    let (_folder, file, _) = with_network(&slice());
    assert!(rayloom(["render", &file, "-o", "/no/such/folder/a.png"]).error().contains("/no/such/folder"));
    assert!(rayloom(["info", "/no/such/volume.nii"]).error().contains("/no/such/volume.nii"));
    assert!(rayloom(["info", &file]).error().contains("no known volume format"));
}

#[test]
fn what_cannot_be_understood_is_a_usage_error() {
    let file = "network.json";
    let cases: [(&[&str], &str); 9] = [
        (&["open", file, "--mode", "kiosk"], "visualization"),
        (&["paint"], "paint"),
        (&["render", file], "--output"),
        (&["render", file, "-o", "a.jpg"], ".png, .exr or .npy"),
        (&["render", file, "-o", "a"], "no extension"),
        (&["render", file, "-o", "a.png", "--size", "12"], "WIDTHxHEIGHT"),
        (&["render", file, "-o", "a.png", "--set", "a.b"], "PROCESSOR.PROPERTY=JSON"),
        (&["render", file, "-o", "a.png", "--set", "a.b={\"x\""], "not JSON"),
        (&["list", "colours"], "processors"),
    ];
    for (arguments, expected) in cases {
        let ran = rayloom(arguments.iter().copied());
        assert_eq!(ran.code, 2, "{arguments:?}");
        assert!(ran.stderr.contains(expected), "{arguments:?} gave {}", ran.stderr);
    }
}

#[test]
#[cfg(target_os = "linux")]
fn without_a_display_the_studio_says_what_works_instead() {
    let (_folder, file, _) = with_network(&slice());
    for arguments in [vec![], vec!["open", &file]] {
        let error = rayloom_without_display(arguments).error();
        assert!(error.contains("no display") && error.contains("rayloom render"), "{error}");
    }
    assert!(rayloom_without_display(["open", "no-such-network.json"]).error().contains("no-such-network.json"));
}

#[test]
#[cfg(target_os = "linux")]
fn without_an_adapter_only_rendering_fails_and_says_what_to_install() {
    let (_folder, file, picture) = with_network(&slice());
    for arguments in [vec!["adapter"], vec!["render", &file, "-o", &picture]] {
        let error = rayloom_without_adapter(arguments).error();
        assert!(error.contains("apt-get install mesa-vulkan-drivers libvulkan1"), "{error}");
    }
    rayloom_without_adapter(["check", &file]).output();
    rayloom_without_adapter(["list", "processors"]).output();
}
