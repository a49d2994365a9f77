//! `catoptric check`

use crate::common::{FIVE_ERRORS, FIVE_PLACES, Folder, NOTHING, ONE_BODY};

#[test]
fn a_good_scene_gets_a_line_with_what_it_holds() {
    let folder = Folder::new();
    folder.write("one.toml", ONE_BODY);
    folder.write("nothing.toml", NOTHING);
    assert_eq!(
        folder.good("check one.toml nothing.toml whitted"),
        "one.toml: good (1 body, 1 light)\nnothing.toml: good (0 bodies, 0 lights)\n\
         whitted: good (4 bodies, 2 lights)\n"
    );
}

#[test]
fn mirrors_that_need_more_generations_are_noted() {
    let folder = Folder::new();
    let wall = |x: f64| {
        format!(
            "[[bodies]]\nshape = \"cube\"\nmaterial = {{ reflection = 0.5 }}\nposition = [{x:.1}, 0.0, 0.0]\n"
        )
    };
    let head = "format = \"catoptric/1\"\n[tracing]\ngenerations = 5\n";
    folder.write("mirrors.toml", format!("{head}{}{}", wall(-2.0), wall(2.0)));
    let output = folder.good("check mirrors.toml");
    assert!(output.contains("note: body 1 and body 2 may pass on 0.5 of the light"), "{output}");
    assert!(
        output.contains("11 generations would surely leave out less than 1/512, the scene has 5"),
        "{output}"
    );
}

/// Glass in glass, followed for very long: said before it is traced, with what would bound it.
#[test]
fn trees_that_explode_are_noted_with_their_rays() {
    let folder = Folder::new();
    let scene = |tracing: &str| {
        let ball = |radius: f64, ior: f64| {
            format!(
                "[[bodies]]\nposition = [0.0, 1.2, 0.0]\nradius = {radius}\n\
                 material = {{ model = \"dielectric\", ior = {ior:.1} }}\n"
            )
        };
        format!("format = \"catoptric/1\"\n[tracing]\n{tracing}\n{}{}", ball(1.0, 1.5), ball(0.9, 1.0))
    };
    folder.write("deep.toml", scene("generations = 40"));
    folder.write("usual.toml", scene("generations = 8"));
    folder.write("bounded.toml", scene("generations = 40\nthreshold = 0.001"));
    let output = folder.good("check deep.toml");
    assert!(
        output.contains("deep.toml: note: with 40 generations and the threshold 0 a picture of 1280x720"),
        "{output}"
    );
    assert!(output.contains(" rays, ") && output.contains("`threshold = 0.001` would take "), "{output}");
    assert!(output.ends_with("deep.toml: good (2 bodies, 0 lights)\n"), "{output}");
    for name in ["usual.toml", "bounded.toml"] {
        assert!(!folder.good(&format!("check {name}")).contains("rays"), "{name}");
    }
}

#[test]
fn all_errors_of_all_files_are_reported_and_good_files_too() {
    let folder = Folder::new();
    folder.write("bad.toml", FIVE_ERRORS);
    folder.write("one.toml", ONE_BODY);
    let ran = folder.run("check bad.toml no.toml one.toml nonsense");
    assert_eq!((ran.status, ran.errors.as_str()), (Some(2), ""), "{ran:?}");
    for place in FIVE_PLACES {
        assert_eq!(ran.output.matches(&format!("--> bad.toml:{place}\n")).count(), 1, "{place}: {ran:?}");
    }
    let verdicts: Vec<&str> = ["bad.toml: bad", "no.toml: not", "one.toml: good", "nonsense: not"]
        .iter()
        .filter_map(|start| ran.output.lines().find(|line| line.starts_with(start)))
        .collect();
    assert_eq!(
        verdicts,
        [
            "bad.toml: bad, 5 errors",
            "no.toml: not read",
            "one.toml: good (1 body, 1 light)",
            "nonsense: not read"
        ],
        "{ran:?}"
    );
    assert!(ran.output.contains("error: cannot read no.toml: there is no such file; check its name\n"));
}

#[test]
fn one_error_is_singular() {
    let folder = Folder::new();
    folder.write("bad.toml", "format = \"catoptric/1\"\n[camera]\nfov = \"wide\"\n");
    let ran = folder.run("check bad.toml");
    assert_eq!(ran.status, Some(2));
    assert!(ran.output.ends_with("\nbad.toml: bad, 1 error\n"), "{ran:?}");
}

#[test]
fn a_flood_of_errors_is_counted() {
    let folder = Folder::new();
    folder
        .write("bad.toml", format!("format = \"catoptric/1\"\n{}", "[[bodies]]\nradius = -1\n".repeat(3000)));
    let ran = folder.run("check bad.toml");
    assert_eq!(ran.status, Some(2));
    assert!(ran.output.contains(" more\n") && ran.output.contains("bad.toml: bad, "), "{}", ran.output);
}

#[test]
fn something_to_check_must_be_given() {
    assert!(Folder::new().refused("check").contains("<SCENES>..."));
}
