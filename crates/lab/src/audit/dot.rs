//! The tree in the language of Graphviz.

use std::fmt::Write as _;

use catoptric_scene::visible;

use super::drawing::{self, RayDiagram};
use super::numbers::{exact_color, short_color};
use super::{Audit, RayTree};

impl Audit {
    /// The trees as a graph for Graphviz' `dot`: a node for each ray, colored by kind, edges as wide as the weight.
    /// Rays more than `depth` steps from the eye are left out if that is given.
    pub fn to_dot(&self, depth: Option<usize>) -> String {
        let mut text = String::from("digraph audit {\n");
        let [red, green, blue] = self.light;
        let left_out: usize = self.trees.iter().map(|tree| tree.left_out).sum();
        let note = if left_out > 0 { format!("\\nbranches left out: {left_out}") } else { String::new() };
        let _ = writeln!(
            text,
            "  label=\"Pixel {},{} of {}x{}: {red} {green} {blue}{note}\";",
            self.pixel.x, self.pixel.y, self.picture.width, self.picture.height
        );
        text.push_str("  labelloc=t; rankdir=LR; fontname=\"sans-serif\";\n");
        text.push_str(
            "  node [shape=box style=\"rounded,filled\" fillcolor=white fontname=\"sans-serif\"];\n",
        );
        text.push_str("  edge [fontname=\"sans-serif\" fontsize=10];\n");
        for tree in &self.trees {
            self.write_tree(&mut text, tree, depth);
        }
        text + "}\n"
    }

    fn write_tree(&self, text: &mut String, tree: &RayTree, depth: Option<usize>) {
        let name = |place: usize| format!("s{}r{}", tree.sample + 1, place + 1);
        let RayDiagram { places, hidden } = RayDiagram::of(tree, depth, usize::MAX);
        for place in places {
            let Some(node) = tree.nodes.get(place) else { continue };
            let color = drawing::color(node.kind);
            let body = label(&drawing::end_of(self, node));
            let _ = writeln!(
                text,
                "  {} [label=\"{} {}\\n{body}\\nbrings {}\" color=\"{color}\"];",
                name(place),
                place + 1,
                node.kind.key(),
                short_color(node.brings)
            );
            if let Some(parent) = node.ray.parent {
                let _ = writeln!(
                    text,
                    "  {} -> {} [label=\"× {}\" color=\"{color}\" penwidth={:.2}];",
                    name(parent),
                    name(place),
                    exact_color(node.coefficient),
                    drawing::line_width(node)
                );
            }
        }
        if hidden > 0 {
            let _ =
                writeln!(text, "  {} [label=\"{hidden} more rays\" shape=plaintext];", name(usize::MAX - 1));
        }
    }
}

/// Text within the quotes of a label, where Graphviz reads escape sequences and the entities of HTML.
fn label(text: &str) -> String {
    visible(text).replace('&', "&amp;").replace('\\', "\\\\").replace('"', "\\\"")
}

#[cfg(test)]
mod tests {
    use super::label;

    #[test]
    fn nothing_in_a_label_is_a_command() {
        assert_eq!(label("a\\N\"b\" &#27;\n"), "a\\\\N\\\"b\\\" &amp;#27;\\\\u000A");
    }
}
