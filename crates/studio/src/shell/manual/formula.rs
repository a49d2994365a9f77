//! Formulas in the notation of TeX, as far as the documents use it.

mod boxes;

pub(super) use boxes::lines;

/// A formula.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Formula {
    node: FormulaNode,
}

/// A part of a formula.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum FormulaNode {
    /// Parts side by side.
    Row(Vec<Self>),
    /// A letter that stands for a quantity; it leans.
    Letter(char),
    /// Figures, brackets, words.
    Sign(String),
    /// A sign between two parts, with room at its sides.
    Operator(char),
    /// The name of a function, such as `cos`.
    Function(String),
    /// Room, in sizes of the font.
    Space(f32),
    /// A letter with a hat: a unit vector.
    Hat(Box<Self>),
    /// A square root.
    Root(Box<Self>),
    /// One part over another one.
    Fraction(Box<Self>, Box<Self>),
    /// A part with an index, an exponent, or both.
    Script { base: Box<Self>, below: Option<Box<Self>>, above: Option<Box<Self>> },
    /// Brackets as high as what they hold.
    Fence { open: char, inner: Box<Self>, close: char },
    /// A part with a brace below it, and words below that.
    Braced { base: Box<Self>, note: Box<Self> },
}

impl FormulaNode {
    /// A letter that leans, or another sign.
    pub(super) fn letter(letter: char) -> Self {
        if letter.is_alphabetic() { Self::Letter(letter) } else { Self::Sign(letter.to_string()) }
    }

    /// `base` with an index and an exponent.
    pub(super) fn scripted(base: Self, below: Option<Self>, above: Option<Self>) -> Self {
        Self::Script { base: Box::new(base), below: below.map(Box::new), above: above.map(Box::new) }
    }

    fn is_composite(&self) -> bool {
        match self {
            Self::Row(nodes) => nodes.len() > 1,
            Self::Fraction(..) => true,
            _ => false,
        }
    }

    /// The formula in one line.
    fn plain(&self) -> String {
        let wrapped = |node: &Self| {
            if node.is_composite() { format!("({})", node.plain()) } else { node.plain() }
        };
        match self {
            Self::Row(nodes) => nodes.iter().map(Self::plain).collect(),
            Self::Letter(letter) => letter.to_string(),
            Self::Sign(sign) => sign.clone(),
            Self::Function(name) => format!("{name} "),
            Self::Operator(',') => ", ".to_owned(),
            Self::Operator(sign) => format!(" {sign} "),
            Self::Space(width) => if *width > 0.25 { " " } else { "" }.to_owned(),
            Self::Hat(base) => base.plain(),
            Self::Root(inner) => format!("√({})", inner.plain()),
            Self::Fraction(over, under) => format!("{}/{}", wrapped(over), wrapped(under)),
            Self::Script { base, below, above } => {
                let mut plain = base.plain().trim_end().to_owned();
                if let Some(below) = below {
                    plain = format!("{plain}_{}", wrapped(below));
                }
                if let Some(above) = above {
                    let sign = if above.plain() == "′" { "" } else { "^" };
                    plain = format!("{plain}{sign}{}", wrapped(above));
                }
                if matches!(**base, Self::Function(_)) { plain + " " } else { plain }
            }
            Self::Fence { open, inner, close } => format!("{open}{}{close}", inner.plain()),
            Self::Braced { base, .. } => base.plain(),
        }
    }
}

impl Formula {
    /// A formula of one part.
    pub(super) fn of(node: FormulaNode) -> Self {
        Self { node }
    }

    /// The root of the formula's tree.
    pub(super) fn node(&self) -> &FormulaNode {
        &self.node
    }

    /// The formula in one line of signs that can be read out and searched.
    pub(super) fn plain(&self) -> String {
        let plain = self.node.plain();
        plain.split_whitespace().collect::<Vec<_>>().join(" ")
    }
}

