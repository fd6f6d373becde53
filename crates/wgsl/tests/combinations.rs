//! Every legal combination of snippets is assembled and validated without a GPU.

use std::collections::BTreeMap;
use std::thread;

use rayloom_wgsl::{Checked, Choice, Library, Skeleton, Slot, SourceChoice, assemble, legal_choices, validate};

fn validate_all(library: &Library, skeleton: &Skeleton, choices: &[Choice]) -> Vec<String> {
    let workers = thread::available_parallelism().map_or(1, |count| count.get());
    let chunk = choices.len().div_ceil(workers).max(1);
    thread::scope(|scope| {
        let parts: Vec<_> = choices
            .chunks(chunk)
            .map(|part| {
                scope.spawn(move || {
                    let check = |choice: &Choice| {
                        let checked = choice.check(library).expect("legal");
                        match assemble(library, skeleton, &checked) {
                            Ok(assembled) => validate(library, assembled).err().map(|problem| problem.to_string()),
                            Err(problems) => problems.first().map(|problem| problem.to_string()),
                        }
                    };
                    part.iter()
                        .filter_map(|choice| check(choice).map(|problem| format!("{choice:?}\n{problem}")))
                        .collect::<Vec<_>>()
                })
            })
            .collect();
        parts.into_iter().flat_map(|part| part.join().unwrap_or_else(|_| vec!["a worker panicked".into()])).collect()
    })
}

#[test]
fn every_legal_combination_is_valid() {
    let library = Library::built_in().expect("built-in snippets declare themselves well");
    let choices: Vec<_> = legal_choices(&library).into_iter().collect();
    let problems = validate_all(&library, &Skeleton::TRAVERSAL, &choices);
    println!("validated {} combinations of one output", choices.len());
    assert!(
        problems.is_empty(),
        "{} of {} combinations fail; the first:\n{}",
        problems.len(),
        choices.len(),
        problems[0]
    );
    assert!(choices.len() > 1000, "only {} combinations were found", choices.len());
}

#[test]
fn every_set_of_outputs_is_valid_with_every_switch() {
    let library = Library::built_in().expect("built-in snippets declare themselves well");
    let snippet = |slot, id: &str| (slot, library.snippet(slot, id).expect(id).clone());
    let outputs: Vec<_> = library.all(Slot::Compositing).cloned().map(Some).collect();
    let mut choices = Vec::new();
    for (index, first) in outputs.iter().enumerate() {
        for second in outputs.iter().chain([&None]) {
            let third = &outputs[(index + 1) % outputs.len()];
            for (classification, gradient, skipping) in [
                ("transfer_function", "central", "distance"),
                ("transfer_function_2d", "sobel", "none"),
                ("preintegrated_full", "precomputed", "occupancy"),
                ("voxel_color", "forward", "none"),
            ] {
                for switches in 0..5u32 {
                    let source = SourceChoice {
                        snippets: BTreeMap::from([
                            snippet(Slot::Sampling, "trilinear"),
                            snippet(Slot::Gradient, gradient),
                            snippet(Slot::Classification, classification),
                            snippet(Slot::Skipping, skipping),
                        ]),
                        channel: switches % 4,
                        channels: switches % 4 + 1,
                        gaps: switches & 2 != 0,
                        steps: switches == 1,
                    };
                    choices.push(Choice {
                        sources: vec![source],
                        snippets: BTreeMap::from([
                            snippet(Slot::Shading, if switches & 1 == 0 { "none" } else { "blinn_phong" }),
                            snippet(Slot::Refinement, "secant"),
                        ]),
                        outputs: [first.clone(), second.clone(), third.clone()],
                        early_termination: switches & 1 == 0,
                        statistics: switches & 2 == 0,
                        sample_map: switches & 1 == 0,
                        jitter: switches == 3,
                        half_targets: switches & 2 != 0,
                        long_rays: switches == 2,
                        search: switches != 2,
                    });
                }
            }
        }
    }
    let legal: Vec<_> = choices.into_iter().filter(|choice| choice.check(&library).is_ok()).collect();
    let problems = validate_all(&library, &Skeleton::TRAVERSAL, &legal);
    println!("validated {} combinations of several outputs", legal.len());
    assert!(
        problems.is_empty(),
        "{} of {} combinations fail; the first:\n{}",
        problems.len(),
        legal.len(),
        problems[0]
    );
    assert!(legal.len() > 200, "only {} combinations were found", legal.len());
}

#[test]
fn every_combination_can_be_probed() {
    let library = Library::built_in().expect("built-in snippets declare themselves well");
    let choices: Vec<_> = legal_choices(&library).into_iter().step_by(101).collect();
    assert_eq!(validate_all(&library, &Skeleton::PROBE, &choices), Vec::<String>::new());
}

/// What users see of the loop: the slots in use, and neither the probe nor anything else that was not asked for.
#[test]
fn nothing_that_was_not_asked_for_is_in_the_text() {
    let library = Library::built_in().expect("built-in snippets declare themselves well");
    for choice in legal_choices(&library).into_iter().step_by(101) {
        let checked = choice.check(&library).expect("legal");
        let text = assemble(&library, &Skeleton::TRAVERSAL, &checked).expect("legal").text;
        for absent in ["trace", "counters", "overrun", "gap_map", "sample_map:", "v2_", "SRC_", "OUT_"] {
            assert!(!text.contains(absent), "{absent}\n{text}");
        }
    }
}

#[test]
fn every_shader_without_slots_is_valid() {
    let library = Library::built_in().expect("built-in snippets declare themselves well");
    let mut shaders = Vec::new();
    for folder in ["image", "entry_exit"] {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shaders").join(folder);
        let files = std::fs::read_dir(path).expect("the folder").flatten();
        shaders.extend(files.map(|file| format!("{folder}/{}", file.file_name().to_string_lossy())));
    }
    assert!(shaders.len() > 8, "{shaders:?}");
    for path in shaders {
        let skeleton = Skeleton::plain(path.clone().leak());
        for flags in [&[][..], &["half_targets"]] {
            let assembled = assemble(&library, &skeleton, &Checked::plain(flags)).expect(&path);
            validate(&library, assembled).expect(&path);
        }
    }
}
