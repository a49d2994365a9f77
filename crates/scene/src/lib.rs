#![doc = include_str!("../README.md")]

mod body;
pub mod bounds;
mod camera;
mod color;
mod compound;
mod contact;
mod environment;
mod examples;
pub mod format;
mod frame;
mod image;
mod instances;
mod keyed;
mod language;
mod light;
mod list;
mod material;
mod part;
mod placement;
mod scene_images;
mod shape;
mod text;
mod touching;

pub use body::{Body, Shadow};
pub use camera::{Camera, Projection};
pub use color::Color;
pub use compound::{
    BodyPart, BodyShape, Bowl, Disc, DishDepth, DishProfile, Expansion, Form, Instance, Lens, LensCurvature,
    MirrorDish, OpenCone, OpenCylinder, ParametricShape, Prism, Rectangle, Ring, SimplePart, Triangle, Tube,
    Wedge,
};
pub use contact::{BodyContact, Contact};
pub use environment::{Environment, Sky, Surroundings};
pub use examples::Example;
pub use format::{
    AddressCompletion, AddressError, Diagnostic, Diagnostics, Document, LONGEST_TEXT, LoadedScene, Number,
    ParsedScene, Phrase, Problem, Related, SceneEdit, SceneKey, ScenePath, SceneValue, Sentence, Severity,
    Warned, decode, json_schema, nearest, read, read_bytes, update, write, write_fragment,
};
pub use frame::rotation_degrees;
pub use image::{Image, ImageError, ImageFault, ImageSource, NoResources, Resources, UnreadableKind};
pub use language::Language;
pub use light::{Falloff, Light};
pub use list::{CountedIter, List, ListIter, ListIterMut, ListSlices};
pub use material::{
    Attenuation, Coated, Conductor, Dielectric, FresnelTerm, Material, MaterialChoice, Matte, MetalOptics,
    Mirror, Model, NamedMaterial, Pattern, PatternSpace, Phong, RefractiveIndex, Share, SolidKind,
    SolidTexture, ThinDielectric,
};
pub use part::ScenePart;
pub use placement::{Anchor, Placement};
pub use scene_images::HasImages;
pub use shape::{ParaboloidDepth, Shape, ShapeKind, VisibleSide};
pub use text::{is_active, quoted_name, visible, visible_lines};

/// A whole scene: everything that decides what a picture shows, except its size.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Where the picture is taken from.
    pub camera: Camera,
    /// What surrounds the bodies.
    pub environment: Environment,
    /// How far rays are followed.
    pub tracing: Tracing,
    /// Materials that bodies share by name, in the order of the file.
    pub materials: Vec<NamedMaterial>,
    /// Point lights, in the order of the file.
    pub lights: Vec<Light>,
    /// Bodies, in the order of the file.
    pub bodies: List<Body>,
}

impl Scene {
    /// The material that `choice` stands for, or `None` when it names one that the scene does not define.
    pub fn material<'a>(&'a self, choice: &'a MaterialChoice) -> Option<&'a Material> {
        match choice {
            MaterialChoice::Inline(material) => Some(material),
            MaterialChoice::Named(name) => {
                self.materials.iter().find(|named| named.name == *name).map(|named| &named.material)
            }
        }
    }
}

/// The limits of tracing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tracing {
    /// Generations of rays, the primary ray being the first; 1 to 64. Default 6.
    pub generations: u32,
    /// A ray whose weight is below this is not traced; 0 (the default) follows every ray that carries anything.
    pub threshold: f64,
}

impl Tracing {
    /// The largest number of generations.
    pub const MAX_GENERATIONS: u32 = 64;
}

impl Default for Tracing {
    fn default() -> Self {
        Self { generations: 6, threshold: 0.0 }
    }
}