/// Reads a formula. What is not known is shown as it is written.
pub(super) fn read(tex: &str) -> Formula {
    let mut reader = FormulaParser { rest: tex };
    Formula { node: FormulaNode::Row(reader.row(None)) }
}

struct FormulaParser<'a> {
    rest: &'a str,
}

impl<'a> FormulaParser<'a> {
    /// Reads parts until the closing brace or `\right`, or to the end.
    fn row(&mut self, end: Option<&str>) -> Vec<FormulaNode> {
        let mut nodes: Vec<FormulaNode> = Vec::new();
        loop {
            self.rest = self.rest.trim_start();
            if let Some(end) = end
                && let Some(rest) = self.rest.strip_prefix(end)
            {
                self.rest = rest;
                return nodes;
            }
            let Some(first) = self.rest.chars().next() else { return nodes };
            match first {
                '^' | '_' => {
                    self.skip(first);
                    let script = self.part();
                    attach(&mut nodes, first == '^', script);
                }
                '\'' => {
                    self.skip(first);
                    attach(&mut nodes, true, FormulaNode::Sign("′".to_owned()));
                }
                _ => {
                    let node = self.part();
                    nodes.push(if is_sign_of_number(&nodes, &node) {
                        FormulaNode::Sign("−".to_owned())
                    } else {
                        node
                    });
                }
            }
        }
    }

    fn skip(&mut self, letter: char) {
        self.rest = self.rest.get(letter.len_utf8()..).unwrap_or_default();
    }

    /// Reads one part: a group, a command with what it takes, a number, or a sign.
    fn part(&mut self) -> FormulaNode {
        self.rest = self.rest.trim_start();
        let Some(first) = self.rest.chars().next() else { return FormulaNode::Row(Vec::new()) };
        if first.is_ascii_digit() {
            return FormulaNode::Sign(self.number());
        }
        self.skip(first);
        match first {
            '{' => FormulaNode::Row(self.row(Some("}"))),
            '\\' => self.command(),
            '-' => FormulaNode::Operator('−'),
            '+' | '=' | '<' | '>' | ',' => FormulaNode::Operator(first),
            other => FormulaNode::letter(other),
        }
    }

    /// A number; after `^`, `_` and `\frac`, TeX takes one figure only, as a group does not begin there.
    fn number(&mut self) -> String {
        let end = self.rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(self.rest.len());
        let number = self.rest.get(..end).unwrap_or_default().trim_end_matches('.');
        self.rest = self.rest.get(number.len()..).unwrap_or_default();
        number.to_owned()
    }

    /// What a command takes: a group, or a single sign.
    fn argument(&mut self) -> FormulaNode {
        self.rest = self.rest.trim_start();
        match self.rest.chars().next() {
            Some(figure) if figure.is_ascii_digit() => {
                self.skip(figure);
                FormulaNode::Sign(figure.to_string())
            }
            _ => self.part(),
        }
    }

    /// The words of a group, with their spaces.
    fn words(&mut self) -> String {
        let Some(rest) = self.rest.trim_start().strip_prefix('{') else { return self.argument().plain() };
        let end = rest.find('}').unwrap_or(rest.len());
        self.rest = rest.get(end + 1..).unwrap_or_default();
        rest.get(..end).unwrap_or_default().to_owned()
    }

