//! A scene in POV-Ray's language (3.7), so that an independent program can draw the same picture.
//!
//! POV-Ray's axes are left-handed: z is mirrored. It weakens ambient and diffuse light by the opacity of a surface,
//! which is undone.

use std::fmt::Write as _;

use anyhow::{Context as _, Result, bail, ensure};
use catoptric_scene::{
    BodyPart, Camera, Color, Falloff, Form, Light, Material, MaterialChoice, PatternSpace, Phong, Placement,
    Projection, Scene, Shadow, Shape, SolidKind, SolidTexture, Surroundings, VisibleSide,
};
use glam::{DAffine3, DVec3};

/// Where POV-Ray's laws of falloff begin; far nearer to a light than anything that it shows.
const TINY_DISTANCE: f64 = 0.001;
/// From our axes to POV-Ray's, and back.
const MIRROR: DVec3 = DVec3::new(1.0, 1.0, -1.0);

/// The scene as POV-Ray's source text.
///
/// # Errors
/// When the scene is not valid, or has what POV-Ray has not: a tint that is not the body's color, diffuse light on a
/// surface without opacity.
pub(crate) fn source(scene: &Scene) -> Result<String> {
    let problems = scene.check();
    ensure!(problems.is_empty(), "the scene is not valid: {problems:?}");
    let is_even = scene.environment.surroundings == Surroundings::Even;
    ensure!(is_even, "POV-Ray is asked for even surroundings only");
    let mut text = String::new();
    writeln!(text, "#version 3.7;")?;
    writeln!(
        text,
        "global_settings {{ assumed_gamma 1.0 max_trace_level {} adc_bailout {} ambient_light {} }}",
        scene.tracing.generations,
        scene.tracing.threshold,
        color(scene.environment.ambient)
    )?;
    writeln!(text, "{}", camera(&scene.camera))?;
    writeln!(text, "background {{ {} }}", color(scene.environment.background))?;
    for lamp in scene.lights.iter().filter(|lamp| !lamp.hidden) {
        writeln!(text, "{}", light(lamp))?;
    }
    for body in scene.bodies.iter().filter(|body| !body.hidden) {
        ensure!(body.shadow != Shadow::Full, "POV-Ray knows no full shadows of clear bodies");
        let object = object(scene, &body.form(), &body.material, false).map(|object| match body.shadow {
            Shadow::None => format!("object {{ {object} no_shadow }}"),
            Shadow::Filtered | Shadow::Full => object,
        });
        writeln!(text, "{}", object.with_context(|| format!("the body {:?}", body.name))?)?;
    }
    Ok(text)
}

fn camera(camera: &Camera) -> String {
    // As in docs/en/model.md.
    let backward = (camera.position - camera.target).normalize_or_zero();
    let right = camera.up.cross(backward).normalize_or_zero();
    let up = backward.cross(right);
    let [location, direction, right, up] = [camera.position, -backward, right, up].map(mirrored);
    match camera.projection {
        Projection::Perspective { fov_degrees } => {
            let distance = 0.5 / (fov_degrees.to_radians() / 2.0).tan();
            format!(
                "camera {{ perspective location {location} direction {direction}*{distance} \
                 right {right}*image_width/image_height up {up} }}"
            )
        }
        Projection::Parallel { height } => format!(
            "camera {{ orthographic location {location} direction {direction} \
             right {right}*image_width/image_height*{height} up {up}*{height} }}"
        ),
    }
}

