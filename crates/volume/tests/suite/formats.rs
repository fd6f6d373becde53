//! Every format x element type x byte order x encoding, written here and read back.

use glam::DVec3;
use rayloom_volume::{ElementType, Volume, Voxels, format_of, formats};

use crate::files::{DIMS, Nifti, ORDERS, Order, bytes, gzip, load, nifti_code, put, text, voxels, zlib};

fn check(volume: &Volume, expected: &Voxels, channels: u32, case: &str) {
    assert_eq!((volume.dims, volume.channels), (DIMS, channels), "{case}");
    assert!(volume.voxels == *expected, "{case}: other voxels than written");
    assert_eq!(volume.name, "tiny", "{case}");
}

fn every_type_and_order(mut run: impl FnMut(ElementType, Order, &Voxels, &[u8])) {
    for element in ElementType::ALL {
        for order in ORDERS {
            let written = voxels(element, 1);
            run(element, order, &written, &bytes(&written, order));
        }
    }
}

#[test]
fn nifti_single_and_pairs_plain_and_compressed() {
    let folder = tempfile::tempdir().unwrap();
    every_type_and_order(|element, order, written, data| {
        for version in [1, 2] {
            let case = format!("nifti-{version} {element} {order:?}");
            let header = Nifti::new(version, order, nifti_code(element), DIMS);
            for (name, contents) in [("tiny.nii", header.with(data)), ("tiny.nii.gz", gzip(&header.with(data)))] {
                let volume = load(&put(folder.path(), name, contents)).unwrap();
                check(&volume, written, 1, &case);
            }
            let mut pair = header;
            let (magic, end) = if version == 2 { (4, b"ni2\0") } else { (344, b"ni1\0") };
            pair.bytes[magic..magic + 4].copy_from_slice(end);
            match version {
                2 => pair.i64(168, 0),
                _ => pair.f32(108, 0.0),
            }
            let hdr = put(folder.path(), "tiny.hdr", &pair.bytes);
            let img = put(folder.path(), "tiny.img", data);
            check(&load(&hdr).unwrap(), written, 1, &case);
            check(&load(&img).unwrap(), written, 1, &case);
            let hdr = put(folder.path(), "tiny.hdr.gz", gzip(&pair.bytes));
            put(folder.path(), "tiny.img.gz", gzip(data));
            std::fs::remove_file(&img).unwrap();
            check(&load(&hdr).unwrap(), written, 1, &case);
        }
    });
}

#[test]
fn nrrd_attached_and_detached_in_every_encoding() {
    let folder = tempfile::tempdir().unwrap();
    every_type_and_order(|element, order, written, data| {
        let type_name = match element {
            ElementType::I8 => "int8",
            ElementType::U8 => "unsigned char",
            ElementType::I16 => "short",
            ElementType::U16 => "unsigned short int",
            ElementType::I32 => "int",
            ElementType::U32 => "uint",
            ElementType::I64 => "long long",
            ElementType::U64 => "uint64_t",
            ElementType::F32 => "float",
            ElementType::F64 => "double",
        };
        let endian = format!("{order:?}").to_lowercase();
        let header = |encoding: &str| {
            format!(
                "NRRD0004\n# a comment\ntype: {type_name}\ndimension: 3\nsizes: 3 2 4\nendian: {endian}\nkey:=value: x\nencoding: {encoding}\n"
            )
        };
        for (encoding, packed) in [("raw", data.to_vec()), ("gzip", gzip(data)), ("ascii", text(written))] {
            let case = format!("nrrd {element} {order:?} {encoding}");
            let attached = [header(encoding).as_bytes(), b"\n", &packed].concat();
            check(&load(&put(folder.path(), "tiny.nrrd", attached)).unwrap(), written, 1, &case);

            let skipped = [b"one line\r\n".as_slice(), b"another\n", &packed].concat();
            put(folder.path(), "voxels.bin", skipped);
            let detached = header(encoding).replace('\n', "\r\n") + "line skip: 2\r\ndata file: voxels.bin\r\n";
            check(&load(&put(folder.path(), "tiny.nhdr", detached)).unwrap(), written, 1, &case);
        }
        put(folder.path(), "voxels.bin", [b"header of another program", data].concat());
        let from_end = header("raw") + "byte skip: -1\ndatafile: voxels.bin\n";
        check(&load(&put(folder.path(), "tiny.nhdr", from_end)).unwrap(), written, 1, "nrrd byte skip -1");
    });
}

