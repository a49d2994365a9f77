//! What the tab key offers: asked as shells ask, and in real shells where there are any.

use std::fmt::Write as _;
use std::io::Write as _;
use std::process::Command;

use crate::common::{Folder, NOTHING, Ran};

const SCENE: &str = "\
format = 'catoptric/1'
[materials.glass]
model = 'dielectric'
[materials.gold]
model = 'conductor'
[[lights]]
name = 'sun'
[[bodies]]
name = 'ball'
radius = 0.5
material = 'glass'
[[bodies]]
name = 'my cube.2'
shape = 'cube'
";

/// What is offered for the last of these words, as fish gets it, and its explanations.
fn offered(folder: &Folder, words: &[&str]) -> Vec<(String, String)> {
    let mut command = folder.command(["--", "catoptric"].iter().chain(words));
    let ran = Ran::of(command.env("CATOPTRIC_COMPLETE", "fish").output().unwrap());
    assert_eq!((ran.status, ran.errors.as_str()), (Some(0), ""), "{words:?}: {ran:?}");
    let line = |line: &str| {
        let (word, help) = line.split_once('\t').unwrap_or((line, ""));
        (word.to_owned(), help.to_owned())
    };
    ran.output.lines().map(line).collect()
}

fn words(folder: &Folder, line: &[&str]) -> Vec<String> {
    offered(folder, line).into_iter().map(|(word, _)| word).collect()
}

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("my.toml", SCENE);
    folder
}

#[test]
fn commands_options_scenes_and_formats_are_offered() {
    let folder = folder();
    folder.write("notes.txt", "");
    assert_eq!(words(&folder, &["rend"]), ["render"]);
    assert_eq!(words(&folder, &["render", "--softw"]), ["--software-gpu"]);
    assert_eq!(words(&folder, &["render", "whit"]), ["whitted"]);
    assert_eq!(
        words(&folder, &["check", "four-bodies", "m"]),
        ["mirror-box", "metals", "mirror-bowl", "my.toml"]
    );
    assert!(!words(&folder, &["audit", ""]).contains(&"notes.txt".to_owned()));
    assert_eq!(words(&folder, &["examples", "whit"]), ["whitted"]);
    assert_eq!(words(&folder, &["man", "mea"]), ["measure"]);
    assert_eq!(words(&folder, &["render", "whitted", "-o", "a.pn"]), ["a.png", "a.pnm"]);
    assert_eq!(words(&folder, &["render", "whitted", "--format", "ex"]), ["exr"]);
    assert!(words(&folder, &["convert", "a", "b", "--format", ""]).contains(&"nff".to_owned()));
    assert_eq!(words(&folder, &["render", "whitted", "--tone-curve", "rein"]), ["reinhard"]);
    assert_eq!(words(&folder, &["compare", "whitted", "--methods", "whitted,cub"]), ["whitted,cube-map"]);
    assert_eq!(words(&folder, &["measure", "whitted", "--answers", "mean,fl"]), ["mean,flip"]);
}

#[test]
fn addresses_of_the_scene_on_the_line_are_offered() {
    let folder = folder();
    let set = |typed: &str| words(&folder, &["render", "my.toml", "-o", "a.png", "--set", typed]);
    assert_eq!(set("bodies.ball.rad"), ["bodies.ball.radius="]);
    assert_eq!(set("bodies.ball.radius"), ["bodies.ball.radius="]);
    assert_eq!(
        set("bodies.ball.position."),
        ["bodies.ball.position.x=", "bodies.ball.position.y=", "bodies.ball.position.z="]
    );
    assert_eq!(set("bodies.\"my cube.2\".si"), ["bodies.\"my cube.2\".size="]);
    assert_eq!(set("bodies.\\\"my\\ cube.2\\\".si"), ["bodies.\"my cube.2\".size="]);
    assert_eq!(set("bodies.none."), [""; 0]);
    assert_eq!(
        words(&folder, &["check", "my.toml", "--set=lights.sun.int"]),
        ["--set=lights.sun.intensity="]
    );
    // The option may stand before other options, the scene anywhere before, and a value that is set counts.
    let line = ["render", "--set", "bodies.ball.shape=cone", "my.toml", "--set", "bodies.ball.top_"];
    assert_eq!(words(&folder, &line), ["bodies.ball.top_radius="]);
    // Nothing is known of a scene that is not there, nor of one whose file is at fault.
    assert!(words(&folder, &["render", "--set", "cam"]).is_empty());
    assert!(words(&folder, &["render", "none.toml", "--set", "cam"]).is_empty());
    let explained = offered(&folder, &["audit", "my.toml", "--set", "bodies.ball.rad"]);
    assert!(explained[0].1.starts_with("0.5: the radius"), "{explained:?}");
}