/// POV-Ray's falloff is 2 / (1 + (d / f)ᵖ), f the `fade_distance` and p the `fade_power`.
fn light(light: &Light) -> String {
    let (factor, fade) = match light.falloff {
        Falloff::None => (1.0, None),
        Falloff::Linear { constant } => {
            let distance = constant.max(TINY_DISTANCE);
            (0.5 / distance, Some((distance, 1)))
        }
        Falloff::InverseSquare => (0.5 / TINY_DISTANCE.powi(2), Some((TINY_DISTANCE, 2))),
    };
    let [r, g, b] = light.color.to_array().map(|channel| channel * light.intensity * factor);
    let fade = fade.map(|(distance, power)| format!(" fade_distance {distance} fade_power {power}"));
    let color = color(Color::new(r, g, b));
    format!("light_source {{ {} {color}{} }}", mirrored(light.position), fade.unwrap_or_default())
}

/// A body or a part of one; `is_within` if it is a part of a union, an intersection or a difference. What is within a
/// transparent one belongs to the whole of it.
fn object(scene: &Scene, form: &Form<'_>, choice: &MaterialChoice, is_within: bool) -> Result<String> {
    let material = scene.material(choice).context("a material that the scene has not")?;
    let (texture, ior) = surface(material)?;
    if let Shape::Surface { side } = form.shape {
        return clipped(scene, form, side, choice);
    }
    // POV-Ray bends light only where there is an interior, whatever surface lets it in.
    let interior = if !is_within && lets_through(scene, form, choice) {
        format!(" interior {{ ior {ior} }}")
    } else {
        String::new()
    };
    let (word, is_joined) = match form.shape {
        // Surfaces within a body vanish, seen from inside as well.
        Shape::Union => ("merge", true),
        Shape::Group if is_within => ("merge", true),
        Shape::Group => ("union", false),
        Shape::Intersection => ("intersection", true),
        Shape::Difference => ("difference", true),
        _ => return Ok(format!("{} {} {texture}{interior} }}", shape(form), matrix(&form.placement))),
    };
    let part =
        |part: &BodyPart| object(scene, &part.form(), part.material.as_ref().unwrap_or(choice), is_joined);
    let parts: Vec<String> = form.parts.iter().map(part).collect::<Result<_>>()?;
    let interior = if is_joined { interior.as_str() } else { "" };
    Ok(format!("{word} {{ {} {}{interior} }}", parts.join(" "), matrix(&form.placement)))
}

/// The surface of the first part as far as it lies in the others, without interior. What is not seen is clear.
fn clipped(scene: &Scene, form: &Form<'_>, side: VisibleSide, choice: &MaterialChoice) -> Result<String> {
    let (first, others) = form.parts.split_first().context("a surface without parts")?;
    let form_of_first = first.form();
    let open = match form_of_first.shape {
        Shape::Cylinder { .. } | Shape::Cone { .. } => "open ",
        Shape::Paraboloid { .. } => bail!("POV-Ray is asked for no open paraboloid"),
        _ => "",
    };
    let material = scene.material(first.material.as_ref().unwrap_or(choice));
    let (texture, _) = surface(material.context("a material that the scene has not")?)?;
    let (seen, clear) =
        (format!("{{ {texture} }}"), "{ pigment { rgbt <1,1,1,1> } finish { ambient 0 diffuse 0 } }");
    let textures = match side {
        VisibleSide::Both => texture,
        VisibleSide::Outer => format!("texture {seen} interior_texture {clear}"),
        VisibleSide::Inner => format!("texture {clear} interior_texture {seen}"),
    };
    let first = format!("{} {open}{} }}", shape(&form_of_first), matrix(&form_of_first.placement));
    let cuts: Vec<String> = others.iter().map(|part| bare(&part.form())).collect();
    let cuts = match cuts.as_slice() {
        [] => String::new(),
        [only] => format!(" clipped_by {{ {only} }}"),
        several => format!(" clipped_by {{ intersection {{ {} }} }}", several.join(" ")),
    };
    Ok(format!("object {{ {first}{cuts} {} {textures} }}", matrix(&form.placement)))
}

