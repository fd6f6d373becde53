//! The volumes that ship with the project.

use std::path::Path;

use glam::{DVec3, dvec3};
use rayloom_volume::{Volume, read};

fn load(name: &str) -> Volume {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data").join(name);
    read(&path, &mut |_| ()).unwrap()
}

#[test]
fn all_can_be_read() {
    let cases = [
        ("ch2.nii.gz", [181, 217, 181], 1.0),
        ("aal.nii.gz", [181, 217, 181], 1.0),
        ("ch2better.nii.gz", [301, 370, 316], 0.5),
        ("brainsmall.volume.json", [128, 128, 84], 1.0),
    ];
    for (name, dims, spacing) in cases {
        let volume = load(name);
        assert_eq!((volume.dims, volume.channels), (dims, 1), "{name}");
        assert!((volume.spacing() - DVec3::splat(spacing)).length() < 1e-6, "{name}");
        let range = volume.ranges()[0];
        assert!(range.min == 0.0 && range.max > 100.0 && range.max <= 255.0, "{name}: {range:?}");
        assert_eq!(volume.non_finite(), 0, "{name}");
    }
}

#[test]
fn the_brain_lies_where_its_labels_lie() {
    let (brain, labels) = (load("ch2.nii.gz"), load("aal.nii.gz"));
    assert_eq!(brain.index_to_world, labels.index_to_world);
    // The anterior commissure is the world's origin, in the middle between left and right.
    let origin = brain.index_to_world.inverse().transform_point3(DVec3::ZERO);
    assert!((origin - dvec3(90.0, 125.0, 71.0)).length() < 2.0, "{origin}");
}