#[test]
fn what_can_stand_at_an_address_is_offered() {
    let folder = folder();
    folder.write("wood.png", "");
    let set = |typed: &str| words(&folder, &["render", "my.toml", "--set", typed]);
    assert_eq!(
        set("bodies.ball.shape=c"),
        ["cube", "cylinder", "cone"].map(|shape| format!("bodies.ball.shape={shape}"))
    );
    assert_eq!(set("bodies.ball.material="), ["bodies.ball.material=glass", "bodies.ball.material=gold"]);
    assert_eq!(set("bodies.ball.hidden="), ["bodies.ball.hidden=true", "bodies.ball.hidden=false"]);
    assert_eq!(set("bodies.ball.radius="), ["bodies.ball.radius=0.5"]);
    assert_eq!(set("bodies.ball.position="), ["bodies.ball.position=0,0,0"]);
    assert_eq!(set("environment.picture=wo"), ["environment.picture=wood.png"]);
    assert_eq!(set("bodies.ball.nothing="), [""; 0]);
}

#[test]
fn parameters_and_numbers_are_offered_for_a_sweep() {
    let folder = folder();
    let vary = |typed: &str| words(&folder, &["measure", "my.toml", "--vary", typed]);
    assert_eq!(vary("s"), ["size", "samples", "search"]);
    assert_eq!(vary("bodies.ball.rad"), ["bodies.ball.radius="]);
    assert_eq!(vary("size,bodies.ball.position.z"), ["size,bodies.ball.position.z="]);
    assert_eq!(vary("bodies.ball.sha"), ["bodies.ball.shape=", "bodies.ball.shadow="]);
    assert!(vary("bodies.ball.name").is_empty() && vary("size=1,2").is_empty() && vary("size=1").is_empty());
}

#[test]
fn many_bodies_are_completed_piece_by_piece() {
    let folder = Folder::new();
    let bodies = (0..5000).fold(String::new(), |mut text, index| {
        let _ = write!(text, "[[bodies]]\nname = 'b{index}'\n");
        text
    });
    folder.write("many.toml", format!("{NOTHING}{bodies}"));
    let set = |typed: &str| words(&folder, &["render", "many.toml", "--set", typed]);
    assert_eq!(set(""), ["camera.", "environment.", "tracing.", "bodies."]);
    assert_eq!(set("b").len(), 200);
    assert_eq!(set("bodies.b4321.rad"), ["bodies.b4321.radius="]);
    folder.write("huge.toml", format!("{NOTHING}# {}", "x".repeat(5 << 20)));
    assert!(words(&folder, &["render", "huge.toml", "--set", "cam"]).is_empty());
}

#[cfg(unix)]
#[test]
fn a_pipe_is_not_waited_for() {
    let folder = Folder::new();
    assert!(Command::new("mkfifo").arg(folder.path("pipe.toml")).status().unwrap().success());
    for scene in ["pipe.toml", "-", "/dev/stdin", "/dev/zero", "."] {
        assert!(words(&folder, &["render", scene, "--set", "cam"]).is_empty(), "{scene}");
    }
}

#[test]
fn a_shell_that_nobody_knows_gets_no_answer() {
    let folder = Folder::new();
    let mut command = folder.command(["--", "catoptric", "rend"]);
    let ran = Ran::of(command.env("CATOPTRIC_COMPLETE", "nonsense").output().unwrap());
    assert_eq!((ran.output.as_str(), ran.errors.as_str()), ("", ""));
}

