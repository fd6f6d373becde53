//! A measurement with its files.

use std::fs;

use rayloom_measure::{MOST_SETTINGS, MeasureError, Measurements, Plan, Standard, measure, silent, write_all};
use rayloom_network::{Address, Network};
use rayloom_reference::Cache;
use serde_json::{Value as Json, json};

use crate::network::{gpu, network};

fn plan(vary: &[&str], ladders: &[&str]) -> Plan {
    Plan {
        origin: "shells.json".into(),
        port: None,
        vary: vary.iter().map(|text| text.parse().expect("well formed")).collect(),
        ladders: ladders.iter().map(|name| (*name).to_owned()).collect(),
        views: 2,
        rounds: 2,
        size: [24, 20],
        standard: None,
        budget: false,
    }
}

fn measured(network: &Network, plan: &Plan) -> Result<Measurements, MeasureError> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    measure(network, plan, gpu(), &Cache::new(folder.path()), &silent)
}

/// Number of fields of a CSV line: names of settings hold commas, and stand in quotes then.
fn fields(line: &str) -> usize {
    let outside = |(quoted, count): (bool, usize), c: char| match c {
        '"' => (!quoted, count),
        ',' if !quoted => (quoted, count + 1),
        _ => (quoted, count),
    };
    line.chars().fold((false, 1), outside).1
}

#[test]
fn combinations_are_measured_and_written() {
    let plan =
        Plan { budget: true, ..plan(&["traversal.sampling_rate=0.5,4", "traversal.compositing=dvr,no_such"], &[]) };
    let found = measured(&network(&[]), &plan).expect("measurements");
    let names: Vec<&str> = found.settings.iter().map(|one| one.setting.name.as_str()).collect();
    assert_eq!(names, ["as saved", "sampling_rate 0.5, compositing dvr", "sampling_rate 4, compositing dvr"]);
    assert_eq!(found.refused.len(), 2);
    assert!(found.refused[0].reason.contains("no_such"), "{}", found.refused[0].reason);
    let [saved, coarse, fine] = &found.settings[..] else { panic!("three settings") };
    assert!(fine.all.errors.rmse < saved.all.errors.rmse && saved.all.errors.rmse < coarse.all.errors.rmse);
    assert!(fine.all.counts.samples > 3 * saved.all.counts.samples && saved.all.counts.rays == fine.all.counts.rays);
    let (seen, better) = (coarse.all.displayed, fine.all.displayed);
    assert!(better.psnr > seen.psnr + 10.0 && better.ssim > seen.ssim, "{seen:?} {better:?}");
    assert!(better.ciede2000 < seen.ciede2000 && better.flip < seen.flip && seen.flip < 1.0, "{seen:?} {better:?}");
    let of_views: u64 = fine.views.iter().map(|view| view.counts.samples).sum();
    assert_eq!((fine.views.len(), of_views), (2, fine.all.counts.samples));
    assert!(!found.settings.iter().any(|one| one.departs || one.all.surface.is_some()));
    assert_eq!((found.reference, found.views.len(), found.front_samples.len()), ("exact", 2, 3));
    let budget = found.budget.as_ref().expect("a budget");
    let change = |cause| budget.rows.iter().find(|row| row.cause == cause).and_then(|row| row.change);
    let quadrature = change("quadrature along the ray").expect("a change").rmse;
    let round_off = change("round-off and tables").expect("a change").rmse;
    assert!(round_off < 0.1 * quadrature, "{round_off} {quadrature}");

    let folder = tempfile::tempdir().expect("a temporary folder");
    let output = folder.path().join("new/folder");
    let files = write_all(&output, &found).expect("files");
    let text = |name: &str| fs::read_to_string(output.join(name)).expect("a file");
    assert_eq!(files.len(), 4);
    let csv = text("measurements.csv");
    let lines: Vec<&str> = csv.lines().collect();
    assert!(lines[0].starts_with("setting,traversal.compositing,traversal.sampling_rate,time_ms,"), "{}", lines[0]);
    assert_eq!(fields(lines[0]), fields(lines[1]));
    assert!(lines[2].starts_with("\"sampling_rate 0.5, compositing dvr\",dvr,0.5,"), "{}", lines[2]);
    assert!(!csv.contains("distance_") && csv.contains(",flip_mean,on_front_time,"), "{}", lines[0]);
    let views = text("views.csv");
    let views: Vec<&str> = views.lines().collect();
    assert_eq!((views.len(), fields(views[0]), fields(views[1])), (1 + 3 * 2, fields(lines[0]) - 5, fields(views[0])));
    assert!(views[2].starts_with("as saved,,,2,"), "{}", views[2]);
    let json: Json = serde_json::from_str(&text("measurements.json")).expect("JSON");
    assert_eq!(json["settings"][2]["setting"]["set"]["traversal.sampling_rate"], json!(4));
    assert!(json["settings"][0]["errors"]["rmse"].as_f64().is_some_and(|rmse| rmse > 0.0));
    let page = text("report.html");
    assert!(!page.contains("Where rays meet the surface"));
    for part in [
        "Shells",
        "<svg",
        "As a display shows it",
        "<details>",
        "data:image/png;base64,",
        "What the error is made of",
        "no_such",
        "Choose \u{201c}",
    ] {
        assert!(page.contains(part), "{part}");
    }
    assert!(!page.contains("http"), "the page asks for something from elsewhere");
}

