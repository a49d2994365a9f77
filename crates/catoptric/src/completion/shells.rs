//! The scripts that make shells ask: those of `clap_complete`, but where addresses with `.` and `=` need more.

use std::ffi::OsString;
use std::io::{self, Write};
use std::path::Path;

use clap::Command;
use clap_complete::env::{Bash, Elvish, EnvCompleter, Fish, Powershell, Shells, Zsh};

/// All shells that can ask.
pub(super) const SHELLS: Shells<'static> =
    Shells(&[&WHOLE_WORD_BASH, &Elvish, &Fish, &Powershell, &OPEN_ENDED_ZSH]);

/// A shell whose script is written here.
struct OwnScript {
    shell: &'static (dyn EnvCompleter + Sync),
    /// The script; `VARIABLE` stands for the variable by which the program is asked.
    script: &'static str,
}

/// Bash takes words apart at `=` and `:`, puts a blank behind all that is alone, and keeps no blanks in words.
static WHOLE_WORD_BASH: OwnScript = OwnScript { shell: &Bash, script: BASH };

/// Zsh puts a blank behind an address though its value is still to come.
static OPEN_ENDED_ZSH: OwnScript = OwnScript { shell: &Zsh, script: ZSH };

const BASH: &str = r#"_catoptric() {
    local line="${COMP_LINE:0:COMP_POINT}" words=() piece gap prefix found count=0 index
    # Words as the program gets them.
    for ((index = 0; index <= COMP_CWORD; index++)); do
        gap="${line%%[! ]*}"
        line="${line#"$gap"}"
        piece="${COMP_WORDS[index]}"
        if ((index == COMP_CWORD)); then piece="$line"; fi
        line="${line#"$piece"}"
        if ((count > 0)) && [[ -z $gap ]]; then
            words[count - 1]+="$piece"
        else
            words[count]="$piece"
            ((count += 1))
        fi
    done
    # Only what follows the last = or : is replaced.
    if [[ $piece == [=:]* ]]; then piece=""; fi
    prefix="${words[count - 1]}"
    prefix="${prefix:0:${#prefix} - ${#piece}}"
    for ((index = 0; index < count; index++)); do
        words[index]="${words[index]#[\"\']}"
        words[index]="${words[index]//\\/}"
    done
    COMPREPLY=()
    # Not by <(...), which needs /dev/fd.
    found="$(_CLAP_IFS=$'\n' _CLAP_COMPLETE_INDEX=$((count - 1)) VARIABLE=bash catoptric -- "${words[@]}" 2> /dev/null)"
    while IFS= read -r line; do
        if [[ -z $line ]]; then continue; fi
        line="${line#"${prefix//\\/}"}"
        if [[ $piece != [\"\']* ]]; then
            line="${line// /\\ }"
            line="${line//\"/\\\"}"
        fi
        COMPREPLY+=("$line")
    done <<< "$found"
    if [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *[=/.:] ]]; then
        compopt -o nospace 2> /dev/null
    fi
}
complete -o nosort -F _catoptric catoptric 2> /dev/null || complete -F _catoptric catoptric
"#;

const ZSH: &str = r#"#compdef catoptric
_catoptric() {
    local -a found open closed
    local line
    found=("${(@f)$(_CLAP_IFS=$'\n' _CLAP_COMPLETE_INDEX=$((CURRENT - 1)) VARIABLE=zsh catoptric -- "${(@Q)words}" 2> /dev/null)}")
    for line in $found; do
        if [[ ${${line//\\:/}%%:*} == *[=/.] ]]; then open+=("$line"); else closed+=("$line"); fi
    done
    [[ -n $open ]] && _describe -V values open -S ''
    [[ -n $closed ]] && _describe -V values closed
}
if [[ $funcstack[1] == _catoptric ]]; then
    _catoptric
else
    compdef _catoptric catoptric
fi
"#;

impl EnvCompleter for OwnScript {
    fn name(&self) -> &'static str {
        self.shell.name()
    }

    fn is(&self, name: &str) -> bool {
        self.shell.is(name)
    }

    fn write_registration(
        &self,
        variable: &str,
        _name: &str,
        _bin: &str,
        _completer: &str,
        to: &mut dyn Write,
    ) -> io::Result<()> {
        to.write_all(self.script.replace("VARIABLE", variable).as_bytes())
    }

    fn write_complete(
        &self,
        command: &mut Command,
        words: Vec<OsString>,
        folder: Option<&Path>,
        to: &mut dyn Write,
    ) -> io::Result<()> {
        self.shell.write_complete(command, words, folder, to)
    }
}
