//! `catoptric examples`, and what explains the program: help, completions, manual pages.

use crate::common::Folder;

const COMMANDS: [&str; 9] =
    ["studio", "render", "check", "diff", "convert", "serve", "examples", "completions", "man"];

#[test]
fn every_example_is_listed_and_good() {
    let folder = Folder::new();
    let list = folder.good("examples");
    assert!(list.lines().count() >= 6, "{list}");
    for line in list.lines() {
        let (name, title) = line.split_once("  ").unwrap();
        assert!(!title.trim().is_empty(), "{line}");
        let text = folder.good(&format!("examples {name}"));
        folder.good(&format!("examples {name} -o {name}.toml"));
        assert_eq!(folder.read(format!("{name}.toml")), text.as_bytes());
        assert!(folder.good(&format!("check {name}.toml")).contains(".toml: good ("));
    }
}

#[test]
fn wrong_requests_are_refused() {
    let folder = Folder::new();
    for (line, said) in [
        ("examples whited", "did you mean \"whitted\"?"),
        ("examples nonsense", "`catoptric examples` lists the scenes"),
        ("examples -o a.toml", "<NAME>"),
        ("examples whitted -o a.png", "`catoptric render whitted -o a.png`"),
        ("examples whitted -o no/a.toml", "there is no directory no"),
        ("examples whitted -o .", "directory"),
        ("completions nonsense", "bash"),
        ("man nonsense", "choose one of: studio, render, check"),
        ("man help", "choose one of: studio, render, check"),
    ] {
        let errors = folder.refused(line);
        assert!(errors.contains(said), "{line}: {errors}");
    }
}

#[test]
fn help_mentions_every_command_and_the_exit_statuses() {
    let folder = Folder::new();
    let help = folder.good("--help");
    for command in COMMANDS {
        assert!(help.contains(&format!("\n  {command} ")), "{command}: {help}");
        assert!(folder.good(&format!("help {command}")).contains("Usage: "), "{command}");
    }
    assert!(help.contains("0 done, 1 a comparison failed, 2 the input is wrong, 130 interrupted"), "{help}");
    assert!(folder.good("--version").starts_with("catoptric "));
}

#[test]
fn every_shell_has_a_script_that_asks_the_program() {
    let folder = Folder::new();
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = folder.good(&format!("completions {shell}"));
        assert!(script.contains("CATOPTRIC_COMPLETE") && script.contains(" -- "), "{shell}: {script}");
    }
}

#[test]
fn manual_pages_hold_every_option() {
    let folder = Folder::new();
    let page = folder.good("man");
    for command in COMMANDS {
        assert!(page.contains(&format!("catoptric\\-{command}(1)")), "{command}: {page}");
        let page = folder.good(&format!("man {command}"));
        assert!(page.contains(".SH SYNOPSIS") && page.contains(".TH "), "{command}: {page}");
        let help = folder.good(&format!("{command} --help"));
        let options =
            help.split(|c: char| c.is_whitespace() || c == ',').filter(|word| word.starts_with("--"));
        let mut count = 0;
        for option in options.filter(|option| option.len() > 2) {
            let option = option.trim_end_matches(['.', ';', ')', ']']);
            assert!(page.contains(&option.replace('-', "\\-")), "{command} {option}: {page}");
            count += 1;
        }
        assert!(count >= 2, "{command}: {help}");
    }
}