/// A form without textures, as POV-Ray wants what clips.
fn bare(form: &Form<'_>) -> String {
    let word = match form.shape {
        Shape::Union | Shape::Group => "merge",
        Shape::Intersection => "intersection",
        Shape::Difference => "difference",
        _ => return format!("{} {} }}", shape(form), matrix(&form.placement)),
    };
    let parts: Vec<String> = form.parts.iter().map(|part| bare(&part.form())).collect();
    format!("{word} {{ {} {} }}", parts.join(" "), matrix(&form.placement))
}

/// Whether light goes through some surface of a body or of its parts.
fn lets_through(scene: &Scene, form: &Form<'_>, choice: &MaterialChoice) -> bool {
    scene.material(choice).is_some_and(|material| material.lets_through().most > 0.0)
        || form
            .parts
            .iter()
            .any(|part| lets_through(scene, &part.form(), part.material.as_ref().unwrap_or(choice)))
}

/// The beginning of a simple shape in its own frame.
fn shape(form: &Form<'_>) -> String {
    let height = form.sized_shape().height().unwrap_or_default();
    match form.shape {
        Shape::Sphere { radius } => format!("sphere {{ 0, {radius}"),
        Shape::Cube { size } => format!("box {{ {}, {}", vector(size / -2.0), vector(size / 2.0)),
        Shape::Cylinder { radius, .. } => format!("cylinder {{ 0, <0,{height},0>, {radius}"),
        Shape::Cone { radius, top_radius, .. } => {
            format!("cone {{ 0, {radius}, <0,{height},0>, {top_radius}")
        }
        Shape::Paraboloid { radius, .. } => {
            let (across, along) = (1.0 / (radius * radius), -1.0 / height);
            format!(
                "intersection {{ quadric {{ <{across},0,{across}>, 0, <0,{along},0>, 0 }} plane {{ y, {height} }} \
                 bounded_by {{ box {{ <-{radius},0,-{radius}>, <{radius},{height},{radius}> }} }}"
            )
        }
        Shape::Plane => "plane { y, 0".to_owned(),
        Shape::Union | Shape::Intersection | Shape::Difference | Shape::Surface { .. } | Shape::Group => {
            String::new()
        }
    }
}

/// The way from the body's frame to the world: the images of the three axes and of the origin, mirrored before and
/// after.
fn matrix(placement: &Placement) -> String {
    let world_from_body = placement.world_from_body();
    let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::NEG_Z].map(|axis| world_from_body.transform_vector3(axis));
    let rows = [x, y, z, world_from_body.translation].map(|row| numbers(row * MIRROR));
    format!("matrix <{}>", rows.join(","))
}

/// Pigment and finish, and the index of refraction inside.
fn surface(material: &Material) -> Result<(String, f64)> {
    let model = material.model().key();
    let phong = material.as_phong();
    let phong = phong.with_context(|| format!("POV-Ray is asked for Phong's model only, not for {model}"))?;
    let Phong { ref pattern, ambient, diffuse, specular, shininess, transmission, ior, .. } = *phong;
    ensure!(pattern.texture.is_none(), "POV-Ray is asked for bodies without textures only");
    ensure!(!phong.weighs_by_angle(), "POV-Ray does not know Schlick's formula");
    let opacity = 1.0 - transmission;
    ensure!(
        opacity > 0.0 || (ambient == 0.0 && diffuse == 0.0),
        "POV-Ray knows no ambient or diffuse light on a surface that lets all light through"
    );
    let [ambient, diffuse] = [ambient, diffuse].map(|part| if part == 0.0 { 0.0 } else { part / opacity });
    let pigment = match &pattern.solid {
        // The pattern is that of our axes.
        Some(solid) => solid_pigment(pattern.color, solid, DAffine3::from_scale(MIRROR), phong)?,
        None => pigment(pattern.color, phong)?,
    };
    let texture = format!(
        "pigment {{ {pigment} }} finish {{ ambient {ambient} diffuse {diffuse} phong {specular} \
         phong_size {shininess} reflection {{ rgb {} }} }}",
        phong.reflection()
    );
    Ok((texture, ior))
}

