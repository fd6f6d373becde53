//! `list`, `info`, `check` and `adapter`.

use serde_json::Value as Json;

use crate::program::rayloom;

#[test]
fn everything_listed_as_json_has_id_and_help() {
    for (what, known) in [("processors", "ray_traversal"), ("snippets", "central"), ("formats", "nifti")] {
        let json: Json = serde_json::from_str(&rayloom(["list", what, "--json"]).output()).expect("JSON");
        let entries = json.as_array().expect("a list");
        let filled = |entry: &Json, key: &str| entry[key].as_str().is_some_and(|text| !text.is_empty());
        for entry in entries {
            assert!(["id", "label", "help"].iter().all(|key| filled(entry, key)), "{entry}");
        }
        assert!(entries.iter().any(|entry| entry["id"] == known), "{what} lack {known}");
        let text = rayloom(["list", what]).output();
        let name = if what == "formats" { ".nii.gz" } else { known };
        assert!(text.contains(name), "{text}");
    }
}

#[test]
fn every_property_and_port_has_help() {
    let json: Json = serde_json::from_str(&rayloom(["list", "processors", "--json"]).output()).expect("JSON");
    for processor in json.as_array().expect("a list") {
        for group in ["inports", "outports", "properties"] {
            for entry in processor[group].as_array().expect("a list") {
                let help = entry["help"].as_str().unwrap_or_default();
                assert!(!help.is_empty(), "{}.{} has no help", processor["id"], entry["id"]);
            }
        }
    }
}

#[test]
fn a_volume_is_described() {
    let text = rayloom(["info", "data/ch2.nii.gz"]).output();
    for fact in ["181 x 217 x 181 voxels", "u8", "NIfTI", "spacing     1, 1, 1", "channel 0"] {
        assert!(text.contains(fact), "{fact} is not in {text}");
    }
}

#[test]
fn every_shipped_network_passes_the_check() {
    let networks = std::fs::read_dir(crate::program::root().join("networks")).expect("the folder of networks");
    let files =
        networks.map(|entry| entry.expect("an entry").path()).filter(|path| path.extension() == Some("json".as_ref()));
    let mut count = 0;
    for file in files {
        let ran = rayloom(["check", file.to_str().expect("a path in UTF-8")]);
        assert_eq!(ran.stderr, "", "{}", file.display());
        assert!(ran.output().contains("ready"));
        count += 1;
    }
    assert!(count > 0);
}

#[test]
fn the_adapter_is_named() {
    assert!(rayloom(["adapter"]).output().contains("largest volume"));
}
