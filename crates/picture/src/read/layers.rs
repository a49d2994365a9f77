//! The layers of an EXR, and which of them is the picture.

use exr::meta::attribute::ChannelDescription;
use exr::meta::header::Header;

use super::DecodeError;

/// The places of red, green and blue in the part's list of channels.
pub(super) type ChannelIndices = [usize; 3];

/// A layer: channels of one part whose names have a common beginning.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Layer {
    /// The name up to the last dot, with the part's name where there are several parts; empty if it has none.
    name: String,
    kind: LayerKind,
    /// The place of its part in the file.
    pub(super) part: usize,
    pub(super) columns: ChannelIndices,
}

/// The kind of a layer's channels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum LayerKind {
    /// R, G and B.
    Color,
    /// Y, which is luminance.
    Gray,
    /// X, Y and Z, or one channel of any name: numbers that are read only when the layer is named.
    Data,
}

/// The most names of layers that an error lists.
const LISTED: usize = 20;

/// The names that programs give to the finished picture, in the order of preference: Blender, Arnold and V-Ray, Nuke,
/// and others. Compared without case with what follows the last dot.
const MAIN: [&str; 6] = ["combined", "composite", "beauty", "rgba", "rgb", "color"];

/// The layer of this name; without a name, the picture itself: the unnamed layer, or else the one called `Combined` or
/// as in [`MAIN`], or else the only one in color, or else the only one in gray.
///
/// # Errors
/// Names the layers when none or several fit.
pub(super) fn choose(parts: &[Header], name: Option<&str>) -> Result<Layer, DecodeError> {
    let layers = layers(parts);
    match name {
        Some(name) => named(&layers, name),
        None if layers.iter().all(|layer| layer.kind == LayerKind::Data) => Err(no_colors(parts)),
        None => main(&layers),
    }
    .cloned()
}

fn no_colors(parts: &[Header]) -> DecodeError {
    let names = parts.iter().flat_map(|part| &part.channels.list).take(LISTED).map(|c| c.name.to_string());
    let names = names.collect::<Vec<_>>().join(", ");
    DecodeError::Unsupported {
        reason: format!("the EXR picture has neither the channels R, G, B nor Y alone, but: {names}"),
    }
}

/// The layer of this name: exactly, or else the only one that ends so, without case.
fn named<'a>(layers: &'a [Layer], name: &str) -> Result<&'a Layer, DecodeError> {
    let wanted = name.to_lowercase();
    let ends_so = |layer: &&Layer| {
        let own = layer.name.to_lowercase();
        own.strip_suffix(&wanted).is_some_and(|before| before.is_empty() || before.ends_with('.'))
    };
    layers
        .iter()
        .find(|layer| layer.name == name)
        .or_else(|| only(layers.iter().filter(ends_so)))
        .ok_or_else(|| DecodeError::NoSuchLayer { layer: name.to_owned(), layers: names(layers.iter()) })
}

/// The layer that is the picture.
fn main(layers: &[Layer]) -> Result<&Layer, DecodeError> {
    let of_kind = |kind| layers.iter().filter(move |layer| layer.kind == kind);
    let called = |layer: &Layer, name: &str| {
        layer.name.rsplit('.').next().is_some_and(|last| last.eq_ignore_ascii_case(name))
    };
    let unnamed = of_kind(LayerKind::Color).find(|layer| layer.name.is_empty());
    let known = || {
        let best = MAIN.iter().find(|name| of_kind(LayerKind::Color).any(|layer| called(layer, name)))?;
        only(of_kind(LayerKind::Color).filter(|layer| called(layer, best)))
    };
    if let Some(layer) = unnamed.or_else(known).or_else(|| only(of_kind(LayerKind::Color))) {
        return Ok(layer);
    }
    let gray = || {
        of_kind(LayerKind::Gray)
            .find(|layer| layer.name.is_empty())
            .or_else(|| only(of_kind(LayerKind::Gray)))
    };
    let is_colorless = of_kind(LayerKind::Color).next().is_none();
    is_colorless.then(gray).flatten().ok_or_else(|| DecodeError::ManyLayers { layers: names(layers.iter()) })
}

