//! Where the headers place the voxels in the world, and what they make of their values.

use glam::{DVec3, dvec3};
use rayloom_volume::Volume;

use crate::files::{DIMS, Nifti, Order, load, put};

const COUNT: usize = 24;

fn world(volume: &Volume, index: [f64; 3]) -> DVec3 {
    volume.index_to_world.transform_point3(DVec3::from_array(index))
}

fn assert_near(found: DVec3, expected: DVec3) {
    assert!((found - expected).length() < 1e-5, "{found} instead of {expected}");
}

fn load_text(name: &str, header: &str) -> Volume {
    let folder = tempfile::tempdir().unwrap();
    load(&put(folder.path(), name, [header.as_bytes(), &[1; COUNT]].concat())).unwrap()
}

fn load_nifti(change: impl Fn(&mut Nifti)) -> [Volume; 2] {
    [1, 2].map(|version| {
        let folder = tempfile::tempdir().unwrap();
        let mut header = Nifti::new(version, Order::Big, 2, DIMS);
        change(&mut header);
        load(&put(folder.path(), "a.nii", header.with(&[1; COUNT]))).unwrap()
    })
}

#[test]
fn nifti_prefers_sform_to_qform_to_voxel_sizes() {
    let sizes = |header: &mut Nifti| (0..3).for_each(|axis| header.real(76, 104, axis + 1, 2.0 + axis as f64));
    for volume in load_nifti(sizes) {
        assert_near(world(&volume, [1.0, 1.0, 1.0]), dvec3(2.0, 3.0, 4.0));
    }
    // A quarter turn around z: x goes to y and y to -x; the third axis is mirrored.
    let quarter = std::f64::consts::FRAC_1_SQRT_2;
    let qform = |header: &mut Nifti| {
        sizes(header);
        header.qform([0.0, 0.0, quarter], [10.0, 20.0, 30.0], -1.0);
    };
    for volume in load_nifti(qform) {
        assert_near(world(&volume, [0.0, 0.0, 0.0]), dvec3(10.0, 20.0, 30.0));
        assert_near(world(&volume, [1.0, 2.0, 3.0]), dvec3(10.0 - 6.0, 20.0 + 2.0, 30.0 - 12.0));
    }
    let sform = |header: &mut Nifti| {
        qform(header);
        header.sform([[-0.5, 0.0, 0.0, 7.0], [0.0, 0.25, 0.125, 8.0], [0.0, 0.0, 2.0, 9.0]]);
    };
    for volume in load_nifti(sform) {
        assert_near(world(&volume, [2.0, 4.0, 1.0]), dvec3(6.0, 9.125, 11.0));
    }
    let degenerate = |header: &mut Nifti| {
        qform(header);
        header.sform([[0.0; 4]; 3]);
    };
    for volume in load_nifti(degenerate) {
        assert_near(world(&volume, [0.0, 0.0, 0.0]), dvec3(10.0, 20.0, 30.0));
    }
}

#[test]
fn nifti_units_and_rescaling() {
    let metres = |header: &mut Nifti| match header.version {
        2 => header.i32(500, 1 + 8),
        _ => header.bytes[123] = 1 + 8,
    };
    assert_near(load_nifti(metres)[0].spacing(), DVec3::splat(1000.0));
    assert_near(load_nifti(metres)[1].spacing(), DVec3::splat(1000.0));
    for volume in load_nifti(|header| header.rescale(-2.0, 100.0)) {
        assert_eq!(volume.value([0, 0, 0], 0), 98.0);
    }
    for slope in [0.0, f64::NAN] {
        for volume in load_nifti(|header| header.rescale(slope, 100.0)) {
            assert_eq!(volume.value([0, 0, 0], 0), 1.0, "slope {slope} means none");
        }
    }
}

