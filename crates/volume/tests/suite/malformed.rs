//! Headers that lie, contradict themselves or end too early: always an error that names the file, never a panic and never
//! more memory than the file is worth.

use std::path::Path;

use proptest::prelude::*;

use crate::files::{DIMS, Nifti, Order, gzip, load, put, zlib};

/// Asserts that a file is refused with a message that names `named`.
fn refused(path: &Path, named: &str, case: &str) {
    match load(path) {
        Ok(volume) => panic!("{case}: read as {:?} x {} of {:?}", volume.dims, volume.channels, volume.voxels),
        Err(error) => {
            let message = error.to_string();
            assert!(message.contains(named), "{case}: the message does not name {named}: {message}");
            assert!(message.len() < 1200, "{case}: the message is too long: {message}");
        }
    }
}

/// Replaces one line of a good header after another and expects every result to be refused.
fn corrupt_lines(name: &str, good: &str, data: &[u8], replacements: &[(&str, &[&str])]) -> usize {
    let folder = tempfile::tempdir().unwrap();
    let folder_name = folder.path().to_string_lossy().into_owned();
    put(folder.path(), "a.raw", data);
    load(&put(folder.path(), name, good)).expect("the header is good before it is corrupted");
    let mut cases = 0;
    for (line, variants) in replacements {
        assert!(good.contains(line), "{line} is a line of the good header");
        for variant in *variants {
            let path = put(folder.path(), name, good.replace(line, variant));
            let named = if variant.contains("missing.raw") { "missing.raw" } else { &folder_name };
            refused(&path, named, &format!("{name}: {variant:?}"));
            cases += 1;
        }
    }
    cases
}

const NRRD: &str = "NRRD0004\ntype: short\ndimension: 3\nsizes: 3 2 4\nendian: little\nencoding: raw\nspacings: 1 1 1\nbyte skip: 0\ndata file: a.raw\n";
const MHD: &str = "ObjectType = Image\nNDims = 3\nDimSize = 3 2 4\nElementSpacing = 1 1 1\nElementType = MET_SHORT\nHeaderSize = 0\nCompressedData = False\nElementDataFile = a.raw\n";
const DAT: &str = "ObjectFileName: a.raw\nResolution: 3 2 4\nSliceThickness: 1 1 1\nFormat: USHORT\nObjectModel: I\n";
const JSON: &str = r#"{"raw": "a.raw", "dims": [3, 2, 4], "type": "u16", "offset": 0, "channels": 1, "spacing": [1, 1, 1], "slope": 1}"#;

