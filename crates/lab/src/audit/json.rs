//! The audit as JSON.

use catoptric_tracer::{BranchOutcome, BranchRecord, LightTerm, ShadowRecord, SurfaceRecord};
use serde_json::{Value, json};

use super::{Audit, Node, Proof, RayTree};

impl Audit {
    /// The audit as JSON. The keys are those of the document of the command line and stay as they are; others may be
    /// added. Single-precision numbers are written as the double-precision ones that equal them.
    pub fn to_json(&self) -> Value {
        let trees: Vec<Value> = self.trees.iter().map(|tree| self.tree(tree)).collect();
        let proof = match self.proof {
            Proof::AnyOrder => "any-order",
            Proof::Rendered { is_same: true } => "rendered",
            Proof::Rendered { is_same: false } => "rendered-last-bit",
            Proof::Incomplete => "incomplete",
        };
        json!({
            "pixel": self.pixel.to_array(),
            "width": self.picture.width,
            "height": self.picture.height,
            "samples": self.picture.samples,
            "generations": self.generations,
            "threshold": self.threshold,
            "light": self.light,
            "sum": self.sum.to_array(),
            "proof": proof,
            "trees": trees,
        })
    }

    fn tree(&self, tree: &RayTree) -> Value {
        let rays: Vec<Value> = tree.nodes.iter().map(|node| self.ray(node)).collect();
        json!({
            "sample": tree.sample,
            "offset": tree.offset.to_array(),
            "sum": tree.sum().to_array(),
            "light": tree.light.to_array(),
            "left_out": tree.left_out,
            "rays": rays,
        })
    }

    /// One ray with all its numbers.
    fn ray(&self, node: &Node) -> Value {
        let ray = &node.ray;
        let media: Vec<Value> = ray.media.iter().map(|&body| self.body(body)).collect();
        json!({
            "kind": node.kind.key(),
            "parent": ray.parent,
            "children": node.children,
            "generation": ray.generation,
            "wavelength_nanometers": ray.wavelength,
            "coefficient": node.coefficient.to_array(),
            "density_per_steradian": ray.density,
            "weight": ray.weight.to_array(),
            "through": ray.through.to_array(),
            "origin": ray.origin.to_array().map(number),
            "direction": ray.ray.direction.to_array(),
            "media": media,
            "ior": ray.ior,
            "hit": ray.hit.map(|hit| json!({
                "body": self.body(hit.body),
                "part": self.names.part(hit.body, hit.part),
                "distance": ray.distance(),
                "leaving": hit.from_within,
                "position": hit.position.to_array().map(number),
                "normal": hit.normal.to_array(),
                "incidence_degrees": node.incidence.map(f64::to_degrees),
                "refraction_degrees": node.refraction.map(f64::to_degrees),
            })),
            "answer": node.answer().map(|answer| self.answer(answer)),
            "local": ray.local.to_array(),
            "light": ray.light.to_array(),
            "brings": node.brings.to_array(),
            "radiance": node.radiance.to_array(),
        })
    }

    fn answer(&self, answer: &SurfaceRecord) -> Value {
        let lights: Vec<Value> = answer.lights.iter().map(|light| self.light(light)).collect();
        json!({
            "law": answer.law.key(),
            "alpha": answer.alpha,
            "color": answer.color.to_array(),
            "odd_cell": answer.second_share == Some(1.0),
            "second_share": answer.second_share,
            "k_a": answer.ambient_coefficient,
            "k_d": answer.diffuse_coefficient,
            "k_s": answer.specular_coefficient,
            "n": answer.shininess,
            "ambient_light": answer.ambient_light.to_array(),
            "ambient": answer.ambient.to_array(),
            "lights": lights,
            "interface": answer.interface.map(|interface| json!({
                "ior_beyond": interface.ior_beyond,
                "ratio": interface.ratio,
                "total_reflection": interface.is_total,
                "cemented": interface.contact.map(|contact| json!({
                    "from": self.body(contact.bodies[0]),
                    "to": self.body(contact.bodies[1]),
                    "seamless": contact.is_seamless,
                })),
            })),
            "reflected": branch(&answer.reflected),
            "refracted": branch(&answer.refracted),
        })
    }

    fn light(&self, light: &LightTerm) -> Value {
        json!({
            "light": light.light,
            "name": self.names.light(light.light),
            "direction": light.direction.to_array(),
            "distance": light.distance,
            "cosine": light.cosine,
            "shadow": light.shadow.as_ref().map(|shadow| self.shadow(shadow)),
            "answer": light.answer.map(|answer| json!({
                "power": answer.power.to_array(),
                "diffuse": answer.diffuse.to_array(),
                "highlight_cosine": answer.highlight_cosine,
                "highlight": answer.highlight,
                "glints": answer.glints.to_array(),
                "light": answer.light.to_array(),
            })),
        })
    }

    fn shadow(&self, shadow: &ShadowRecord) -> Value {
        let crossings: Vec<Value> = shadow
            .crossings
            .iter()
            .map(|crossing| {
                json!({
                    "body": self.body(crossing.body),
                    "part": self.names.part(crossing.body, crossing.part),
                    "distance": crossing.distance,
                    "leaving": crossing.leaving,
                    "filter": crossing.filter.map(|filter| filter.to_array()),
                    "into": crossing.into.map(|body| self.body(body)),
                })
            })
            .collect();
        json!({
            "passed": shadow.passed.to_array(),
            "crossings": crossings,
            "through": shadow.through.to_array(),
        })
    }

    fn body(&self, body: usize) -> Value {
        json!({ "index": body, "name": self.names.body(body) })
    }
}

fn branch(branch: &BranchRecord) -> Value {
    let (fate, ray) = match branch.fate {
        BranchOutcome::Followed(ray) => ("followed", Some(ray)),
        BranchOutcome::Nothing => ("nothing", None),
        BranchOutcome::TotalReflection => ("total-reflection", None),
        BranchOutcome::GenerationLimit => ("generation-limit", None),
        BranchOutcome::Threshold => ("threshold", None),
        BranchOutcome::LeftOut => ("left-out", None),
    };
    json!({
        "coefficient": branch.coefficient.to_array(),
        "weight": branch.weight.to_array(),
        "fate": fate,
        "ray": ray,
    })
}

/// A number with as many digits as single precision needs, if it fits that.
fn number(number: f64) -> Value {
    let single = number as f32;
    if f64::from(single) == number { json!(single) } else { json!(number) }
}
