//! Random texts: every one is read, or refused with words.

use catoptric_exchange::{ForeignFormat, ImportOptions, read};
use catoptric_scene::Language;

/// Texts to be changed.
const SEEDS: [(ForeignFormat, &str); 4] = [
    (
        ForeignFormat::MiniRt,
        "R 640 480\nA 0.2 255,255,255\nC 0,0,5 0,0,-1 60\nL 0,4,4 0.5 255,255,255\nsp 0,0,0 2 255,102,0 reflection=0.3\n\
         cy 0,0,0 0,1,0 1 2 9,9,9 12 0.5 1\nma checker:1,2,3:0.5\nsq 1,2,3 0,1,0 4 1,2,3\nco 0,0,0 0,1,0 1 2 9,9,9\n\
         pl 0,-1,0 0,1,0 1,1,1 checker\ntr 0,0,0 1,0,0 0,1,0 9,9,9 # end\n",
    ),
    (
        ForeignFormat::MiniRt,
        "R depth:8 soft:1\nA 0.2 255 ,255 , 255\nC 0,0,5 0,0,-1 60 0.0\nL 0,4,4 0.5\nsp metal 0.3 0,0,0 rough: 0.2 2 9,9,9\n\
         co 0,0,0 0,1,0 30 4 9,9,9\ncn 0,9,0 0,1,0 20 9,9,9 cd:1,2,3:4,5,6:1\ntri 0,0,0 1,0,0 0,1,0 m_wall\nsp 1,1,1 3\n",
    ),
    (
        ForeignFormat::Challenge,
        "- add: camera\n  width: 40\n  height: 20\n  field-of-view: 0.7\n  from: [1, 2, -5]\n  to: [0, 0, 0]\n  up: [0, 1, 0]\n\
         - add: light\n  at: [1, 2, 3]\n  intensity: [1, 1, 1]\n- define: m\n  value: &x\n    color: [1, 0.5, 0]\n    reflective: 0.2\n\
         - define: n\n  extend: m\n  value:\n    pattern:\n      type: checkers\n      colors: [[0, 0, 0], [1, 1, 1]]\n      transform: [[scale, 2, 2, 2]]\n\
         - define: t\n  value:\n  - [rotate-x, 1.5]\n  - [shear, 1, 0, 0, 0, 0, 0]\n- add: group\n  transform: [t]\n  children:\n  - add: sphere\n    material: n\n  - add: cube\n    material: *x\n\
         - add: cone\n  min: -1\n  max: 2\n  closed: true\n  shadow: false\n- add: cylinder\n  min: 0\n- add: triangle\n  p1: [0, 0, 0]\n  p2: [1, 0, 0]\n  p3: [0, 1, 0]\n",
    ),
    (
        ForeignFormat::Nff,
        "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nhither 1\nresolution 8 8\nb 0.1 0.2 0.3\nl 0 4 4\nl 1 1 1 1 0 1\n\
         f 1 0.5 0 0.5 0 1 0 0\ns 0 0 0 1\nc\n0 0 0 1\n0 1 0 0.5\np 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\npp 3\n0 0 0 0 1 0\n1 0 0 0 1 0\n0 1 0 0 1 0\n",
    ),
];

/// Pieces to be put in.
const PIECES: [&str; 24] = [
    "\n",
    " ",
    "-",
    ",",
    "0",
    "1e9",
    "-1e-9",
    "1e308",
    "nan",
    ".inf",
    "255,255,255",
    "[",
    "]",
    "{",
    "}",
    ": ",
    "&a ",
    "*a",
    "\"",
    "#",
    "\u{416}",
    "\t",
    "- add: n\n",
    "|",
];

/// Pseudo-random numbers by xorshift (Marsaglia 2003).
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % bound.max(1) as u64) as usize
    }

    /// A place in the text between two characters.
    fn place(&mut self, text: &str) -> usize {
        let mut at = self.below(text.len() + 1);
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        at
    }

    /// The text after up to eight changes: pieces removed, repeated and put in.
    fn changed(&mut self, seed: &str) -> String {
        let mut text = seed.to_owned();
        for _ in 0..=self.below(8) {
            let (a, b) = (self.place(&text), self.place(&text));
            let (from, to) = (a.min(b), a.max(b).min(a.min(b) + 60));
            let to = (from..=to).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(from);
            match self.below(4) {
                0 => text.replace_range(from..to, ""),
                1 => {
                    let piece = text[from..to].to_owned();
                    text.insert_str(from, &piece);
                }
                _ => text.insert_str(from, PIECES[self.below(PIECES.len())]),
            }
        }
        text
    }
}

fn read_changed(count: usize) {
    for (format, seed) in SEEDS {
        let mut random = Random(0x9e37_79b9_7f4a_7c15);
        let mut good = 0;
        for _ in 0..count {
            let text = random.changed(seed);
            let options = ImportOptions { is_approximate: random.below(2) == 0, ..ImportOptions::default() };
            match read(format, &text, &options) {
                Ok(found) => {
                    good += 1;
                    assert_eq!(found.scene.check(), [], "{text}");
                    assert!(!found.report.has_errors());
                }
                Err(errors) => {
                    assert!(errors.has_errors(), "{text}");
                    for finding in &errors {
                        assert!(finding.line > 0 && finding.span.end <= text.len() + 1, "{text}");
                        let said = Language::ALL.map(|language| finding.line_of_text(language));
                        assert!(said.iter().all(|line| !line.contains('\n')), "{said:?}");
                    }
                }
            }
        }
        assert!(good > 0 && good < count, "{format:?}: {good} of {count}");
    }
}

#[test]
fn changed_texts_are_read_or_refused() {
    read_changed(3000);
}

/// A million texts of each format; minutes.
#[test]
#[ignore = "a million texts of each format take three minutes; thousands are tried above"]
fn a_million_changed_texts_are_read_or_refused() {
    read_changed(1_000_000);
}