fn only<'a>(mut layers: impl Iterator<Item = &'a Layer>) -> Option<&'a Layer> {
    layers.next().filter(|_| layers.next().is_none())
}

fn names<'a>(layers: impl Iterator<Item = &'a Layer>) -> Vec<String> {
    layers.filter(|layer| !layer.name.is_empty()).take(LISTED).map(|layer| layer.name.clone()).collect()
}

/// All layers of the parts that are not deep, in the order of the file.
fn layers(parts: &[Header]) -> Vec<Layer> {
    let mut layers = Vec::new();
    for (part, header) in parts.iter().enumerate().filter(|(_, header)| !header.deep) {
        let own = header.own_attributes.layer_name.as_ref().filter(|_| parts.len() > 1);
        let own = own.map(ToString::to_string).unwrap_or_default();
        for (prefix, channels) in groups(&header.channels.list) {
            let Some((kind, columns)) = kind_of(&channels) else { continue };
            layers.push(Layer { name: whole_name(&own, &prefix), kind, part, columns });
        }
    }
    layers
}

/// The name of a layer within a part; some programs repeat the part's name in the channels.
fn whole_name(part: &str, prefix: &str) -> String {
    let repeats = prefix.strip_prefix(part).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
    match (part.is_empty() || repeats, prefix.is_empty()) {
        (true, _) => prefix.to_owned(),
        (false, true) => part.to_owned(),
        (false, false) => format!("{part}.{prefix}"),
    }
}

/// The channels by what stands before the last dot of their names: the last part of each name, and its place.
fn groups(channels: &[ChannelDescription]) -> Vec<(String, Vec<(String, usize)>)> {
    let mut groups: Vec<(String, Vec<(String, usize)>)> = Vec::new();
    let mut places = std::collections::HashMap::new();
    for (place, channel) in channels.iter().enumerate() {
        let name = channel.name.to_string();
        let (prefix, last) = name.rsplit_once('.').unwrap_or(("", &name));
        let group = *places.entry(prefix.to_owned()).or_insert_with(|| {
            groups.push((prefix.to_owned(), Vec::new()));
            groups.len() - 1
        });
        if let Some((_, group)) = groups.get_mut(group) {
            group.push((last.to_owned(), place));
        }
    }
    groups
}