#[test]
fn ladders_leave_out_the_own_setting_and_tell_departures_from_prices() {
    let found = measured(&network(&[]), &plan(&[], &["sampling", "volume"])).expect("measurements");
    let named = |name: &str| found.settings.iter().find(|one| one.setting.name == name);
    assert!(named("sampling filtered").is_none() && named("volume auto").is_none());
    let departs = |name: &str| named(name).map(|one| one.departs);
    assert_eq!(departs("sampling nearest"), Some(true));
    assert_eq!([departs("sampling trilinear"), departs("volume 8-bit")], [Some(false); 2]);
    let departing = |i: &usize| found.settings[*i].departs;
    assert!(!found.front_time.iter().any(departing) && !found.dominated.keys().any(departing));
}

#[test]
fn precomputed_gradients_are_a_knob_where_there_are_any() {
    let mut precomputed = network(&[
        ("traversal.shading", json!("diffuse")),
        ("traversal.gradient", json!("precomputed")),
        // So fine that storage shows.
        ("traversal.sampling_rate", json!(16)),
    ]);
    let [values, volume] =
        ["source.volume", "traversal.volume"].map(|port| port.parse::<Address>().expect("an address"));
    precomputed.disconnect(values.clone(), volume.clone());
    precomputed.add("gradient_volume", "gradients").expect("a processor");
    precomputed.connect(values, Address::new("gradients", "volume")).expect("a connection");
    precomputed.connect(Address::new("gradients", "gradients"), volume).expect("a connection");
    let plan = Plan { budget: true, ..plan(&[], &["gradients"]) };
    let found = measured(&precomputed, &plan).expect("measurements");
    let names: Vec<&str> = found.settings.iter().map(|one| one.setting.name.as_str()).collect();
    assert_eq!((found.reference, &names[..]), ("exact", &["as saved", "gradients 16-bit", "gradients 8-bit"][..]));
    let [saved, half, byte] = [0, 1, 2].map(|index| found.settings[index].all.errors.rmse);
    assert!(saved < half && half < 1.5 * saved && byte > 4.0 * half, "{saved} {half} {byte}");
    assert!(found.budget.expect("a budget").rows.iter().any(|row| row.cause == "storage of the gradients"));
    let none = measured(&network(&[]), &plan).expect("measurements");
    assert_eq!(none.settings.len(), 1);
}

#[test]
fn networks_that_the_reference_cannot_draw_are_compared_with_the_finest() {
    let mida = network(&[("traversal.compositing", json!("mida"))]);
    let found = measured(&mida, &plan(&["traversal.sampling_rate=2,8"], &[])).expect("measurements");
    assert_eq!(found.reference, "finest");
    assert!(
        found.reference_note.contains("the compositing `mida` has no counterpart there"),
        "{}",
        found.reference_note
    );
    assert!(found.settings[2].all.errors.rmse < found.settings[1].all.errors.rmse);
    let exact = Plan { standard: Some(Standard::Exact), ..plan(&["traversal.sampling_rate=2"], &[]) };
    assert!(matches!(measured(&mida, &exact), Err(MeasureError::Refusal(_))));
}

#[test]
fn jitter_and_rays_a_pixel_are_knobs() {
    let jittered = network(&[("traversal.jitter", json!(true))]);
    let plan = Plan { budget: true, ..plan(&[], &["jitter", "pixel_rate"]) };
    let found = measured(&jittered, &plan).expect("measurements");
    let named = |name: &str| found.settings.iter().find(|one| one.setting.name == name).expect(name);
    assert_eq!(found.settings.len(), 1 + 1 + 3);
    let samples = |name: &str| named(name).all.counts.samples as f64 / named("as saved").all.counts.samples as f64;
    assert!((samples("pixel rate 2") - 4.0).abs() < 0.5 && (samples("pixel rate 0.5") - 0.25).abs() < 0.05);
    assert_eq!(["pixel rate 0.5", "pixel rate 2"].map(|name| named(name).departs), [false, true]);
    let flip = |name: &str| named(name).all.displayed.flip;
    assert!(flip("pixel rate 0.25") > flip("pixel rate 0.5") && flip("pixel rate 0.5") > flip("as saved"));
    let budget = found.budget.as_ref().expect("a budget");
    let row = budget.rows.iter().find(|row| row.cause == "jitter").expect("a row");
    assert_eq!(row.switch, "jitter true \u{2192} false");
    assert!(row.change.is_some_and(|change| change.rmse > 0.0));
    // Switched off it is the very setting of the ladder.
    assert_eq!(row.left.as_ref(), Some(&named("jitter false").all.errors));
}

