//! Reference pictures on disk.

use crate::scenes::*;
use glam::DVec3;
use rayloom_reference::shading::{Diffuse, Highlight, Shading};
use rayloom_reference::{
    Cache, Camera, Classification, FirstHit, Image, Labels, Layer, Method, Rectangle, Reference, Refinement, Scene,
    Source, unattended,
};
use rayloom_volume::{Label, LabelTable, TransferFunction, Volume};
use std::collections::BTreeSet;
use std::sync::Arc;

fn noisy() -> Volume {
    volume([5, 4, 3], filling([5, 4, 3], DVec3::ZERO, DVec3::ONE), noise)
}

fn scene(volume: &Volume) -> Scene<'_> {
    let camera = Camera::perspective(DVec3::new(2.0, 1.4, -1.8), DVec3::splat(0.5), 30.0);
    Scene::new(volume, colorful(), camera, [6, 5])
}

fn render(cache: &Cache, reference: Reference, scene: &Scene<'_>) -> (Image, bool) {
    let cached = cache.render(reference, scene, None, &unattended).expect("the scene makes sense");
    (cached.image, matches!(cached.source, Source::Found))
}

#[test]
fn pictures_are_found_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = Cache::new(folder.path().join("made/on/demand"));
    let volume = noisy();
    for reference in Reference::ALL {
        assert_eq!(Reference::from_id(reference.id()), Some(reference));
        let (image, found) = render(&cache, reference, &scene(&volume));
        assert!(!found && image == reference.render(&scene(&volume), None, &unattended).expect("a picture"));
        assert_eq!(render(&cache, reference, &scene(&volume)), (image.clone(), true));
        let part = Some(Rectangle { x: 1, y: 2, width: 3, height: 2 });
        for _ in 0..2 {
            let cached = cache.render(reference, &scene(&volume), part, &unattended).expect("a picture");
            assert_eq!(cached.image.pixel(2, 1), image.pixel(3, 3));
        }
    }
}

#[test]
fn damaged_files_are_rendered_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = Cache::new(folder.path());
    let volume = noisy();
    let (expected, _) = render(&cache, Reference::Exact, &scene(&volume));
    let path = cache.path(Reference::Exact, &scene(&volume), None);
    let whole = std::fs::read(&path).expect("the file was written");
    let mut flipped = whole.clone();
    flipped[200] ^= 1;
    let mut newer = whole.clone();
    newer[7] = 2;
    for damaged in [&whole[..100], &[][..], &flipped, &newer, &[whole.clone(), vec![0; 8]].concat()] {
        std::fs::write(&path, damaged).expect("the file can be written");
        assert_eq!(render(&cache, Reference::Exact, &scene(&volume)), (expected.clone(), false));
        assert_eq!(std::fs::read(&path).expect("the file was written again"), whole);
    }
    assert_eq!(std::fs::read_dir(folder.path()).expect("the folder").count(), 1);
}

#[test]
fn folders_that_cannot_be_written_are_no_error() {
    let file = tempfile::NamedTempFile::new().expect("a file");
    let cache = Cache::new(file.path());
    let volume = noisy();
    let cached = cache.render(Reference::Exact, &scene(&volume), None, &unattended).expect("a picture all the same");
    assert!(matches!(cached.source, Source::NotKept(_)));
}

#[test]
fn whatever_changes_a_picture_changes_its_file() {
    let cache = Cache::new("nowhere");
    let volume = noisy();
    let mut moved = noisy();
    moved.index_to_world.translation.x += 1e-12;
    let other = self::volume([5, 4, 3], volume.index_to_world, |p| noise(p) + if p.x < 0.2 { 1e-15 } else { 0.0 });
    let mut fainter = colorful();
    fainter.knots[1].opacity = 0.31;
    let change = |change: &dyn Fn(&mut Scene<'_>)| {
        let mut changed = scene(&volume);
        change(&mut changed);
        changed
    };
    let by_labels = |dims, number, transfer_function: TransferFunction| {
        let volume = Arc::new(self::volume(dims, volume.index_to_world, |p| (3.0 * p.x).floor()));
        let label = Label { name: "a name does not matter".to_owned(), transfer_function };
        Classification::Labels(Labels { volume, table: LabelTable { labels: [(number, label)].into() } })
    };
    let highlight = Shading::default().highlight;
    let lit = |diffuse_term, highlight| {
        change(&|scene| scene.shading = Some(Shading { diffuse_term, highlight, ..Shading::default() }))
    };
    let layered = |opacity| {
        let layers = [0.2, 0.4, 0.6].map(|value| Layer { value, color: [1.0; 3], opacity });
        change(&|scene| scene.method = Method::Isosurfaces { layers, refinement: Refinement::Linear })
    };
    let surface = |value, refinement| Method::Isosurface { value, refinement };
    let scenes = [
        scene(&volume),
        scene(&moved),
        scene(&other),
        change(&|scene| scene.size = [5, 6]),
        change(&|scene| scene.clip.max.z = 0.9),
        change(&|scene| scene.camera.near = Some(0.0)),
        change(&|scene| scene.camera.up = DVec3::Z),
        change(&|scene| scene.reference_length = 1.1),
        change(&|scene| scene.method = Method::Mean),
        change(&|scene| scene.method = surface(0.5, Refinement::None)),
        change(&|scene| scene.method = surface(0.6, Refinement::None)),
        change(&|scene| scene.classification = fainter.clone().into()),
        change(&|scene| scene.classification = by_labels([5, 4, 3], 1, fainter.clone())),
        change(&|scene| scene.classification = by_labels([5, 4, 3], 2, fainter.clone())),
        change(&|scene| scene.classification = by_labels([5, 4, 3], 1, colorful())),
        change(&|scene| scene.classification = by_labels([5, 3, 4], 1, colorful())),
        change(&|scene| scene.shading = Some(Shading::default())),
        change(&|scene| scene.shading = Some(Shading { two_sided: false, ..Shading::default() })),
        lit(Diffuse::Toon { steps: 3 }, highlight),
        lit(Diffuse::Toon { steps: 4 }, highlight),
        lit(Diffuse::OrenNayar { roughness: 0.5 }, highlight),
        lit(Diffuse::Lambert, Highlight::Phong { shininess: 32.0 }),
        lit(Diffuse::Lambert, Highlight::CookTorrance { roughness: 0.3, reflectance: 0.2 }),
        lit(Diffuse::Lambert, Highlight::Ward { along: 0.3, across: 0.2 }),
        change(&|scene| scene.method = Method::FirstHit(FirstHit::Depth)),
        change(&|scene| scene.method = Method::FirstHit(FirstHit::Point)),
        layered(0.5),
        layered(0.6),
    ];
    for reference in Reference::ALL {
        let paths: BTreeSet<_> = scenes.iter().map(|scene| cache.path(reference, scene, None)).collect();
        assert_eq!(paths.len(), scenes.len());
    }
    // What only samples know leaves the exact picture alone.
    let finer = change(&|scene| scene.step /= 2.0);
    let path = |reference, scene: &Scene<'_>| cache.path(reference, scene, None);
    assert_eq!(path(Reference::Exact, &finer), path(Reference::Exact, &scenes[0]));
    assert_ne!(path(Reference::SameSamples, &finer), path(Reference::SameSamples, &scenes[0]));
    let secant = change(&|scene| scene.method = surface(0.5, Refinement::Secant(3)));
    assert_eq!(path(Reference::Exact, &secant), path(Reference::Exact, &scenes[9]));
    assert_ne!(path(Reference::SameSamples, &secant), path(Reference::SameSamples, &scenes[9]));
}
