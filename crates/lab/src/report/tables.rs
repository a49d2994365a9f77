//! Tables for Markdown, LaTeX and spreadsheets.

use catoptric_scene::visible;

/// A table: the first column is text or the parameter, the others are numbers.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    pub caption: String,
    pub heads: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// The table in Markdown, with its caption above. Heads and first cells may hold names of the user's choice.
    pub(crate) fn markdown(&self) -> String {
        let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
        let rule: Vec<String> =
            (0..self.heads.len()).map(|index| if index == 0 { ":---" } else { "---:" }.to_owned()).collect();
        let cell = |(index, cell): (usize, &String)| match index {
            0 => markdown(cell),
            _ => visible(cell).replace('|', "\\|"),
        };
        let heads = line(self.heads.iter().map(|head| markdown(head)).collect());
        let rows: String =
            self.rows.iter().map(|row| line(row.iter().enumerate().map(cell).collect())).collect();
        format!("*{}*\n\n{heads}{}{rows}", markdown(&self.caption), line(rule))
    }

    /// The table in LaTeX, with `booktabs`.
    pub(crate) fn latex(&self, label: &str) -> String {
        let line = |cells: &[String]| {
            let cells: Vec<String> = cells.iter().map(|cell| tex(cell)).collect();
            format!("    {} \\\\\n", cells.join(" & "))
        };
        let columns: String = (0..self.heads.len()).map(|index| if index == 0 { 'l' } else { 'r' }).collect();
        let rows: String = self.rows.iter().map(|row| line(row)).collect();
        format!(
            "\\begin{{table}}[htbp]\n  \\centering\n  \\caption{{{}}}\n  \\label{{tab:{label}}}\n  \
             \\begin{{tabular}}{{{columns}}}\n    \\toprule\n{}    \\midrule\n{rows}    \\bottomrule\n  \
             \\end{{tabular}}\n\\end{{table}}\n",
            tex(&self.caption),
            line(&self.heads)
        )
    }
}

/// Text as Markdown has it: nothing in it is markup.
pub(crate) fn markdown(text: &str) -> String {
    let mut result = String::with_capacity(text.len());
    for character in visible(text).chars() {
        if matches!(
            character,
            '\\' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '#' | '|' | '!' | '~' | '&' | '$'
        ) {
            result.push('\\');
        }
        result.push(character);
    }
    result
}

/// Text as LaTeX has it: nothing in it is a command, and what its fonts may lack is written in mathematics.
pub(crate) fn tex(text: &str) -> String {
    let mut result = String::with_capacity(text.len());
    for character in visible(text).chars() {
        let command = match character {
            '\\' => "\\textbackslash{}",
            '{' => "\\{",
            '}' => "\\}",
            '$' => "\\$",
            '&' => "\\&",
            '#' => "\\#",
            '_' => "\\_",
            '%' => "\\%",
            '~' => "\\textasciitilde{}",
            '^' => "\\textasciicircum{}",
            // In the oldest encoding of fonts these are other characters; Babel makes a command of the first.
            '"' => "\\char34{}",
            '<' => "\\textless{}",
            '>' => "\\textgreater{}",
            '|' => "\\textbar{}",
            // After the end of a row these would belong to it.
            '[' => "{[}",
            '*' => "{*}",
            '\u{a0}' => "~",
            '−' => "$-$",
            '×' => "$\\times$",
            '·' => "$\\cdot$",
            '∞' => "$\\infty$",
            '≈' => "$\\approx$",
            '…' => "\\dots{}",
            'α' => "$\\alpha$",
            'σ' => "$\\sigma$",
            'ˣ' => "$^x$",
            'ᴷ' => "$^K$",
            '²' => "$^2$",
            'ꟻ' => "F",
            other => {
                let raised = "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|digit| digit == other);
                match (raised, other) {
                    (Some(digit), _) => result.push_str(&format!("$^{digit}$")),
                    (None, '⁻') => result.push_str("$^-$"),
                    (None, other) => result.push(other),
                }
                continue;
            }
        };
        result.push_str(command);
    }
    result
}

/// Fields as a line of CSV after RFC 4180.
pub(crate) fn csv_line(fields: &[String]) -> String {
    let field = |field: &String| {
        if field.contains([',', '"', '\n', '\r']) {
            format!("\"{}\"", field.replace('"', "\"\""))
        } else {
            field.clone()
        }
    };
    let fields: Vec<String> = fields.iter().map(field).collect();
    format!("{}\r\n", fields.join(","))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_in_a_cell_breaks_a_table() {
        let wild = "a|b\\c & 50 % of $x_1^2$ {} ~ 10⁻⁵".to_owned();
        let table = Table {
            caption: wild.clone(),
            heads: vec![wild.clone(), "x".into()],
            rows: vec![vec![wild, "1".into()]],
        };
        let markdown = table.markdown();
        let lines: Vec<&str> = markdown.lines().collect();
        assert_eq!(lines.len(), 5);
        assert!(lines[2].starts_with("| a\\|b") && lines[3] == "| :--- | ---: |", "{markdown}");
        let latex = table.latex("t");
        assert!(latex.contains("a\\textbar{}b\\textbackslash{}c \\& 50 \\% of \\$x\\_1\\textasciicircum{}2\\$ \\{\\} \\textasciitilde{} 10$^-$$^5$ & 1 \\\\\n"), "{latex}");
    }

    #[test]
    fn nothing_in_a_text_is_a_command_of_latex() {
        assert_eq!(
            tex("[x]* \"a\" <b>\u{1b}\n"),
            "{[}x]{*} \\char34{}a\\char34{} \\textless{}b\\textgreater{}\\textbackslash{}u001B\\textbackslash{}u000A"
        );
    }

    #[test]
    fn fields_are_quoted_where_they_must() {
        let fields = ["plain", "with, comma", "say \"so\""].map(str::to_owned);
        assert_eq!(csv_line(&fields), "plain,\"with, comma\",\"say \"\"so\"\"\"\r\n");
    }
}