/// A round isosurface that the exact reference knows, lit or not.
fn isosurface(shading: &str) -> Network {
    network(&[
        ("source.field", json!("gaussian_blob")),
        ("traversal.compositing", json!("isosurface")),
        ("traversal.compositing.isovalue", json!(0.02)),
        ("traversal.shading", json!(shading)),
    ])
}

#[test]
fn surfaces_are_compared_where_rays_meet_them() {
    let vary = ["traversal.refinement=none,secant", "traversal.gradient=central,filtered"];
    let found = measured(&isosurface("diffuse"), &plan(&vary, &[])).expect("measurements");
    assert_eq!(found.reference, "exact");
    let surface = |index: usize| found.settings[index].all.surface.expect("a surface");
    let [coarse, fine, other] = [1, 3, 4].map(surface);
    let normal = |of: rayloom_measure::SurfaceErrors| of.normal.expect("normals").rmse;
    assert!(fine.common > 100 && fine.distance.p99 < 0.02, "{fine:?}");
    assert!(coarse.distance.rmse > 0.1 && coarse.distance.max < 1.5, "{coarse:?}");
    assert!(normal(fine) < 0.5 && normal(coarse) > 10.0 * normal(fine), "{coarse:?} {fine:?}");
    // Another estimate of the gradient moves the normals and nothing else.
    assert!(normal(other) > 10.0 * normal(fine) && other.distance == fine.distance, "{other:?} {fine:?}");
    assert!(fine.silhouette() < fine.common / 20, "{fine:?}");

    let folder = tempfile::tempdir().expect("a temporary folder");
    write_all(folder.path(), &found).expect("files");
    let text = |name: &str| fs::read_to_string(folder.path().join(name)).expect("a file");
    assert!(
        text("measurements.csv").contains(",distance_rmse_voxels,")
            && text("views.csv").contains(",normal_p99_degrees,")
    );
    assert!(text("report.html").contains("Where rays meet the surface"));
    assert!(found.advice.contains("Its surface is off by "), "{}", found.advice);

    // Where nothing is lit there are no normals to be wrong.
    let unlit = measured(&isosurface("none"), &plan(&["traversal.refinement=none"], &[])).expect("measurements");
    let of = |index: usize| unlit.settings[index].all.surface.expect("a surface");
    assert!(of(0).normal.is_none() && of(0).distance.rmse < 0.02 * of(1).distance.rmse, "{:?}", of(0));
}

#[test]
fn first_hits_are_compared_as_surfaces() {
    // The exact picture knows no filtered differences.
    for (gradient, reference) in [("central", "exact"), ("filtered", "finest")] {
        let set = [("traversal.compositing", json!("first_hit_normal")), ("traversal.gradient", json!(gradient))];
        let found = measured(&network(&set), &plan(&["traversal.sampling_rate=0.5,8"], &[])).expect("measurements");
        assert_eq!(found.reference, reference);
        let [coarse, fine] = [1, 2].map(|index| found.settings[index].all.surface.expect("a surface"));
        let normal = |of: rayloom_measure::SurfaceErrors| of.normal.expect("normals").rmse;
        assert!(coarse.distance.rmse > 4.0 * fine.distance.rmse && fine.distance.rmse > 0.0, "{coarse:?} {fine:?}");
        assert!(normal(coarse) > normal(fine) && coarse.missing > 0, "{coarse:?} {fine:?}");
    }
}

#[test]
fn senseless_plans_are_refused() {
    let message = |plan: &Plan| measured(&network(&[]), plan).map(|_| ()).expect_err("a refusal").to_string();
    let many = (0..MOST_SETTINGS + 1).map(|i| i.to_string()).collect::<Vec<_>>().join(",");
    let many = message(&plan(&[&format!("traversal.max_samples={many}")], &[]));
    assert!(many.contains("257 settings") && many.contains("at most 256"), "{many}");
    assert!(message(&plan(&[], &["steps"])).contains("no ladder `steps`: choose all or one of quality, rate,"));
    let port = Plan { port: Some("view.entry".parse().expect("an address")), ..plan(&[], &[]) };
    assert!(message(&port).contains("choose one with --port traversal.image"));
}