/// A pattern in the axes of the one around it, or of the world.
fn solid_pigment(
    first: Color,
    solid: &SolidTexture,
    own_from_outer: DAffine3,
    phong: &Phong,
) -> Result<String> {
    ensure!(solid.space == PatternSpace::World, "POV-Ray is asked for the world's patterns only");
    let cells = solid.placement().world_from_body() * DAffine3::from_scale(DVec3::splat(solid.size));
    let inner = |color: Color, inner: &Option<Box<SolidTexture>>| match inner {
        Some(inner) => solid_pigment(color, inner, cells.inverse(), phong),
        None => pigment(color, phong),
    };
    let [first, second] = [inner(first, &solid.first)?, inner(solid.color, &solid.second)?];
    let plain = SolidTexture { size: solid.size, ..SolidTexture::new(SolidKind::Checker, solid.color) };
    if *solid == plain && own_from_outer == DAffine3::from_scale(MIRROR) {
        return Ok(format!("checker {first} {second} scale {} scale <1,1,-1>", solid.size));
    }
    // A whole value would count as 0.
    let odd = |cell: &str| format!("function {{ 0.75*abs(mod(floor({cell}),2)) }}");
    let halves = format!("pigment_map {{ [0.5 {first}] [0.5 {second}] }}");
    let pattern = match solid.kind {
        SolidKind::Checker => format!("checker pigment {{ {first} }} pigment {{ {second} }}"),
        SolidKind::Stripes => format!("{} {halves}", odd("x+1e-6")),
        SolidKind::Rings => format!("{} {halves}", odd("sqrt(x*x+z*z)+1e-6")),
        SolidKind::Gradient => {
            format!("function {{ x-floor(x) }} pigment_map {{ [0 {first}] [1 {second}] }}")
        }
    };
    let DAffine3 { matrix3, translation } = own_from_outer * cells;
    let rows = [matrix3.x_axis, matrix3.y_axis, matrix3.z_axis, translation].map(numbers);
    Ok(format!("{pattern} matrix <{}>", rows.join(",")))
}

/// A color, and how much light it lets through: `rgbt` leaves that light as it is, `rgbf` gives it the color.
fn pigment(own: Color, phong: &Phong) -> Result<String> {
    let Phong { ambient, diffuse, transmission, tint, .. } = *phong;
    if transmission == 0.0 {
        return Ok(color(own));
    }
    let (key, Color { r, g, b }) = if tint == Color::WHITE {
        ("rgbt", own)
    } else if tint == own || (ambient == 0.0 && diffuse == 0.0) {
        ("rgbf", tint)
    } else {
        bail!("POV-Ray knows no tint other than the body's color");
    };
    Ok(format!("{key} <{r},{g},{b},{transmission}>"))
}

fn color(Color { r, g, b }: Color) -> String {
    format!("rgb <{r},{g},{b}>")
}

/// A point or direction of our world in POV-Ray's.
fn mirrored(point: DVec3) -> String {
    vector(point * MIRROR)
}

fn vector(vector: DVec3) -> String {
    format!("<{}>", numbers(vector))
}