#[test]
fn corpus_of_text_headers() {
    let data = [0; 48];
    let mut cases = corrupt_lines(
        "a.nrrd",
        NRRD,
        &data,
        &[
            ("NRRD0004", &["", "NRRX0004", "PK\u{3}\u{4}", "P5 3 2"]),
            ("type: short\n", &["", "type: shorts\n", "type: block\n", "type:\n", "type: double\n"]),
            (
                "dimension: 3\n",
                &[
                    "",
                    "dimension: 0\n",
                    "dimension: 4\n",
                    "dimension: -3\n",
                    "dimension: 99999999999999999999\n",
                    "dimension: x\n",
                ],
            ),
            (
                "sizes: 3 2 4\n",
                &[
                    "",
                    "sizes: 3 2\n",
                    "sizes: 3 2 0\n",
                    "sizes: 3 2 -4\n",
                    "sizes: 3 2 4.5\n",
                    "sizes: 3 2 5\n",
                    "sizes: 4294967295 4294967295 4294967295\n",
                    "sizes: 99999999999999999999999 2 4\n",
                    "sizes: 2097152 2097152 2097152\n",
                    "sizes: 3 two 4\n",
                ],
            ),
            ("endian: little\n", &["", "endian: middle\n"]),
            ("encoding: raw\n", &["", "encoding: bzip2\n", "encoding: hex\n", "encoding: zip\n", "encoding: gzip\n"]),
            (
                "spacings: 1 1 1\n",
                &[
                    "spacings: 1 1\n",
                    "spacings: 1 0 1\n",
                    "spacings: nan 1 1\n",
                    "spacings: 1 inf 1\n",
                    "spacings: a b c\n",
                ],
            ),
            (
                "spacings: 1 1 1\n",
                &[
                    "space directions: (1,0,0) (0,1,0)\n",
                    "space directions: (1,0,0) (2,0,0) (0,0,1)\n",
                    "space directions: (1,0,0 (0,1,0) (0,0,1)\n",
                    "space directions: none none none\n",
                    "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace: upside-down\n",
                    "kinds: domain domain time\n",
                    "not a field\n",
                ],
            ),
            (
                "byte skip: 0\n",
                &[
                    "byte skip: -2\n",
                    "byte skip: 1\n",
                    "byte skip: 18446744073709551615\n",
                    "byte skip: 9223372036854775807\n",
                    "line skip: 1\n",
                ],
            ),
            (
                "data file: a.raw\n",
                &[
                    "",
                    "data file: missing.raw\n",
                    "data file: LIST\n",
                    "data file: a%03d.raw 1 9 1\n",
                    "data file: .\n",
                    "data file:\n",
                ],
            ),
        ],
    );
    cases += corrupt_lines(
        "a.mhd",
        MHD,
        &data,
        &[
            ("ObjectType = Image\n", &["\u{0}\u{1}\u{2}\n", "no equals sign\n"]),
            ("NDims = 3\n", &["", "NDims = 0\n", "NDims = 2\n", "NDims = 4\n", "NDims = many\n"]),
            (
                "DimSize = 3 2 4\n",
                &[
                    "",
                    "DimSize = 3 2\n",
                    "DimSize = 0 2 4\n",
                    "DimSize = 3 2 400\n",
                    "DimSize = 4000000000 4000000000 4000000000\n",
                    "DimSize = -3 2 4\n",
                ],
            ),
            (
                "ElementSpacing = 1 1 1\n",
                &[
                    "ElementSpacing = 1 1\n",
                    "ElementSpacing = 0 1 1\n",
                    "ElementSpacing = NaN 1 1\n",
                    "TransformMatrix = 1 0 0\n",
                    "TransformMatrix = 1 0 0 1 0 0 0 0 1\n",
                    "Offset = 1 2\n",
                    "ElementNumberOfChannels = 0\n",
                    "ElementNumberOfChannels = 5\n",
                    "ElementNumberOfChannels = 2\n",
                    "ElementToIntensityFunctionSlope = 0\n",
                ],
            ),
            (
                "ElementType = MET_SHORT\n",
                &["", "ElementType = MET_NONE\n", "ElementType = SHORT\n", "ElementType = MET_DOUBLE\n"],
            ),
            (
                "HeaderSize = 0\n",
                &["HeaderSize = -2\n", "HeaderSize = 40\n", "HeaderSize = 9223372036854775807\n", "HeaderSize = x\n"],
            ),
            (
                "CompressedData = False\n",
                &["CompressedData = True\n", "CompressedData = Perhaps\n", "BinaryData = False\n"],
            ),
            (
                "ElementDataFile = a.raw\n",
                &[
                    "",
                    "ElementDataFile = missing.raw\n",
                    "ElementDataFile = LIST\n",
                    "ElementDataFile = slice%03d.raw 1 4 1\n",
                    "ElementDataFile = LOCAL\n",
                ],
            ),
        ],
    );
    cases += corrupt_lines(
        "a.dat",
        DAT,
        &data,
        &[
            ("ObjectFileName: a.raw\n", &["", "ObjectFileName: missing.raw\n", "ObjectFileName:\n", "gibberish\n"]),
            (
                "Resolution: 3 2 4\n",
                &[
                    "",
                    "Resolution: 3 2\n",
                    "Resolution: 3 0 4\n",
                    "Resolution: 3 2 4 5\n",
                    "Resolution: 300 200 400\n",
                    "Resolution: 9999999999 1 1\n",
                ],
            ),
            (
                "SliceThickness: 1 1 1\n",
                &["SliceThickness: 1 1\n", "SliceThickness: 0 1 1\n", "SliceThickness: inf 1 1\n"],
            ),
            ("Format: USHORT\n", &["", "Format: WORD\n", "Format: Vec9UINT8\n", "Format: Vecé\n", "Format: DOUBLE\n"]),
            (
                "ObjectModel: I\n",
                &[
                    "ObjectModel: XYZ\n",
                    "ObjectModel: RGB\n",
                    "ByteOrder: PDP\n",
                    "ByteOffset: -1\n",
                    "ByteOffset: 1\n",
                ],
            ),
        ],
    );
    cases += corrupt_lines(
        "a.volume.json",
        JSON,
        &data,
        &[
            (r#"{"raw""#, &["[", "{", r#"{"row""#, ""]),
            (r#""a.raw""#, &["3", r#""missing.raw""#, r#""""#]),
            (
                "[3, 2, 4]",
                &[
                    "[3, 2]",
                    "[3, 2, 0]",
                    "[3, 2, -1]",
                    "[3, 2, 1e9]",
                    "[3, 2, 5]",
                    "[4294967295, 4294967295, 4294967295]",
                    "[99999999999, 1, 1]",
                ],
            ),
            (r#""u16""#, &[r#""u12""#, "16", r#""f64""#]),
            (
                r#""offset": 0"#,
                &[r#""offset": 1"#, r#""offset": -1"#, r#""offset": 18446744073709551615"#, r#""offst": 0"#],
            ),
            (
                r#""channels": 1"#,
                &[
                    r#""channels": 0"#,
                    r#""channels": 5"#,
                    r#""channels": 2"#,
                    r#""endian": "odd""#,
                    r#""encoding": "lzma""#,
                ],
            ),
            (
                r#""spacing": [1, 1, 1]"#,
                &[
                    r#""spacing": [0, 1, 1]"#,
                    r#""spacing": [1, 1]"#,
                    r#""directions": [[1,0,0],[1,0,0],[0,0,1]]"#,
                    r#""origin": [1e999, 0, 0]"#,
                ],
            ),
            (r#""slope": 1"#, &[r#""slope": 0"#, r#""slope": null, "intercept": 1e999"#]),
        ],
    );
    assert!(cases >= 100, "{cases} cases");
}

#[test]
fn corpus_of_nifti_headers() {
    let folder = tempfile::tempdir().unwrap();
    type Change = fn(&mut Nifti);
    let changes: [(&str, Change); 16] = [
        ("sizeof_hdr", |h| h.i32(0, 12345)),
        ("no dimensions", |h| h.dim(0, 0)),
        ("too many dimensions", |h| h.dim(0, 8)),
        ("a zero dimension", |h| h.dim(2, 0)),
        ("a negative dimension", |h| h.dim(3, -7)),
        ("a dimension too long", |h| h.dim(3, 5)),
        ("huge dimensions", |h| (1..4).for_each(|d| h.dim(d, 32767))),
        ("a time series", |h| {
            h.dim(0, 4);
            h.dim(4, 9);
        }),
        ("vectors of five", |h| {
            h.dim(0, 5);
            h.dim(4, 1);
            h.dim(5, 5);
        }),
        ("an unknown type", |h| h.i16(if h.version == 2 { 12 } else { 70 }, 77)),
        ("complex numbers", |h| h.i16(if h.version == 2 { 12 } else { 70 }, 32)),
        ("magic", |h| {
            let at = if h.version == 2 { 4 } else { 344 };
            h.bytes[at..at + 4].copy_from_slice(b"nope");
        }),
        ("a zero voxel size", |h| h.real(76, 104, 2, 0.0)),
        ("a voxel size that is no number", |h| h.real(76, 104, 1, f64::NAN)),
        ("an offset inside of the header", |h| if h.version == 2 { h.i64(168, 12) } else { h.f32(108, 12.0) }),
        ("an offset behind the file", |h| if h.version == 2 { h.i64(168, i64::MAX) } else { h.f32(108, f32::MAX) }),
    ];
    for version in [1, 2] {
        for order in [Order::Little, Order::Big] {
            for (case, change) in &changes {
                let mut header = Nifti::new(version, order, 4, DIMS);
                change(&mut header);
                let file = header.with(&[0; 48]);
                refused(&put(folder.path(), "a.nii", &file), "a.nii", case);
                refused(&put(folder.path(), "a.nii.gz", gzip(&file)), "a.nii.gz", case);
            }
            let whole = Nifti::new(version, order, 4, DIMS).with(&[0; 48]);
            for length in 0..whole.len() {
                refused(&put(folder.path(), "a.nii", &whole[..length]), "a.nii", &format!("cut to {length} bytes"));
            }
        }
    }
    let mut pair = Nifti::new(1, Order::Little, 4, DIMS);
    pair.bytes[344..348].copy_from_slice(b"ni1\0");
    pair.f32(108, 0.0);
    refused(&put(folder.path(), "alone.hdr", &pair.bytes), "alone.img", "a header without voxels");
}

#[test]
fn compressed_data_that_is_cut_or_damaged() {
    let folder = tempfile::tempdir().unwrap();
    let header = Nifti::new(1, Order::Little, 4, DIMS);
    let noise: Vec<u8> = (0..48_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    let packed = gzip(&header.with(&noise));
    for length in 0..packed.len() {
        refused(&put(folder.path(), "a.nii.gz", &packed[..length]), "a.nii.gz", &format!("gzip cut to {length} bytes"));
    }
    let mut damaged = packed;
    let checksum = damaged.len() - 6;
    damaged[checksum] ^= 0x55;
    refused(&put(folder.path(), "a.nii.gz", &damaged), "a.nii.gz", "wrong checksum");

    let mhd = MHD.replace("CompressedData = False", "CompressedData = True");
    let path = put(folder.path(), "a.mhd", mhd);
    let packed = zlib(&noise);
    for length in 0..packed.len() - 4 {
        put(folder.path(), "a.raw", &packed[..length]);
        refused(&path, "a.raw", &format!("zlib cut to {length} bytes"));
    }
}

/// A small compressed file cannot make the reader take the memory that its header asks for.
#[test]
fn bombs_are_refused_before_memory_is_taken() {
    let folder = tempfile::tempdir().unwrap();
    put(folder.path(), "a.raw", gzip(&vec![0; 1 << 20]));
    for dims in ["[2097152, 2097152, 2097151]", "[1000000, 1000, 1000]", "[4096, 4096, 4096]"] {
        let description = format!(r#"{{"raw": "a.raw", "dims": {dims}, "type": "u8", "encoding": "gzip"}}"#);
        refused(&put(folder.path(), "a.volume.json", description), "a.raw", dims);
    }
    // Data that goes on behind the last voxel is not unpacked.
    let description = r#"{"raw": "a.raw", "dims": [2, 2, 2], "type": "u8", "encoding": "gzip"}"#;
    assert_eq!(load(&put(folder.path(), "a.volume.json", description)).unwrap().voxel_count(), 8);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    /// Whatever bytes change, the reader answers: with a volume or with an error that names a file.
    #[test]
    fn any_damage_is_survived(
        format in 0..5_usize,
        changes in proptest::collection::vec((any::<proptest::sample::Index>(), any::<u8>()), 1..6),
        cut in proptest::option::of(any::<proptest::sample::Index>()),
    ) {
        let folder = tempfile::tempdir().unwrap();
        put(folder.path(), "a.raw", [7; 48]);
        let (name, mut file) = match format {
            0 => ("a.nii", Nifti::new(1, Order::Little, 4, DIMS).with(&[7; 48])),
            1 => ("a.nrrd", NRRD.as_bytes().to_vec()),
            2 => ("a.mhd", MHD.as_bytes().to_vec()),
            3 => ("a.dat", DAT.as_bytes().to_vec()),
            _ => ("a.volume.json", JSON.as_bytes().to_vec()),
        };
        for (at, byte) in changes {
            let at = at.index(file.len());
            file[at] = byte;
        }
        if let Some(cut) = cut {
            file.truncate(cut.index(file.len()));
        }
        match load(&put(folder.path(), name, file)) {
            Ok(volume) => prop_assert!(volume.voxels.len() <= 48),
            Err(error) => prop_assert!(error.to_string().contains(&*folder.path().to_string_lossy())),
        }
    }
}