/// What a shell prints that runs a script with the program on its path; `None` if there is no such shell.
#[cfg(unix)]
fn in_shell(shell: &str, folder: &Folder, script: &str) -> Option<String> {
    let program = std::path::Path::new(env!("CARGO_BIN_EXE_catoptric")).parent().unwrap();
    let path = std::env::var("PATH").unwrap_or_default();
    let mut command = Command::new(shell);
    if shell == "bash" {
        command.args(["--noprofile", "--norc"]);
    }
    command.args(["-c", script]).current_dir(folder.path(""));
    command.env("PATH", format!("{}:{path}", program.display())).env("HOME", folder.path(""));
    match command.output() {
        Ok(output) => Some(Ran::of(output).output),
        Err(error) => {
            let _ = writeln!(std::io::stderr().lock(), "SKIPPED: completion in {shell}: {error}");
            None
        }
    }
}

/// Bash takes words apart at `=`; readline does it as here.
#[cfg(unix)]
#[test]
fn bash_gets_whole_words_and_replaces_their_last_piece() {
    let folder = folder();
    folder.write("my own.toml", SCENE);
    let offered = |line: &str, pieces: &[&str], last: &str| {
        let words = pieces.iter().map(|piece| format!("'{piece}' ")).collect::<String>();
        let script = format!(
            "eval \"$(catoptric completions bash)\"; COMP_LINE='{line}'; COMP_POINT=${{#COMP_LINE}}\n\
             COMP_WORDS=({words}); COMP_CWORD={}\n_catoptric catoptric '{last}' ''; printf '%s\\n' \"${{COMPREPLY[@]}}\"",
            pieces.len() - 1
        );
        in_shell("bash", &folder, &script)
    };
    let Some(found) = offered("catoptric rend", &["catoptric", "rend"], "rend") else { return };
    assert_eq!(found, "render\n");
    let cases: [(&str, &[&str], &str, &str); 6] = [
        (
            "catoptric check my.toml --set bodies.ball.rad",
            &["--set", "bodies.ball.rad"],
            "bodies.ball.rad",
            "bodies.ball.radius=\n",
        ),
        (
            "catoptric check my.toml --set camera.projection=",
            &["--set", "camera.projection", "="],
            "",
            "perspective\nparallel\n",
        ),
        (
            "catoptric check my.toml --set bodies.ball.shape=cu",
            &["--set", "bodies.ball.shape", "=", "cu"],
            "cu",
            "cube\n",
        ),
        (
            "catoptric check my.toml --set=bodies.ball.rad",
            &["--set", "=", "bodies.ball.rad"],
            "bodies.ball.rad",
            "bodies.ball.radius=\n",
        ),
        ("catoptric check my.toml --set a=1 --ke", &["--set", "a", "=", "1", "--ke"], "--ke", "--keys\n"),
        ("catoptric check my.toml my\\ ow", &["my\\ ow"], "my\\ ow", "my\\ own.toml\n"),
    ];
    for (line, pieces, last, expected) in cases {
        let pieces = [&["catoptric", "check", "my.toml"], pieces].concat();
        assert_eq!(offered(line, &pieces, last).as_deref(), Some(expected), "{line}");
    }
}

#[cfg(unix)]
#[test]
fn fish_shows_what_is_meant() {
    let folder = folder();
    let script =
        "catoptric completions fish | source; complete -C 'catoptric check my.toml --set bodies.ball.rad'";
    let Some(found) = in_shell("fish", &folder, script) else { return };
    assert!(found.starts_with("bodies.ball.radius=\t0.5: the radius"), "{found}");
    assert_eq!(found.lines().count(), 1, "{found}");
}

/// What a zsh would offer is seen only on a terminal; that it takes the script is seen here.
#[cfg(unix)]
#[test]
fn zsh_takes_its_script() {
    let folder = folder();
    let script =
        "autoload -U compinit; compinit -u -D; source <(catoptric completions zsh); echo $_comps[catoptric]";
    let Some(found) = in_shell("zsh", &folder, script) else { return };
    assert_eq!(found, "_catoptric\n");
}