fn numbers(vector: DVec3) -> String {
    // Adding zero turns -0 into 0.
    let [x, y, z] = vector.to_array().map(|value| value + 0.0);
    format!("{x},{y},{z}")
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use catoptric_picture::{Difference, read};
    use catoptric_scene::Body;
    use catoptric_store::load;

    use super::*;
    use crate::povray::{PovrayTask, trace};
    use xtask::root;

    fn reference(file: &str) -> PathBuf {
        root().join("tests/reference").join(file)
    }

    /// Words and numbers, without comments.
    fn tokens(text: &str) -> Vec<&str> {
        text.lines()
            .filter(|line| !line.starts_with("//"))
            .flat_map(|line| line.split(|c: char| c.is_whitespace() || "<>,*/{}".contains(c)))
            .filter(|token| !token.is_empty())
            .collect()
    }

    fn same(a: &str, b: &str) -> bool {
        match (a.parse::<f64>(), b.parse::<f64>()) {
            (Ok(a), Ok(b)) => (a - b).abs() <= 1e-8 * (1.0 + a.abs()),
            _ => a == b,
        }
    }

    #[test]
    fn says_what_the_files_written_by_hand_say() {
        for name in ["whitted", "four-bodies", "mirrors", "corridor"] {
            let scene = load(reference(&format!("{name}.toml"))).unwrap().scene;
            let written = source(&scene).unwrap();
            let stored = std::fs::read_to_string(reference(&format!("{name}.pov"))).unwrap();
            let (written, stored) = (tokens(&written), tokens(&stored));
            assert!(written.len() > 100);
            for (index, (a, b)) in written.iter().zip(&stored).enumerate() {
                assert!(same(a, b), "{name}, word {index}: {a} instead of {b}");
            }
            assert_eq!(written.len(), stored.len(), "{name}");
        }
    }

    #[test]
    fn lights_weaken_by_their_laws() {
        let at = |falloff| light(&Light { falloff, color: Color::WHITE, intensity: 4.0, ..Light::default() });
        let begin = "light_source { <-5,8,-6> rgb";
        assert_eq!(at(Falloff::None), format!("{begin} <4,4,4> }}"));
        let linear = at(Falloff::Linear { constant: 2.0 });
        assert_eq!(linear, format!("{begin} <1,1,1> fade_distance 2 fade_power 1 }}"));
        let square = at(Falloff::InverseSquare);
        assert_eq!(square, format!("{begin} <2000000,2000000,2000000> fade_distance 0.001 fade_power 2 }}"));
    }

    #[test]
    fn what_is_hidden_is_left_out() {
        let body = Body { hidden: true, ..Body::default() };
        let lamp = Light { hidden: true, ..Light::default() };
        let mut scene = Scene { bodies: vec![body].into(), lights: vec![lamp], ..Scene::default() };
        assert_eq!(source(&scene).unwrap().lines().count(), 4);
        scene.bodies[0].hidden = false;
        scene.lights[0].hidden = false;
        assert_eq!(source(&scene).unwrap().lines().count(), 6);
    }

    #[test]
    fn bodies_of_parts_are_those_of_povray() {
        let part = |shape| BodyPart { shape, ..BodyPart::default() };
        let inner = BodyPart { parts: vec![part(Shape::CUBE), part(Shape::Plane)], ..part(Shape::Group) };
        let mut parts = vec![part(Shape::SPHERE), inner];
        let glass = Phong { transmission: 0.9, ior: 1.5, ..Phong::default() };
        let words = |parts: &[BodyPart], shape, material: Phong| {
            let body = Body {
                shape,
                parts: parts.to_vec(),
                material: MaterialChoice::own(material),
                ..Body::default()
            };
            let said = source(&Scene { bodies: vec![body].into(), ..Scene::default() }).unwrap();
            let said = said.lines().last().unwrap().to_owned();
            let known = ["union", "merge", "intersection", "difference", "sphere", "box", "plane", "ior"];
            tokens(&said).into_iter().filter(|word| known.contains(word)).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(words(&parts, Shape::Difference, Phong::default()), "difference sphere merge box plane");
        assert_eq!(
            words(&parts, Shape::Intersection, glass.clone()),
            "intersection sphere merge box plane ior"
        );
        assert_eq!(words(&parts, Shape::Union, glass.clone()), "merge sphere merge box plane ior");
        assert_eq!(words(&parts, Shape::Group, glass.clone()), "union sphere ior union box ior plane ior");
        parts[0].material = Some(MaterialChoice::own(glass));
        assert_eq!(words(&parts, Shape::Union, Phong::default()), "merge sphere merge box plane ior");
    }

    #[test]
    fn surfaces_are_open_and_clipped() {
        let part = |shape| BodyPart { shape, ..BodyPart::default() };
        let said = |parts: &[BodyPart]| {
            let body = Body { shape: Shape::SURFACE, parts: parts.to_vec(), ..Body::default() };
            let said = source(&Scene { bodies: vec![body].into(), ..Scene::default() });
            let said = said.map(|said| said.lines().last().unwrap().to_owned());
            let known =
                ["object", "open", "clipped_by", "intersection", "cylinder", "box", "sphere", "plane"];
            said.map(|said| {
                tokens(&said).into_iter().filter(|word| known.contains(word)).collect::<Vec<_>>().join(" ")
            })
        };
        let [pipe, block, ball] = [Shape::CYLINDER, Shape::CUBE, Shape::SPHERE].map(part);
        assert_eq!(said(std::slice::from_ref(&pipe)).unwrap(), "object cylinder open");
        assert_eq!(said(&[pipe, block.clone()]).unwrap(), "object cylinder open clipped_by box");
        assert_eq!(
            said(&[part(Shape::Plane), block, ball]).unwrap(),
            "object plane clipped_by intersection box sphere"
        );
        assert!(said(&[part(Shape::PARABOLOID)]).is_err());
    }

    #[test]
    fn what_povray_cannot_say_is_refused() {
        let red = Color::new(1.0, 0.0, 0.0);
        let glass = Phong { transmission: 0.75, diffuse: 0.2, ambient: 0.0, ..Phong::default() };
        let surface = |phong: &Phong| surface(&phong.clone().into()).map(|(texture, _)| texture);
        let said = surface(&glass).unwrap();
        assert!(said.contains("rgbt <0.8,0.8,0.8,0.75>") && said.contains("diffuse 0.8 "), "{said}");
        let said = surface(&Phong { pattern: red.into(), tint: red, ..glass.clone() }).unwrap();
        assert!(said.contains("rgbf <1,0,0,0.75>"), "{said}");
        assert!(surface(&Phong { tint: red, ..glass.clone() }).is_err());
        assert!(surface(&Phong { transmission: 1.0, ..glass.clone() }).is_err());
        let clear = Phong { transmission: 1.0, diffuse: 0.0, ..glass };
        assert!(surface(&clear).is_ok());
        let scene = Scene {
            bodies: [Body { material: MaterialChoice::Named("none".to_owned()), ..Body::default() }]
                .into_iter()
                .collect(),
            ..Scene::default()
        };
        assert!(source(&scene).is_err());
    }

    #[test]
    #[ignore = "needs POV-Ray"]
    fn povray_draws_the_stored_pictures() {
        let folder = root().join("target/bench/stored");
        std::fs::create_dir_all(&folder).unwrap();
        let mut checked = 0;
        for entry in std::fs::read_dir(reference("")).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_none_or(|extension| extension != "toml") {
                continue;
            }
            let name = path.file_stem().unwrap().to_string_lossy();
            let [pov, output] = ["pov", "exr"].map(|ending| folder.join(format!("{name}.{ending}")));
            // What was written by hand may say it in a way that POV-Ray draws better.
            match std::fs::read(path.with_extension("pov")) {
                Ok(by_hand) => std::fs::write(&pov, by_hand).unwrap(),
                Err(_) => std::fs::write(&pov, source(&load(&path).unwrap().scene).unwrap()).unwrap(),
            }
            trace(&pov, &PovrayTask { output: &output, width: 320, height: 180, threads: 2 }).unwrap();
            let stored = read(&path.with_extension("exr")).unwrap();
            let difference = Difference::between(&read(&output).unwrap(), &stored).unwrap();
            println!("{name}: {} pixels differ", difference.above);
            assert!(difference.share_above <= 0.001, "{name}");
            checked += 1;
        }
        assert!(checked >= 14);
    }
}