    fn name(&mut self) -> &'a str {
        let end = self.rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(self.rest.len());
        let end = if end == 0 { self.rest.chars().next().map_or(0, char::len_utf8) } else { end };
        let (name, rest) = self.rest.split_at(end);
        self.rest = rest;
        name
    }

    fn command(&mut self) -> FormulaNode {
        let name = self.name();
        match name {
            "hat" => FormulaNode::Hat(Box::new(self.argument())),
            "sqrt" => FormulaNode::Root(Box::new(self.argument())),
            "frac" | "tfrac" | "dfrac" => {
                let over = self.argument();
                FormulaNode::Fraction(Box::new(over), Box::new(self.argument()))
            }
            "text" | "mathrm" | "operatorname" => FormulaNode::Sign(self.words()),
            "underbrace" => self.braced(),
            "left" => self.fence(),
            // Sizes of brackets.
            "big" | "Big" | "bigl" | "bigr" | "Bigl" | "Bigr" => self.part(),
            "," => FormulaNode::Space(0.17),
            ";" => FormulaNode::Space(0.28),
            " " => FormulaNode::Space(0.3),
            "!" => FormulaNode::Space(0.0),
            "quad" => FormulaNode::Space(1.0),
            "qquad" => FormulaNode::Space(2.0),
            "sin" | "cos" | "tan" | "arcsin" | "arccos" | "arctan" | "min" | "max" | "exp" | "ln" => {
                FormulaNode::Function(name.to_owned())
            }
            "bmod" => FormulaNode::Sign(" mod ".to_owned()),
            _ => sign(name),
        }
    }

    fn braced(&mut self) -> FormulaNode {
        let base = Box::new(self.argument());
        let note = match self.rest.trim_start().strip_prefix('_') {
            Some(rest) => {
                self.rest = rest;
                self.argument()
            }
            None => FormulaNode::Row(Vec::new()),
        };
        FormulaNode::Braced { base, note: Box::new(note) }
    }

    fn fence(&mut self) -> FormulaNode {
        let open = self.bracket();
        let inner = Box::new(FormulaNode::Row(self.row(Some("\\right"))));
        FormulaNode::Fence { open, inner, close: self.bracket() }
    }

    fn bracket(&mut self) -> char {
        let plain = self.part().plain();
        plain.chars().next().unwrap_or(' ')
    }
}

/// Whether a minus stands before its number, and not between two.
fn is_sign_of_number(before: &[FormulaNode], node: &FormulaNode) -> bool {
    let starts = match before.last() {
        None | Some(FormulaNode::Operator(_)) => true,
        Some(FormulaNode::Sign(sign)) => sign.ends_with(['(', '[', '/']),
        _ => false,
    };
    *node == FormulaNode::Operator('−') && starts
}

/// Hangs an index or exponent on the last part.
fn attach(nodes: &mut Vec<FormulaNode>, is_above: bool, script: FormulaNode) {
    let (base, below, above) = match nodes.pop() {
        Some(FormulaNode::Script { base, below, above }) => (base, below, above),
        Some(base) => (Box::new(base), None, None),
        None => (Box::new(FormulaNode::Row(Vec::new())), None, None),
    };
    // By itself, a sign of operation has no room at its sides.
    let script = match script {
        FormulaNode::Operator(sign) => FormulaNode::Sign(sign.to_string()),
        other => other,
    };
    let script = Some(Box::new(script));
    nodes.push(if is_above {
        // A prime and an exponent stand side by side.
        let above = match (above, script) {
            (Some(first), Some(second)) => Some(Box::new(FormulaNode::Row(vec![*first, *second]))),
            (first, second) => first.or(second),
        };
        FormulaNode::Script { base, below, above }
    } else {
        FormulaNode::Script { base, below: script, above }
    });
}

