//! What a person who edits a snippet is told: complete texts, with file, line and column of the snippet.

use std::collections::BTreeMap;

use proptest::prelude::*;
use rayloom_wgsl::{Assembled, Choice, Diagnostic, Library, Skeleton, Slot, Snippet, validate};

/// The traversal of a legal choice.
fn assemble(library: &Library, choice: &Choice) -> Result<Assembled, Vec<Diagnostic>> {
    rayloom_wgsl::assemble(library, &Skeleton::TRAVERSAL, &choice.check(library).expect("legal"))
}

/// A choice of built-in snippets.
fn choice(library: &Library, slots: &[(Slot, &str)], output: &str) -> Choice {
    let snippet = |slot, id: &str| library.snippet(slot, id).unwrap_or_else(|| panic!("{slot} {id}")).clone();
    let defaults = [
        (Slot::Sampling, "filtered"),
        (Slot::Gradient, "central"),
        (Slot::Classification, "transfer_function"),
        (Slot::Shading, "blinn_phong"),
        (Slot::Refinement, "linear"),
        (Slot::Skipping, "none"),
    ];
    let mut snippets: BTreeMap<_, _> = defaults.into_iter().map(|(slot, id)| (slot, snippet(slot, id))).collect();
    snippets.extend(slots.iter().map(|&(slot, id)| (slot, snippet(slot, id))));
    Choice { early_termination: true, ..Choice::of(snippets, [Some(snippet(Slot::Compositing, output)), None, None]) }
}

/// The text of a built-in snippet.
fn text(library: &Library, path: &str) -> String {
    library.source(path).map(|source| source.text.to_string()).unwrap_or_else(|| panic!("{path}"))
}