#[test]
fn nrrd_spaces_directions_and_spacings() {
    let header =
        |fields: &str| format!("NRRD0004\ntype: uchar\ndimension: 3\nsizes: 3 2 4\nencoding: raw\n{fields}\n\n");
    let directions = "space directions: (0.5,0,0) (0, 0, 2) (0,-3,0)\nspace origin: (1,2,3)";
    let spaces = [
        ("right-anterior-superior", dvec3(1.5, -1.0, 5.0)),
        ("left-posterior-superior", dvec3(-1.5, 1.0, 5.0)),
        ("LAS", dvec3(-1.5, -1.0, 5.0)),
    ];
    for (space, expected) in spaces {
        let volume = load_text("a.nrrd", &header(&format!("space: {space}\n{directions}")));
        assert_near(world(&volume, [1.0, 1.0, 1.0]), expected);
    }
    let volume = load_text("a.nrrd", &header("spacings: 2 3 4\naxis mins: 10 20 30\ncenters: cell node cell"));
    assert_near(world(&volume, [0.0; 3]), dvec3(11.0, 20.0, 32.0));
    assert_near(volume.spacing(), dvec3(2.0, 3.0, 4.0));

    let colours = "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 3 2 2\nkinds: vector domain domain domain\nencoding: raw\n\
                   space: LPS\nspace directions: none (1,0,0) (0,2,0) (0,0,3)\n\n";
    let volume = load_text("a.nrrd", colours);
    assert_eq!((volume.dims, volume.channels), ([3, 2, 2], 2));
    assert_near(world(&volume, [1.0, 1.0, 1.0]), dvec3(-1.0, -2.0, 3.0));

    let flat =
        load_text("a.nrrd", "NRRD0001\ntype: uchar\ndimension: 2\nsizes: 6 4\nspacings: 0.5 1\nencoding: raw\n\n");
    assert_eq!(flat.dims, [6, 4, 1]);
}

#[test]
fn metaimage_axes_are_rows_and_point_left_and_back() {
    let header = "NDims = 3\nDimSize = 3 2 4\nElementType = MET_UCHAR\nElementSpacing = 2 3 4\nOffset = 10 20 30\n\
                  TransformMatrix = 0 1 0 -1 0 0 0 0 1\nElementToIntensityFunctionSlope = 0.5\nElementToIntensityFunctionOffset = -1\nElementDataFile = LOCAL\n";
    let volume = load_text("a.mha", header);
    assert_near(world(&volume, [0.0; 3]), dvec3(-10.0, -20.0, 30.0));
    assert_near(world(&volume, [1.0, 0.0, 0.0]), dvec3(-10.0, -22.0, 30.0));
    assert_near(world(&volume, [0.0, 1.0, 0.0]), dvec3(-7.0, -20.0, 30.0));
    assert_eq!(volume.value([0, 0, 0], 0), -0.5);
}

#[test]
fn inviwo_basis_spans_the_box_from_its_corner() {
    let folder = tempfile::tempdir().unwrap();
    put(folder.path(), "a.raw", [1; COUNT]);
    let header = "RawFile: a.raw\nResolution: 3 2 4\nFormat: UINT8\nBasisVector1: 6 0 0\nBasisVector2: 0 2 0\nBasisVector3: 0 0 2\nOffset: -3 0 5\n";
    let volume = load(&put(folder.path(), "a.dat", header)).unwrap();
    assert_near(volume.texture_to_world().transform_point3(DVec3::ZERO), dvec3(-3.0, 0.0, 5.0));
    assert_near(volume.texture_to_world().transform_point3(DVec3::ONE), dvec3(3.0, 2.0, 7.0));
}

#[test]
fn descriptions_place_and_name_the_volume() {
    let folder = tempfile::tempdir().unwrap();
    put(folder.path(), "a.raw", [3; COUNT]);
    let description = r#"{"raw": "a.raw", "dims": [3, 2, 4], "type": "u8", "spacing": [1, 2, 3], "origin": [4, 5, 6],
        "directions": [[0, 1, 0], [1, 0, 0], [0, 0, -1]], "slope": 2, "intercept": 1, "name": "a head"}"#;
    let volume = load(&put(folder.path(), "a.volume.json", description)).unwrap();
    assert_near(world(&volume, [1.0, 1.0, 1.0]), dvec3(6.0, 6.0, 3.0));
    assert_eq!((volume.value([2, 1, 3], 0), volume.name.as_str()), (7.0, "a head"));
}