/// The sign of a command; a command that is not known is shown by its name.
fn sign(name: &str) -> FormulaNode {
    const LETTERS: [(&str, char); 16] = [
        ("alpha", 'α'),
        ("beta", 'β'),
        ("gamma", 'γ'),
        ("delta", 'δ'),
        ("varepsilon", 'ε'),
        ("epsilon", 'ε'),
        ("eta", 'η'),
        ("theta", 'θ'),
        ("lambda", 'λ'),
        ("mu", 'μ'),
        ("pi", 'π'),
        ("rho", 'ρ'),
        ("sigma", 'σ'),
        ("tau", 'τ'),
        ("varphi", 'φ'),
        ("phi", 'φ'),
    ];
    const OPERATORS: [(&str, char); 9] = [
        ("cdot", '·'),
        ("times", '×'),
        ("le", '≤'),
        ("ge", '≥'),
        ("approx", '≈'),
        ("to", '→'),
        ("pm", '±'),
        ("ne", '≠'),
        ("in", '∈'),
    ];
    const SIGNS: [(&str, &str); 10] = [
        ("sum", "∑"),
        ("int", "∫"),
        ("prod", "∏"),
        ("infty", "∞"),
        ("lfloor", "⌊"),
        ("rfloor", "⌋"),
        ("lvert", "|"),
        ("rvert", "|"),
        ("%", "%"),
        ("ldots", "…"),
    ];
    if let Some((_, letter)) = LETTERS.iter().find(|(own, _)| *own == name) {
        return FormulaNode::Letter(*letter);
    }
    if let Some((_, operator)) = OPERATORS.iter().find(|(own, _)| *own == name) {
        return FormulaNode::Operator(*operator);
    }
    let sign = SIGNS.iter().find(|(own, _)| *own == name).map_or(name, |(_, sign)| sign);
    FormulaNode::Sign(sign.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(tex: &str) -> String {
        read(tex).plain()
    }

    #[test]
    fn formulas_can_be_read_in_one_line() {
        assert_eq!(plain(r"k_a C I_a"), "k_aCI_a");
        assert_eq!(plain(r"\hat w = \frac{e - \text{target}}{|e|}"), "w = (e − target)/(|e|)");
        assert_eq!(plain(r"\frac12 + i/\varphi_2^2"), "1/2 + i/φ_2^2");
        assert_eq!(plain(r"\cos\theta' = \sqrt{1 - \sin^2\theta/\eta^2}"), "cos θ′ = √(1 − sin^2 θ/η^2)");
        assert_eq!(plain(r"\left\lfloor M \right\rfloor, \qquad x"), "⌊M⌋, x");
        assert_eq!(plain(r"\underbrace{k_r I}_{\text{reflection}}"), "k_rI");
        assert_eq!(plain(r"92\,\%"), "92%");
        assert_eq!(plain(r"10^{-6} - \operatorname{atan2}(x, -z)"), "10^(−6) − atan2(x, −z)");
    }

    #[test]
    fn no_formula_of_the_manual_has_a_command_that_is_not_known() {
        use crate::base::texts::Language;
        use crate::shell::manual::pages::SOURCES;
        fn names(node: &FormulaNode, into: &mut Vec<String>) {
            match node {
                FormulaNode::Row(nodes) => nodes.iter().for_each(|node| names(node, into)),
                FormulaNode::Sign(sign) => into.push(sign.clone()),
                FormulaNode::Hat(inner) | FormulaNode::Root(inner) | FormulaNode::Fence { inner, .. } => {
                    names(inner, into);
                }
                FormulaNode::Fraction(over, under) => [over, under].iter().for_each(|node| names(node, into)),
                FormulaNode::Script { base, below, above } => {
                    names(base, into);
                    [below, above].into_iter().flatten().for_each(|node| names(node, into));
                }
                FormulaNode::Braced { base, .. } => names(base, into),
                _ => {}
            }
        }
        let commands = |tex: &str| -> Vec<String> {
            let parts = tex.split('\\').skip(1);
            parts.map(|part| part.chars().take_while(char::is_ascii_alphabetic).collect()).collect()
        };
        for language in Language::ALL {
            for source in SOURCES {
                let mut is_code = false;
                for line in source.text(language).unwrap().lines() {
                    is_code ^= line.trim_start().starts_with("```");
                    // Formulas stand between dollars; each odd part is one.
                    let parts = line.split('$').enumerate().filter(|(place, _)| place % 2 == 1 && !is_code);
                    for (_, tex) in parts {
                        let mut signs = Vec::new();
                        names(read(tex).node(), &mut signs);
                        let unknown =
                            commands(tex).into_iter().find(|name| name.len() > 1 && signs.contains(name));
                        assert_eq!(unknown, None, "{language:?} {}: {line}", source.path);
                    }
                }
            }
        }
    }
}