/// Uses `text` as this processor's own snippet and returns what is wrong with it.
fn problem(slot: Slot, text: &str) -> Option<String> {
    let library = Library::built_in().expect("built-in snippets");
    let edited = match Snippet::edited(slot.id(), slot, text) {
        Ok(edited) => edited,
        Err(problem) => return Some(problem.to_string()),
    };
    let mut choice = choice(&library, &[], "dvr");
    if slot == Slot::Compositing {
        choice.outputs[0] = Some(edited);
    } else {
        choice.put(edited);
    }
    if let Err(problems) = choice.check(&library) {
        return Some(problems.iter().map(|problem| format!("shader: {problem}")).collect::<Vec<_>>().join("\n"));
    }
    match assemble(&library, &choice) {
        Ok(assembled) => validate(&library, assembled).err().map(|problem| problem.to_string()),
        Err(problems) => Some(problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")),
    }
}

/// Edits a built-in snippet and returns what is wrong with the result.
fn edited(path: &str, from: &str, to: &str) -> String {
    let library = Library::built_in().expect("built-in snippets");
    let original = text(&library, path);
    assert!(original.contains(from), "{path} does not contain `{from}`");
    let slot = library.declaration(path).expect("a snippet").slot;
    problem(slot, &original.replacen(from, to, 1)).expect("must be refused")
}

#[test]
fn mistakes_are_shown_where_they_are() {
    insta::assert_snapshot!(edited("compositing/dvr.wgsl", "let color = (*state).color;", "let color = (*state).color"), @r#"
    edited/compositing.wgsl:32:5: expected `;`, found "("
      32 |     (*state).color = color + (1.0 - color.w) * absorb(s.medium, s.length);
         |     ^
    "#);
    insta::assert_snapshot!(edited("shading/blinn_phong.wgsl", "params.diffuse * lambert", "params.diffuse * lamberd"), @r"
    edited/shading.wgsl:15:53: no definition in scope for identifier: `lamberd` (unknown identifier)
      15 |     let diffuse = params.ambient + params.diffuse * lamberd * surface.light_color;
         |                                                     ^
    ");
    insta::assert_snapshot!(edited("gradient/central.wgsl", "slopes(p, 1.0, 1.0);", "slopes(p, 1.0, 1.0) * vec2f(0.5);"), @r"
    edited/gradient.wgsl:8:12: Function [16] 'gradient_at' is invalid: Expression [7] is invalid: Operation Multiply can't work with [4] (of type Vector { size: Tri, scalar: Scalar { kind: Float, width: 4 } }) and [6] (of type Vector { size: Bi, scalar: Scalar { kind: Float, width: 4 } })
      8 |     return slopes(p, 1.0, 1.0) * vec2f(0.5);
        |            ^
    ");
    insta::assert_snapshot!(edited("classification/transfer_function.wgsl", "s.value);", "s.value).x;"), @r"
    edited/classification.wgsl:10:12: Function [23] 'classify' is invalid: The `return` expression Some([3]) does not match the declared return type Some([0])
      10 |     return transfer_lookup(s.value).x;
         |            ^
    ");
    insta::assert_snapshot!(edited("shading/blinn_phong.wgsl", "params.shininess)", "params.shinyness)"), @r"
    edited/shading.wgsl:14:53: no parameter `shinyness` is declared; add a line such as `//! param shinyness: f32 = 1 [0, 2] -- what it does`
      14 |     let highlight = blinn_highlight(surface, params.shinyness);
         |                                                     ^
    ");
}

#[test]
fn a_broken_contract_is_told_at_the_snippet() {
    insta::assert_snapshot!(edited("gradient/central.wgsl", "fn gradient_at(", "fn gradient("), @r"
    edited/gradient.wgsl:1:1: a gradient snippet must define `fn gradient_at(p: vec3f, voxel: vec4f) -> vec3f`
      1 | //! slot: gradient
        | ^
    ");
    insta::assert_snapshot!(edited("gradient/central.wgsl", "voxel: vec4f", "voxel: vec3f"), @r"
    edited/gradient.wgsl:7:1: the contract of slot gradient is `fn gradient_at(p: vec3f, voxel: vec4f) -> vec3f`
      7 | fn gradient_at(p: vec3f, voxel: vec3f) -> vec3f {
        | ^
    ");
    insta::assert_snapshot!(edited("compositing/mip.wgsl", "struct State", "struct Memory"), @r"
    edited/compositing.wgsl:1:1: a compositing snippet must define `struct State`
      1 | //! slot: compositing
        | ^
    ");
    insta::assert_snapshot!(edited("gradient/central.wgsl", "#include \"gradient/slope.wgsl\"", "#include \"gradient/slop.wgsl\""), @"edited/gradient.wgsl:5: the file `gradient/slop.wgsl` to include does not exist");
    insta::assert_snapshot!(edited("gradient/central.wgsl", "#include \"gradient/slope.wgsl\"", "#if previous"), @"edited/gradient.wgsl:5: #if without #endif");
    insta::assert_snapshot!(edited("shading/toon.wgsl", "//! slot: shading", "//! slot: gradient"), @r"
    edited/shading.wgsl:1: the text declares slot `gradient`, but it is used as `shading`
      1 | //! slot: gradient
    ");
}

#[test]
fn combinations_that_make_no_sense_are_refused_with_the_reason() {
    let library = Library::built_in().expect("built-in snippets");
    let refusal = |slots: &[(Slot, &str)], output| {
        let problems = choice(&library, slots, output).check(&library).expect_err("must be refused");
        problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
    };
    insta::assert_snapshot!(refusal(&[(Slot::Gradient, "none")], "dvr"), @"shading `blinn_phong` reads the gradient, but the gradient slot is empty: choose a gradient operator, for example `central`.");
    insta::assert_snapshot!(refusal(&[(Slot::Classification, "preintegrated_full")], "mip"), @"compositing `mip` cannot be combined with classification `preintegrated_full`, because a maximum is a point, not a segment.");
    insta::assert_snapshot!(refusal(&[(Slot::Skipping, "distance")], "mip"), @"skipping `distance` cannot be combined with compositing `mip`, which needs every sample of the ray: choose skipping `none`.");
    insta::assert_snapshot!(refusal(&[(Slot::Classification, "labels"), (Slot::Skipping, "occupancy")], "dvr"), @"skipping `occupancy` cannot know what is empty with this classification, in which any value may be visible: choose skipping `none`.");
    insta::assert_snapshot!(refusal(&[(Slot::Classification, "labels")], "mean"), @"compositing `mean` cannot be combined with classification `labels`, because a mean of values has no place and so no label.");
    insta::assert_snapshot!(refusal(&[(Slot::Sampling, "bspline"), (Slot::Gradient, "precomputed")], "dvr"), @"sampling `bspline` cannot be combined with gradient `precomputed`, because the coefficients hold one channel and no gradient.");
}

#[test]
fn two_snippets_may_use_the_same_names() {
    let library = Library::built_in().expect("built-in snippets");
    let helper = "fn soft(x: f32) -> f32 { return x; }\n";
    let shading = text(&library, "shading/diffuse.wgsl")
        .replace("max(dot(surface.normal, surface.light), 0.0)", "soft(dot(surface.normal, surface.light))");
    assert_eq!(problem(Slot::Shading, &(shading + helper)), None);
    let mut choice = choice(&library, &[], "mip");
    choice.outputs = [choice.outputs[0].clone(), choice.outputs[0].clone(), choice.outputs[0].clone()];
    let assembled = assemble(&library, &choice).expect("three outputs of one kind");
    assert!(validate(&library, assembled).is_ok());
}

#[test]
fn shading_may_do_without_the_gradient() {
    let flat = "//! slot: shading\n//! help: Half as bright.\nfn shade(medium: vec4f, surface: Surface) -> vec4f { return vec4f(0.5 * medium.rgb, medium.w); }\n";
    assert_eq!(problem(Slot::Shading, flat), None);
}

#[test]
fn only_what_is_read_is_emitted() {
    let library = Library::built_in().expect("built-in snippets");
    let lines = |choice: &Choice| {
        let assembled = assemble(&library, choice).expect("legal");
        let text = assembled.text.clone();
        assert_eq!(text.lines().count(), assembled.map.lines().len());
        validate(&library, assembled).expect("valid");
        text
    };
    let unshaded = lines(&choice(&library, &[(Slot::Shading, "none")], "dvr"));
    for absent in ["fn gradient_at", "fn shade", "fn refine", "skip_map", "preintegrated_table", "label_table", "out2_"]
    {
        assert!(!unshaded.contains(absent), "{absent}");
    }
    assert!(lines(&choice(&library, &[], "dvr")).contains("fn gradient_at"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Snippets that lost or gained characters: an error with a place or a valid shader, never a panic or a hang.
    #[test]
    fn damaged_snippets_never_panic(which in any::<prop::sample::Index>(), at in any::<prop::sample::Index>(), cut in 0usize..40, junk in "[ -~\n]{0,12}") {
        let library = Library::built_in().expect("built-in snippets");
        let paths: Vec<_> = Slot::ALL.into_iter().flat_map(|slot| library.snippets(slot).map(|(path, _)| path.clone())).collect();
        let path = &paths[which.index(paths.len())];
        let slot = library.declaration(path).expect("a snippet").slot;
        let original: Vec<char> = text(&library, path).chars().collect();
        let start = at.index(original.len());
        let end = (start + cut).min(original.len());
        let damaged: String = original[..start].iter().copied().chain(junk.chars()).chain(original[end..].iter().copied()).collect();
        if let Some(message) = problem(slot, &damaged) {
            prop_assert!(message.contains(".wgsl") || message.contains("<generated") || message.starts_with("shader: "), "{message}");
        }
    }
}

/// A shading snippet with these lines before and in its function.
fn shading_with(module: &str, body: &str) -> Option<String> {
    let text = format!(
        "//! slot: shading\n//! help: A test.\n{module}\nfn shade(medium: vec4f, surface: Surface) -> vec4f {{\n{body}\n    return medium;\n}}\n"
    );
    problem(Slot::Shading, &text)
}

#[test]
fn what_reaches_beyond_a_slot_is_refused_where_it_stands() {
    for (module, body, place, message) in [
        (
            "@compute @workgroup_size(1) fn main() {}",
            "",
            "3:1",
            "`@compute` is up to the skeleton: a snippet has no entry points and no bindings",
        ),
        (
            "@group(0) @binding(40) var<uniform> mine: vec4f;",
            "",
            "3:1",
            "`@group` is up to the skeleton: a snippet has no entry points and no bindings",
        ),
        ("override size: u32 = 1;", "", "3:1", "`override` would change the whole shader, which is up to the skeleton"),
        ("enable f16;", "", "3:1", "`enable` would change the whole shader, which is up to the skeleton"),
        (
            "var<workgroup> shared_color: vec4f;",
            "",
            "3:1",
            "`var<workgroup>` is up to the skeleton; a snippet may have `var<private>`",
        ),
        (
            "",
            "    textureStore(out1_color, vec2u(0), medium);",
            "5:5",
            "`textureStore` reaches what all snippets share; a snippet gives back its result and nothing else",
        ),
        (
            "",
            "    let größe = 1.0; workgroupBarrier();",
            "5:22",
            "`workgroupBarrier` reaches what all snippets share; a snippet gives back its result and nothing else",
        ),
        ("", "    var state: out1_State;", "5:16", "`out1_State` belongs to another snippet of this shader"),
        (
            "",
            "    frame.two_sided = 0.0;",
            "5:5",
            "Function [20] 'shade' is invalid: The pointer [3] doesn't relate to a valid destination for a store",
        ),
        ("", "    shade(medium, surface);", "4:4", "declaration of `shade` is recursive (uses itself here)"),
        (
            "",
            "    let ray_count = größe;",
            "5:21",
            "no definition in scope for identifier: `größe` (unknown identifier)",
        ),
        ("#snippet shading", "", "3", "`#snippet` is up to the skeleton; a snippet may use #include and #if"),
        ("#each output\n#end", "", "3", "`#each` is up to the skeleton; a snippet may use #include and #if"),
        (
            "#include \"traversal/traversal.wgsl\"",
            "",
            "3",
            "files include each other: traversal/traversal.wgsl -> traversal/parts.wgsl -> edited/shading.wgsl -> traversal/traversal.wgsl",
        ),
        (&" ".repeat(300 << 10), "", "3:262109", "the text is 300 KiB long, but a snippet may have 256 KiB"),
    ] {
        let found = shading_with(module, body).expect("must be refused");
        assert_eq!(found.lines().next(), Some(format!("edited/shading.wgsl:{place}: {message}").as_str()));
    }
}

/// Names of its own may be any that WGSL allows: those of the skeleton, of other slots, and words of other languages.
#[test]
fn names_of_a_snippet_are_its_own() {
    for module in [
        "fn classify(s: vec4f) -> vec4f { return s; }",
        "struct State { Ray: f32 }\nfn lit(state: State) -> f32 { return state.Ray; }",
        "var<private> volume: f32;\nfn ray_through() { volume += 1.0; }",
        "const frame_ = 1.0; alias Sample = vec4f; fn größe(Δ: f32) -> f32 { return Δ; }",
        "@must_use fn skip_empty() -> u32 { return 0u; }",
        "struct Aligned { @align(16) x: f32 }",
    ] {
        assert_eq!(
            shading_with(module, "    var ray = medium; ray.x += surface.normal.x; let out1 = ray;"),
            None,
            "{module}"
        );
    }
}

/// Depth that would overflow a stack, and length that would take all day, end with a message.
#[test]
fn monstrous_texts_are_refused_in_time() {
    let many = |open: &str, inner: &str, close: &str| format!("{}{inner}{}", open.repeat(20_000), close.repeat(20_000));
    for body in [
        format!("    let x = {};", many("(", "1.0", ")")),
        format!("    let x = {};", many("-", "1.0", "")),
        many("{", "", "}"),
        many("if true {", "", "}"),
        format!("    {} {{}}", "if true {} else ".repeat(10_000)),
        format!("    let x = medium{};", ".xyzw".repeat(20_000)),
        format!("    let x = 1.0{};", " + 1.0".repeat(20_000)),
        format!("    var x: {};", many("array<", "f32", ", 1>")),
        "/*".repeat(60_000),
    ] {
        if let Some(message) = shading_with("", &body) {
            assert!(message.starts_with("edited/shading.wgsl:") || message.starts_with("shader: "), "{message:.200}");
        }
    }
}

/// Arrays over which a driver takes minutes, or crashes, and code that grows by calls are refused before any driver sees them.
#[test]
fn what_no_driver_can_bear_is_refused_where_it_stands() {
    let bytes = |total: u64| {
        format!(
            "arrays and other large values take {total} bytes for every ray (a function counts as often as it is called), but \
             a shader may have 1024; make them smaller"
        )
    };
    let table = "fn table(x: f32) -> f32 { var a: array<f32, 32>; a[u32(x)] = x; return a[1]; }";
    let doubled: String =
        (1..24).map(|n| format!("fn f{n}(x: f32) -> f32 {{ return f{0}(x) + f{0}(x + 1.0); }}\n", n - 1)).collect();
    let nested: String = (1..12).map(|n| format!("struct S{n} {{ a: S{0}, b: S{0} }}\n", n - 1)).collect();
    for (module, body, place, message) in [
        ("", "    var a: array<vec4f, 256>; a[u32(medium.x)] = medium;", "5:5", bytes(4096)),
        ("", "    var a: array<vec4f, 100000000>; a[u32(medium.x)] = medium;", "5:5", bytes(1_600_000_000)),
        ("var<private> a: array<array<f32, 100>, 100>;", "    a[u32(medium.x)][1] = medium.x;", "3:1", bytes(40_000)),
        ("const a = array<vec4f, 100>();", "    let x = a[u32(medium.x)];", "5:13", bytes(1600)),
        (table, &format!("    let x = 0.0{};", " + table(medium.x)".repeat(9)), "3:27", bytes(9 * 128)),
        (&format!("struct S0 {{ x: vec4f }}\n{nested}"), "    var s: S11;", "17:5", bytes(32_768)),
    ] {
        let found = shading_with(module, body).unwrap_or_else(|| panic!("must be refused: {module} {body}"));
        assert_eq!(found.lines().next(), Some(format!("edited/shading.wgsl:{place}: {message}").as_str()), "{body}");
    }
    let found = shading_with(&format!("fn f0(x: f32) -> f32 {{ return x; }}\n{doubled}"), "    let x = f23(medium.x);");
    let found = found.expect("must be refused");
    assert!(found.contains("call this function less often") && found.starts_with("edited/shading.wgsl:"), "{found}");

    for (module, body) in [
        ("", "    var a: array<vec4f, 64>; a[u32(medium.x) % 64u] = medium;"),
        (table, "    for (var i = 0u; i < 100u; i++) { let x = table(medium.x); }"),
    ] {
        assert_eq!(shading_with(module, body), None, "{body}");
    }
}

#[test]
fn files_that_are_no_text_are_named_with_the_place() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut bytes = "//! slot: shading\n//! help: ö".as_bytes().to_vec();
    bytes.extend([0xff, 0xfe]);
    std::fs::write(folder.path().join("broken.wgsl"), bytes).expect("written");
    let mut library = Library::built_in().expect("built-in snippets");
    let problems = library.add_folder(folder.path());
    let [problem] = &problems[..] else { panic!("{problems:?}") };
    assert_eq!((problem.line, problem.column), (2, 12));
    assert!(problem.to_string().contains("broken.wgsl:2:12: the snippet is no UTF-8 text"), "{problem}");
}

#[test]
fn loops_of_a_users_own_are_bounded_and_keep_their_places() {
    let library = Library::built_in().expect("built-in snippets");
    let text = "//! slot: shading\nfn shade(medium: vec4f, surface: Surface) -> vec4f {\n    var n = 0u;\n    loop { n += 1u; while n > 3u { n -= 1u; } }\n    for (var i = 0u; i < vec2u(4u).x; i++) { n += i; }\n    return medium * f32(n);\n}\n";
    let edited = Snippet::edited("shading", Slot::Shading, text).expect("a declaration");
    let mut choice = choice(&library, &[(Slot::Classification, "transfer_function")], "dvr");
    choice.put(edited);
    let assembled = assemble(&library, &choice).expect("assembled");
    let places: Vec<_> = assembled.loops.iter().map(|(file, line, column)| (&**file, *line, *column)).collect();
    assert_eq!(places, [("edited/shading.wgsl", 4, 5), ("edited/shading.wgsl", 4, 21), ("edited/shading.wgsl", 5, 5)]);
    assert_eq!(assembled.text.matches("if loop_is_over(&rounds_of_loop_").count(), 3);
    validate(&library, assembled).expect("valid");

    // An error behind a loop on the same line is still told at its own column.
    let broken = text.replace("n -= 1u; } }", "n -= 1u; } m }");
    let edited = Snippet::edited("shading", Slot::Shading, &broken).expect("a declaration");
    choice.put(edited);
    let problem = validate(&library, assemble(&library, &choice).expect("assembled")).expect_err("broken");
    assert_eq!((problem.line, problem.column), (4, 49), "{problem}");
}

#[test]
fn a_snippet_for_an_earlier_contract_is_told_what_to_change() {
    let old = "//! slot: compositing\nstruct State { color: vec4f }\nfn begin() -> State { return State(vec4f(0.0)); }\nfn add(state: ptr<function, State>, ray: Ray, s: Sample) {\n    (*state).color += vec4f(s.along * ray.step_length, frame.dims);\n}\nfn done(state: State) -> bool { return false; }\nfn finish(state: State, ray: Ray) -> Result { return Result(state.color, -1.0); }\n";
    let found = problem(Slot::Compositing, old).expect("refused");
    let told: Vec<_> = found.lines().filter(|line| line.starts_with("edited/")).collect();
    insta::assert_snapshot!(told.join("\n"), @r"
    edited/compositing.wgsl:5:31: `s.along` is of an earlier contract; write `distance`: places on a ray are distances in reference lengths
    edited/compositing.wgsl:5:43: `ray.step_length` is of an earlier contract; leave it out: distances are in reference lengths already
    edited/compositing.wgsl:5:62: `frame.dims` is of an earlier contract; write `source.dims`: a volume's data are reached through its source
    ");
    // Names of its own may be what they like.
    let own = "//! slot: compositing\nstruct State { along: f32 }\nfn begin() -> State { return State(0.0); }\nfn add(state: ptr<function, State>, ray: Ray, s: Sample) {\n    (*state).along += s.length;\n}\nfn done(state: State) -> bool { return false; }\nfn finish(state: State, ray: Ray) -> Result { return Result(vec4f(state.along), -1.0); }\n";
    assert_eq!(problem(Slot::Compositing, own), None);
}