#[test]
fn metaimage_local_and_separate_in_every_encoding() {
    let folder = tempfile::tempdir().unwrap();
    every_type_and_order(|element, order, written, data| {
        let type_name = match element {
            ElementType::I8 => "MET_CHAR",
            ElementType::U8 => "MET_UCHAR",
            ElementType::I16 => "MET_SHORT",
            ElementType::U16 => "MET_USHORT",
            ElementType::I32 => "MET_INT",
            ElementType::U32 => "MET_UINT",
            ElementType::I64 => "MET_LONG_LONG",
            ElementType::U64 => "MET_ULONG_LONG",
            ElementType::F32 => "MET_FLOAT",
            ElementType::F64 => "MET_DOUBLE",
        };
        let msb = if order == Order::Big { "True" } else { "False" };
        for (extra, packed) in
            [("", data.to_vec()), ("CompressedData = True\n", zlib(data)), ("BinaryData = False\n", text(written))]
        {
            let case = format!("metaimage {element} {order:?} {extra}");
            let header = format!(
                "ObjectType = Image\nNDims = 3\nDimSize = 3 2 4\nElementType = {type_name}\nBinaryDataByteOrderMSB = {msb}\n{extra}"
            );
            let local = [header.as_bytes(), b"ElementDataFile = LOCAL\n", &packed].concat();
            check(&load(&put(folder.path(), "tiny.mha", local)).unwrap(), written, 1, &case);
            put(folder.path(), "tiny.zraw", &packed);
            let separate = header + "ElementDataFile = tiny.zraw\n";
            check(&load(&put(folder.path(), "tiny.mhd", separate)).unwrap(), written, 1, &case);
        }
    });
}

#[test]
fn dat_in_both_dialects() {
    let folder = tempfile::tempdir().unwrap();
    every_type_and_order(|element, order, written, data| {
        let (voreen, inviwo) = match element {
            ElementType::I8 => ("CHAR", "INT8"),
            ElementType::U8 => ("UCHAR", "UINT8"),
            ElementType::I16 => ("SHORT", "INT16"),
            ElementType::U16 => ("USHORT", "UINT16"),
            ElementType::I32 => ("INT", "INT32"),
            ElementType::U32 => ("UINT", "UINT32"),
            ElementType::I64 => ("INT64", "INT64"),
            ElementType::U64 => ("UINT64", "UINT64"),
            ElementType::F32 => ("FLOAT", "FLOAT32"),
            ElementType::F64 => ("DOUBLE", "FLOAT64"),
        };
        put(folder.path(), "tiny.raw", data);
        let endian = format!("{order:?}");
        let header = format!(
            "ObjectFileName: tiny.raw\nResolution:\t3 2 4\nSliceThickness: 1 2 0.5\nFormat: {voreen}\nObjectModel: I\nEndianness: {endian}\nModality: CT\n"
        );
        let volume = load(&put(folder.path(), "tiny.dat", header)).unwrap();
        check(&volume, written, 1, voreen);
        assert_eq!(volume.spacing(), DVec3::new(1.0, 2.0, 0.5));
        assert!(volume.texture_to_world().transform_point3(DVec3::splat(0.5)).length() < 1e-12, "centred");

        put(folder.path(), "tiny.raw", [b"12345", data].concat());
        let header = format!(
            "RawFile: tiny.raw\nResolution: 3 2 4\nFormat: {inviwo}\nByteOffset: 5\nByteOrder: {endian}Endian\n"
        );
        check(&load(&put(folder.path(), "tiny.dat", header)).unwrap(), written, 1, inviwo);
    });
}