/// What the channels of a group are; `None` if they are no picture.
fn kind_of(channels: &[(String, usize)]) -> Option<(LayerKind, ChannelIndices)> {
    let place = |name: &str| channels.iter().find(|channel| channel.0 == name).map(|channel| channel.1);
    let three = |[a, b, c]: [&str; 3]| Some([place(a)?, place(b)?, place(c)?]);
    if let Some(columns) = three(["R", "G", "B"]) {
        return Some((LayerKind::Color, columns));
    }
    if let Some(columns) = three(["X", "Y", "Z"]) {
        return Some((LayerKind::Data, columns));
    }
    // Chroma channels say that Y is only a part of the color.
    let is_gray = place("RY").or(place("BY")).is_none();
    match (place("Y"), channels) {
        (Some(luminance), _) if is_gray => Some((LayerKind::Gray, [luminance; 3])),
        (None, [(_, only)]) => Some((LayerKind::Data, [*only; 3])),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use exr::meta::attribute::{SampleType, Text};

    /// A part with these channels.
    fn part(name: Option<&str>, channels: &[&str]) -> Header {
        let list = channels.iter().map(|name| ChannelDescription::named(*name, SampleType::F16));
        let mut header = Header::new(Text::from("x"), (2, 2), list.collect());
        header.own_attributes.layer_name = name.map(Text::from);
        header
    }

    fn chosen(parts: &[Header], name: Option<&str>) -> Result<String, String> {
        choose(parts, name).map(|layer| layer.name).map_err(|error| error.to_string())
    }

    fn rgb(layers: &[&str]) -> Vec<String> {
        layers.iter().flat_map(|layer| ["B", "G", "R"].map(|letter| format!("{layer}.{letter}"))).collect()
    }

    fn of_layers(layers: &[&str]) -> [Header; 1] {
        let names = rgb(layers);
        [part(Some("ignored"), &names.iter().map(String::as_str).collect::<Vec<_>>())]
    }

    #[test]
    fn the_picture_itself_comes_before_its_layers_in_any_order() {
        for (layers, expected) in [
            (vec!["ViewLayer.AO", "ViewLayer.Combined"], "ViewLayer.Combined"),
            (vec!["ViewLayer.Combined", "ViewLayer.Diffuse"], "ViewLayer.Combined"),
            (vec!["AO", "COMBINED", "Z"], "COMBINED"),
            (vec!["albedo", "Beauty", "rgba"], "Beauty"),
            (vec!["diffuse", "RGBA"], "RGBA"),
            (vec!["glass"], "glass"),
        ] {
            assert_eq!(chosen(&of_layers(&layers), None).as_deref(), Ok(expected), "{layers:?}");
        }
        let unnamed =
            [part(None, &["AO.B", "AO.G", "AO.R", "B", "G", "R", "Combined.B", "Combined.G", "Combined.R"])];
        assert_eq!(chosen(&unnamed, None).as_deref(), Ok(""));
    }

    #[test]
    fn what_is_open_is_an_error_that_names_the_layers() {
        for layers in [vec!["AO", "Diffuse"], vec!["A.Combined", "B.Combined"], vec!["left.x", "right.x"]] {
            let error = chosen(&of_layers(&layers), None).unwrap_err();
            assert!(layers.iter().all(|layer| error.contains(layer)), "{error}");
        }
        let error = chosen(&of_layers(&["AO", "Combined"]), Some("Glossy")).unwrap_err();
        assert!(error.contains("`Glossy`") && error.contains("AO, Combined"), "{error}");
        let none = chosen(&[part(None, &["B", "G", "R"])], Some("AO")).unwrap_err();
        assert!(none.contains("no named layers"), "{none}");
    }

    #[test]
    fn a_layer_is_named_wholly_or_by_its_end() {
        let parts = of_layers(&["ViewLayer.AO", "ViewLayer.Combined", "Other.Combined"]);
        assert_eq!(chosen(&parts, Some("ViewLayer.AO")).as_deref(), Ok("ViewLayer.AO"));
        assert_eq!(chosen(&parts, Some("ao")).as_deref(), Ok("ViewLayer.AO"));
        assert_eq!(chosen(&parts, Some("other.combined")).as_deref(), Ok("Other.Combined"));
        assert!(chosen(&parts, Some("Combined")).is_err(), "two end so");
        assert!(chosen(&parts, Some("mbined")).is_err(), "half a name is none");
        let data = [part(None, &["B", "G", "R", "Depth.Z", "Normal.X", "Normal.Y", "Normal.Z"])];
        assert_eq!(choose(&data, Some("Depth")).unwrap().columns, [3; 3]);
        assert_eq!(choose(&data, Some("Normal")).unwrap().columns, [4, 5, 6]);
    }

    #[test]
    fn parts_are_layers_too() {
        let parts = [
            part(Some("ao"), &["B", "G", "R"]),
            part(Some("depth"), &["Z"]),
            part(Some("beauty"), &["beauty.B", "beauty.G", "beauty.R"]),
        ];
        assert_eq!(
            choose(&parts, None).map(|layer| (layer.part, layer.name)).unwrap(),
            (2, "beauty".to_owned())
        );
        assert_eq!(choose(&parts, Some("ao")).unwrap().part, 0);
        assert_eq!(choose(&parts, Some("depth")).unwrap().part, 1);
        let gray = [part(Some("a"), &["Z"]), part(Some("b"), &["Y"])];
        assert_eq!(chosen(&gray, None).as_deref(), Ok("b"));
    }
}
