//! The study of convergence, as far as it is quick.

use rayloom_measure::silent;
use rayloom_measure::verify::{Axis, Extent, study};

use crate::network::gpu;

#[test]
fn every_method_has_its_order() {
    let found = study(&gpu(), Extent::Quick, &silent).expect("a study");
    for case in &found.cases {
        let errors: Vec<String> = case.errors.iter().map(|(n, error)| format!("{n}: {error:.2e}")).collect();
        println!("{:?} | {} | {:.3} for {} | {}", case.axis, case.name, case.order, case.expected, errors.join(", "));
    }
    let failed: Vec<&str> = found.cases.iter().filter(|case| !case.passed()).map(|case| case.name.as_str()).collect();
    assert!(failed.is_empty(), "{failed:?}");
    assert!(Axis::ALL.iter().all(|axis| found.cases.iter().any(|case| case.axis == *axis)));
    let folder = tempfile::tempdir().expect("a temporary folder");
    let files = found.write(folder.path()).expect("written files");
    let page = std::fs::read_to_string(&files[0]).expect("a page");
    assert_eq!(page.matches("<svg").count(), 4);
    assert!(files.iter().all(|file| file.is_file()) && files.len() == 6 && !page.contains("NaN"));
}
