//! Random damage to files of every kind that the program reads: none may end in a panic, a crash or a hang.
//!
//! As a test each target gets a few hundred inputs, always the same. `cargo xtask fuzz` gives them minutes and others every time.
//! Every input is written down before it is tried (the last one of a target that crashed is where the message says).

mod damage;

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use damage::Random;
use rayloom_network::{Network, Value};
use rayloom_tests::{root, types};
use rayloom_volume::ValueRange;
use rayloom_wgsl::{Choice, Library, Skeleton, Slot, Snippet, assemble, validate};

/// Inputs of each target where no time is given.
const FEW: usize = 300;

/// Seconds for each target, and the number from which all random choices follow.
const SECONDS: &str = "RAYLOOM_FUZZ_SECONDS";
const SEED: &str = "RAYLOOM_FUZZ_SEED";

/// A file to start from.
struct Seed {
    name: String,
    bytes: Vec<u8>,
}

/// All files of a folder of the project, in the order of their names.
fn corpus(folder: &str) -> Vec<Seed> {
    let entries = std::fs::read_dir(root().join(folder)).expect("the folder of the corpus");
    let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).filter(|path| path.is_file()).collect();
    files.sort();
    let seed = |path: &PathBuf| Seed {
        name: path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default(),
        bytes: std::fs::read(path).expect("a file of the corpus"),
    };
    files.iter().map(seed).collect()
}

fn environment(name: &str) -> Option<u64> {
    let text = std::env::var(name).ok()?;
    Some(text.parse().unwrap_or_else(|_| panic!("{name} is no number: {text}")))
}

/// Tries all seeds as they are, then damaged ones until the time is over.
fn fuzz(target: &str, seeds: &[Seed], mut attempt: impl FnMut(&str, &[u8], &mut Random)) {
    let seconds = environment(SECONDS);
    let mut random = Random::new(environment(SEED).unwrap_or(1));
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fuzz");
    std::fs::create_dir_all(&folder).expect("a folder for inputs");
    let start = Instant::now();
    let (mut count, mut slowest) = (0, (Duration::ZERO, String::new()));
    loop {
        let seed = match seeds.get(count) {
            Some(seed) => seed,
            None => &seeds[random.below(seeds.len())],
        };
        let other = &seeds[random.below(seeds.len())];
        let bytes = if count < seeds.len() { seed.bytes.clone() } else { random.damaged(&seed.bytes, &other.bytes) };
        let file = folder.join(format!("{target}-last-{}", seed.name));
        std::fs::write(&file, &bytes).expect("the input is written down");
        let before = Instant::now();
        let result = catch_unwind(AssertUnwindSafe(|| attempt(&seed.name, &bytes, &mut random)));
        assert!(result.is_ok(), "{target}: input {count} fails; it is kept as {}", file.display());
        if before.elapsed() > slowest.0 {
            slowest = (before.elapsed(), seed.name.clone());
        }
        count += 1;
        let over = match seconds {
            Some(seconds) => start.elapsed() >= Duration::from_secs(seconds),
            None => count >= FEW,
        };
        if over && count >= seeds.len() {
            break;
        }
    }
    println!("{target}: {count} inputs in {:.0?}; the slowest took {:.2?} ({})", start.elapsed(), slowest.0, slowest.1);
}

#[test]
fn volumes() {
    let seeds = corpus("tests/corpus/volumes");
    let folder = tempfile::tempdir().expect("a folder");
    let intact = |folder: &Path| seeds.iter().for_each(|seed| put(folder, seed));
    intact(folder.path());
    let mut read = 0;
    fuzz("volumes", &seeds, |name, bytes, _| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).expect("written");
        read += usize::from(rayloom_volume::read(&path, &mut |_| {}).is_ok());
        // Headers of other files may name this one.
        intact(folder.path());
    });
    assert!(read >= 8, "only {read} files were read at all");
}

fn put(folder: &Path, seed: &Seed) {
    std::fs::write(folder.join(&seed.name), &seed.bytes).expect("written");
}

/// What loads is saved, and loads to the same.
#[test]
fn networks() {
    let folder = root().join("networks");
    let mut loaded = 0;
    fuzz("networks", &corpus("networks"), |name, bytes, _| {
        let (text, file) = (String::from_utf8_lossy(bytes), folder.join(name));
        let Ok(network) = Network::from_text(&text, &file, &types()) else { return };
        loaded += 1;
        let saved = network.network.to_text(Some(&folder));
        let again = Network::from_text(&saved, &file, &types()).unwrap_or_else(|error| panic!("{error}\n{saved}"));
        assert_eq!(again.network.to_text(Some(&folder)), saved);
    });
    assert!(loaded >= 20, "only {loaded} networks were loaded at all");
}

/// Functions that are taken give finite tables.
#[test]
fn transfer_functions() {
    let file = root().join("networks/brain.json");
    let mut network = Network::load(&file, &types()).expect("a network of the project").network;
    let properties = ["transfer_function", "transfer_function_2d", "label_table"];
    let mut taken = 0;
    fuzz("transfer_functions", &corpus("tests/corpus/transfer_functions"), |_, bytes, _| {
        let Ok(json) = serde_json::from_slice(bytes) else { return };
        for property in properties {
            taken += usize::from(network.set_from_json("traversal", property, &json).is_ok());
        }
        let Some(Value::TransferFunction(function)) = network.value("traversal", "transfer_function") else { return };
        let table = function.table(ValueRange::new(-10.0, 300.0), 64);
        assert!(table.iter().flatten().all(|number| number.is_finite()), "{table:?}");
    });
    assert!(taken >= 3, "only {taken} functions were taken at all");
}

/// Edited snippets among random others: refused with a place, or assembled to a valid shader.
#[test]
fn snippets() {
    let library = Library::built_in().expect("built-in snippets");
    let all: Vec<&Snippet> = Slot::ALL.into_iter().flat_map(|slot| library.all(slot)).collect();
    let seed =
        |snippet: &&Snippet| Seed { name: snippet.path().replace('/', "_"), bytes: snippet.text().as_bytes().to_vec() };
    let seeds: Vec<Seed> = all.iter().map(seed).collect();
    let mut valid = 0;
    fuzz("snippets", &seeds, |name, bytes, random| {
        let slot = Slot::ALL.into_iter().find(|slot| name.starts_with(slot.id())).expect("named after its slot");
        let Ok(edited) = Snippet::edited(slot.id(), slot, &String::from_utf8_lossy(bytes)) else { return };
        let mut any = |slot| {
            let snippets: Vec<_> = library.all(slot).collect();
            snippets[random.below(snippets.len())].clone()
        };
        let mut chosen: BTreeMap<_, _> = Slot::ALL.into_iter().map(|slot| (slot, any(slot))).collect();
        chosen.insert(slot, edited);
        let output = chosen.remove(&Slot::Compositing);
        let Ok(checked) = Choice::of(chosen, [output, None, None]).check(&library) else { return };
        if let Ok(assembled) = assemble(&library, &Skeleton::TRAVERSAL, &checked) {
            valid += usize::from(validate(&library, assembled).is_ok());
        }
    });
    assert!(valid >= 5, "only {valid} shaders were valid at all");
}
