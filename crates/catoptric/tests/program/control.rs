//! Names, paths and arguments that would control a terminal, a drawing or a page are shown and do nothing.

use crate::common::{Folder, Ran};
use catoptric_scene::is_active;

/// Colors, the title of the window, C1, DEL, bell, the direction of text, quotes and markup.
const WILD: &str = r#"\u001b[31mB\u001b]0;t\u0007\u009b2J\u007f\u202e\"</text>&\\N\nx"#;

fn scene() -> String {
    format!(
        "format = \"catoptric/1\"\n[materials.\"{WILD}\"]\ndiffuse = 0.9\nreflection = 0.9\n\
         [[lights]]\nname = \"{WILD}\"\nposition = [0, 5, 5]\n\
         [[bodies]]\nname = \"{WILD}\"\nmaterial = \"{WILD}\"\nposition = [0, 1, 0]\n"
    )
}

/// Whether this does nothing but be read, line by line.
fn is_harmless(text: &str) -> bool {
    !text.contains(|character| is_active(character) && !matches!(character, '\n' | '\t'))
}

fn check(ran: &Ran, line: &str) {
    assert!(is_harmless(&ran.output) && is_harmless(&ran.errors), "{line}: {ran:?}");
    assert!(!ran.errors.contains("panicked"), "{line}: {ran:?}");
}

#[test]
fn names_are_shown_and_do_nothing() {
    let folder = Folder::new();
    folder.write("good.toml", scene());
    folder.write("unused.toml", scene().replace("material = ", "# "));
    folder.write("undefined.toml", scene().replace("[materials", "[[materials"));
    folder.write("twice.toml", format!("{}[[bodies]]\nname = \"{WILD}\"\n\"{WILD}\" = 1\n", scene()));
    folder.write("raw.toml", scene().replace("diffuse", "\u{1b}[2J\u{202e}diffuse"));
    folder.write("comment.toml", format!("{}# \u{9b}2J\u{202e} comment\nradius = -1\n", scene()));
    folder.write("image.toml", format!("{}[environment]\npicture = \"{WILD}\"\n", scene()));
    for line in [
        "check good.toml unused.toml undefined.toml twice.toml raw.toml comment.toml image.toml",
        "render good.toml -o a.png --size 8x8",
        "render comment.toml -o a.png --size 8x8",
        "audit good.toml --pixel 4,4 --size 8x8",
        "audit good.toml --pixel 4,4 --size 8x8 --json",
        "audit good.toml --pixel 4,4 --size 8x8 --svg -",
        "audit good.toml --pixel 4,4 --size 8x8 --dot -",
        "audit good.toml --exact",
        "audit good.toml --exact --json",
        "convert good.toml -",
    ] {
        check(&folder.run(line), line);
    }
    // What is written is what was read.
    folder.good("convert good.toml again.toml");
    let read = |name: &str| catoptric_scene::read(&String::from_utf8(folder.read(name)).unwrap()).scene;
    assert_eq!(read("again.toml"), read("good.toml"));
    let json = folder.good("audit good.toml --pixel 4,4 --size 8x8 --json");
    assert!(serde_json::from_str::<serde_json::Value>(&json).is_ok());
}

#[cfg(unix)]
#[test]
fn paths_and_arguments_are_shown_and_do_nothing() {
    let folder = Folder::new();
    let name = "a\u{1b}[31m\u{9b}2J\u{202e}\"<b>&'\n* x.toml";
    folder.write(name, scene());
    folder.write("broken\u{7}\n.toml", "format = 1\n");
    for arguments in [
        &["check", name, "broken\u{7}\n.toml", "none\u{1b}]0;x\u{7}\nerror: x.toml"][..],
        &["render", name, "-o", "none\u{1b}[2J/a.png"],
        &["render", name, "-o", "a\u{1b}[2J\n.jpg"],
        &["render", "broken\u{7}\n.toml", "-o", "a.png"],
        &["render", name, "-o", "a\u{1b}.png", "--size", "8x8", "--stats", "-"],
        &["render", name, "-o", "a.png", "--size", "8\u{1b}[31mx"],
        &["rend\u{1b}[31mer"],
        &["render", "--\u{1b}[31mbold"],
        &["audit", name, "--pixel", "4,4\u{9b}"],
        &["help", "\u{1b}[31mx"],
        &["man", "\u{1b}[31mx"],
        &["convert", "a\u{1b}.png", "b\u{1b}.toml"],
        &["diff", "a\u{1b}.png", "a\u{1b}.png"],
        &["diff", "a\u{1b}.png", "none\u{1b}.png"],
        &["examples", "whit\u{1b}ted"],
        &["measure", name, "--vary", "threads\u{1b}[31m=1"],
    ] {
        check(&folder.run_with(arguments), &format!("{arguments:?}"));
    }
    let refused = folder.run_with(["check", "none\nerror: forged.toml"]);
    assert!(!refused.output.contains("\nerror: forged"), "{refused:?}");
}

/// Reports name the scene and its pictures, in pages, drawings and chapters.
#[cfg(unix)]
#[test]
fn reports_name_files_and_do_nothing() {
    let folder = Folder::new();
    let name = "a\u{1b}[31m\u{9b}2J\u{202e}\"<b>&'|[x](y) *z* $x$ \\n.toml";
    folder.write(name, scene());
    let vary = ["--vary", "size=8x8,16x16,24x24,32x32", "--rounds", "2", "--size", "8x8"];
    let mut measure = vec!["measure", name, "-o", "study"];
    measure.extend(vary);
    check(&folder.run_with(&measure), "measure");
    for file in ["report.md", "report.tex", "time.svg", "points.csv"] {
        let text = String::from_utf8(folder.read(format!("study/{file}"))).unwrap().replace("\r\n", "\n");
        assert!(is_harmless(&text), "{file}");
    }
    let markdown = String::from_utf8(folder.read("study/report.md")).unwrap();
    assert!(markdown.contains("\\[x\\](y) \\*z\\*") && !markdown.contains("*z*"), "{markdown}");
    let latex = String::from_utf8(folder.read("study/report.tex")).unwrap();
    assert!(latex.contains("\\$x\\$ \\textbackslash{}n"), "{latex}");
    let compare =
        ["compare", name, "--methods", "whitted,flat", "--size", "16x16", "--runs", "1", "-o", "page"];
    check(&folder.run_with(compare), "compare");
    for file in ["report.html", "metrics.json"] {
        let text = String::from_utf8(folder.read(format!("page/{file}"))).unwrap();
        assert!(is_harmless(&text) && !text.contains("<b>&"), "{file}");
    }
}
