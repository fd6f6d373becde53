//! Every legal combination of snippets is assembled and validated without a GPU.

use std::collections::BTreeMap;
use std::thread;

use rayloom_wgsl::{Choice, Library, Slot, assemble, legal_choices, validate};

fn validate_all(library: &Library, choices: &[Choice]) -> Vec<String> {
    let workers = thread::available_parallelism().map_or(1, |count| count.get());
    let chunk = choices.len().div_ceil(workers).max(1);
    thread::scope(|scope| {
        let parts: Vec<_> = choices
            .chunks(chunk)
            .map(|part| {
                scope.spawn(move || {
                    let check = |choice: &Choice| match assemble(library, choice) {
                        Ok(assembled) => validate(library, assembled).err().map(|problem| problem.to_string()),
                        Err(problems) => problems.first().map(|problem| problem.to_string()),
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
    let problems = validate_all(&library, &choices);
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
    let path = |slot, id: &str| library.path(slot, id).expect(id);
    let outputs: Vec<_> = library.snippets(Slot::Compositing).map(|(path, _)| Some(path.clone())).collect();
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
                    choices.push(Choice {
                        snippets: BTreeMap::from([
                            (Slot::Sampling, path(Slot::Sampling, "trilinear")),
                            (Slot::Gradient, path(Slot::Gradient, gradient)),
                            (Slot::Classification, path(Slot::Classification, classification)),
                            (
                                Slot::Shading,
                                path(Slot::Shading, if switches & 1 == 0 { "none" } else { "blinn_phong" }),
                            ),
                            (Slot::Refinement, path(Slot::Refinement, "secant")),
                            (Slot::Skipping, path(Slot::Skipping, skipping)),
                        ]),
                        outputs: [first.clone(), second.clone(), third.clone()],
                        early_termination: switches & 1 == 0,
                        statistics: switches & 2 == 0,
                        sample_map: switches & 1 == 0,
                        jitter: switches == 3,
                        trace: switches == 4,
                        half_targets: switches & 2 != 0,
                        gaps: switches & 2 != 0,
                        long_rays: switches == 2,
                        search: switches != 2,
                        steps: switches == 1,
                        channel: switches % 4,
                        channels: switches % 4 + 1,
                    });
                }
            }
        }
    }
    let legal: Vec<_> = choices.into_iter().filter(|choice| choice.check(&library).is_ok()).collect();
    let problems = validate_all(&library, &legal);
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
fn the_ray_probe_leaves_no_trace_in_other_shaders() {
    let library = Library::built_in().expect("built-in snippets declare themselves well");
    let choices: Vec<_> = legal_choices(&library).into_iter().step_by(101).collect();
    let traced: Vec<_> = choices.iter().map(|choice| Choice { trace: true, ..choice.clone() }).collect();
    assert_eq!(validate_all(&library, &traced), Vec::<String>::new());
    for choice in choices {
        let text = assemble(&library, &choice).expect("legal").text;
        assert!(!text.contains("trace"), "{text}");
        let traced = assemble(&library, &Choice { trace: true, ..choice }).expect("legal").text;
        // The probe adds lines and takes away none but the head of the entry point and what writes the picture.
        let mut kept = traced.lines();
        let mut found = |line: &&str| {
            let mut rest = kept.clone();
            let found = rest.any(|other| other == *line);
            if found {
                kept = rest;
            }
            found
        };
        let lost: Vec<_> = text.lines().filter(|line| !found(line)).collect();
        let expected = [
            "@compute @workgroup_size(8, 8)",
            "fn traverse(",
            "    let id = ",
            "    textureStore(",
            "    textureStore(",
        ];
        assert_eq!(lost.len(), expected.len(), "{lost:#?}");
        assert!(lost.iter().zip(expected).all(|(line, start)| line.starts_with(start)), "{lost:#?}");
    }
}