#[test]
fn described_raw_in_every_encoding() {
    let folder = tempfile::tempdir().unwrap();
    every_type_and_order(|element, order, written, data| {
        let endian = format!("{order:?}").to_lowercase();
        let padded = [b"xyz".as_slice(), data].concat();
        let cases = [
            ("raw", padded.clone(), 3),
            ("gzip", gzip(&padded), 3),
            ("zlib", zlib(&padded), 3),
            ("ascii", text(written), 0),
        ];
        for (encoding, packed, offset) in cases {
            put(folder.path(), "voxels", packed);
            let description = format!(
                r#"{{"raw": "voxels", "dims": [3, 2, 4], "type": "{element}", "endian": "{endian}", "encoding": "{encoding}", "offset": {offset}}}"#
            );
            let volume = load(&put(folder.path(), "tiny.volume.json", description)).unwrap();
            check(&volume, written, 1, &format!("described {element} {order:?} {encoding}"));
        }
    });
}

#[test]
fn channels_come_out_interleaved() {
    let folder = tempfile::tempdir().unwrap();
    for channels in 1..=4 {
        let written = voxels(ElementType::I16, channels);
        let data = bytes(&written, Order::Little);
        let nrrd =
            format!("NRRD0005\ntype: short\ndimension: 4\nsizes: {channels} 3 2 4\nendian: little\nencoding: raw\n\n");
        check(
            &load(&put(folder.path(), "tiny.nrrd", [nrrd.as_bytes(), &data].concat())).unwrap(),
            &written,
            channels,
            "nrrd",
        );
        let mha = format!(
            "NDims = 3\nDimSize = 3 2 4\nElementNumberOfChannels = {channels}\nElementType = MET_SHORT\nElementDataFile = LOCAL\n"
        );
        check(
            &load(&put(folder.path(), "tiny.mha", [mha.as_bytes(), &data].concat())).unwrap(),
            &written,
            channels,
            "mha",
        );

        // NIfTI stores one component after the other.
        let Voxels::I16(elements) = &written else { unreachable!("written as i16") };
        let planes: Vec<i16> =
            (0..channels as usize).flat_map(|c| elements.iter().skip(c).step_by(channels as usize).copied()).collect();
        let mut header = Nifti::new(1, Order::Little, 4, DIMS);
        header.dim(0, 5);
        header.dim(4, 1);
        header.dim(5, i64::from(channels));
        let nifti = put(folder.path(), "tiny.nii", header.with(&bytes(&Voxels::I16(planes), Order::Little)));
        check(&load(&nifti).unwrap(), &written, channels, "nifti vectors");
    }
    for (code, channels) in [(128, 3), (2304, 4)] {
        let written = voxels(ElementType::U8, channels);
        let header = Nifti::new(1, Order::Big, code, DIMS);
        let nifti = put(folder.path(), "tiny.nii", header.with(&bytes(&written, Order::Big)));
        check(&load(&nifti).unwrap(), &written, channels, "nifti colours");
    }
}

#[test]
fn progress_ends_with_the_whole_and_never_goes_back() {
    let folder = tempfile::tempdir().unwrap();
    let count = 20 << 20;
    put(folder.path(), "big", gzip(&vec![7; count]));
    let description = r#"{"raw": "big", "dims": [1024, 1024, 20], "type": "u8", "encoding": "gzip"}"#;
    let path = put(folder.path(), "big.volume.json", description);
    let mut reports = Vec::new();
    rayloom_volume::read(&path, &mut |progress| reports.push(progress)).unwrap();
    assert!(reports.len() > 1 && reports.windows(2).all(|pair| pair[0].done < pair[1].done));
    assert!(reports.iter().all(|report| report.total == count as u64));
    assert_eq!(reports.last().map(|report| report.done), Some(count as u64));
}

#[test]
fn names_stand_for_formats_whatever_their_case() {
    for format in formats() {
        for extension in format.extensions {
            let path = format!("/some.where/A.B.{}", extension.to_uppercase());
            assert_eq!(format_of(path.as_ref()).map(|found| found.id), Some(format.id), "{path}");
        }
    }
    assert!(format_of("nii".as_ref()).is_none() && format_of("head.raw".as_ref()).is_none());
    let refusal = load("head.den".as_ref()).unwrap_err().to_string();
    assert!(refusal.contains("head.den") && refusal.contains("volume.json"), "{refusal}");
}
