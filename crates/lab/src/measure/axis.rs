//! What a sweep varies, and over which values.

use std::fmt;

use catoptric_scene::format::keys;
use catoptric_scene::format::spec::{KeySpec, Kind, Limits};
use catoptric_scene::{AddressError, Language, ScenePath};
use catoptric_tracer::raster::Method;

use super::parameter::{Parameter, Value};

/// The most points of a sweep.
pub(super) const MOST_POINTS: usize = 10_000;

/// The longest range of a key that is swept as a whole if nothing is said.
const SHORT_RANGE: f64 = 10.0;

/// What a sweep varies.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Variable {
    /// A parameter of drawing.
    Parameter(Parameter),
    /// A value of the scene, by its address.
    Setting(ScenePath),
}

/// What is varied and its values, at least one.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What is varied.
    pub variable: Variable,
    /// The values, in the order in which they are shown.
    pub values: Vec<Value>,
}

/// The reason why a text is no [`Axis`].
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AxisError {
    /// There is no such parameter.
    #[error(
        "cannot vary \"{name}\"; there are {}, and addresses of values such as camera.fov",
        Parameter::ALL.map(Parameter::key).join(", ")
    )]
    Parameter {
        /// What was written.
        name: String,
    },
    /// A value makes no sense for what is varied.
    #[error("{variable} cannot be \"{value}\": {expected}")]
    Value {
        /// What is varied.
        variable: Variable,
        /// What was written.
        value: String,
        /// What can be written, or what is wrong.
        expected: String,
    },
    /// One parameter, or two.
    #[error("vary one parameter or two, not {0}")]
    Number(usize),
    /// One thing is named twice.
    #[error("{0} is varied twice; name each parameter once")]
    Twice(Variable),
    /// A text is not the address of a value.
    #[error(transparent)]
    Address(#[from] AddressError),
}

impl From<Parameter> for Variable {
    fn from(parameter: Parameter) -> Self {
        Self::Parameter(parameter)
    }
}

impl fmt::Display for Variable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Parameter(parameter) => parameter.fmt(f),
            Self::Setting(path) => path.fmt(f),
        }
    }
}

impl Variable {
    /// What `word` names, and what stands after the `=` behind it; `None` if it names nothing that can be varied.
    fn split(word: &str) -> Result<Option<(Self, Option<&str>)>, AddressError> {
        let (key, value) = word.split_once('=').map_or((word, None), |(key, value)| (key, Some(value)));
        if let Some(parameter) = Parameter::find(key.trim()) {
            return Ok(Some((parameter.into(), value)));
        }
        match word.split_once('.') {
            Some((root, _)) if keys::ROOT.key(root).is_some() => {
                let (path, rest) = ScenePath::split(word)?;
                Ok(Some((Self::Setting(path), rest.strip_prefix('='))))
            }
            _ => Ok(None),
        }
    }

    /// Reads a value, or a range of them.
    fn values(&self, text: &str) -> Result<Vec<Value>, AxisError> {
        let wrong = |expected| AxisError::Value { variable: self.clone(), value: text.to_owned(), expected };
        if let Self::Parameter(parameter) = self {
            return Ok(vec![parameter.value(text).map_err(wrong)?]);
        }
        match text.split_once("..").and_then(|(from, to)| Some((from.trim().parse().ok()?, to))) {
            Some((from, to)) => read_range(from, to)
                .map(|numbers| numbers.into_iter().map(|number| Value::Setting(number.into())).collect())
                .ok_or_else(|| wrong("give a range as FROM..TO:COUNT, such as 0.1..1:10".to_owned())),
            None => Ok(vec![Value::Setting(text.parse()?)]),
        }
    }

    /// The values when none are given; none for values of the scene.
    fn usual_values(&self, threads: usize) -> Vec<Value> {
        match self {
            Self::Parameter(parameter) => parameter.usual_values(threads),
            Self::Setting(_) => Vec::new(),
        }
    }
}

/// The numbers of a range; `to` is followed by a colon and their number.
fn read_range(from: f64, to: &str) -> Option<Vec<f64>> {
    let (to, count) = to.split_once(':')?;
    evenly([from, to.trim().parse().ok()?], count.trim().parse().ok()?)
}

/// Numbers at equal distances, the ends of the range included; `None` where an end is no number, or for fewer than two
/// numbers or too many.
fn evenly([from, to]: [f64; 2], count: usize) -> Option<Vec<f64>> {
    let at = |step: usize| match step {
        0 => from,
        step if step + 1 == count => to,
        step => {
            let part = step as f64 / (count - 1) as f64;
            let number = from * (1.0 - part) + to * part;
            // Without what rounding adds: 0.2, not 0.19999999999999998, and 0, not 5e-17.
            if number.abs() < 1e-12 * from.abs().max(to.abs()) {
                return 0.0;
            }
            format!("{number:.12e}").parse().unwrap_or(number)
        }
    };
    let is_range = from.is_finite() && to.is_finite() && (2..=MOST_POINTS).contains(&count);
    is_range.then(|| (0..count).map(at).collect())
}

/// The parts of a text between commas that do not stand in quotes.
fn words(text: &str) -> Vec<&str> {
    let mut quote: Option<char> = None;
    let is_separator = |character: char| {
        match quote {
            Some(open) if open == character => quote = None,
            None if matches!(character, '"' | '\'') => quote = Some(character),
            _ => {}
        }
        quote.is_none() && character == ','
    };
    text.split(is_separator).map(str::trim).collect()
}

impl Axis {
    /// Reads what to vary: one parameter or two, separated by commas, each with the values that follow a `=` or the
    /// usual ones. In `bodies=10,100,search` a parameter's name ends the values of the one before. A parameter can also
    /// be the address of a value of the scene, which needs values: `camera.fov=20,40` or `camera.fov=20..60:5`.
    ///
    /// # Errors
    /// What is wrong, and what can be written.
    pub fn read(text: &str, threads: usize) -> Result<Vec<Self>, AxisError> {
        let mut axes: Vec<Self> = Vec::new();
        for word in words(text) {
            match (Variable::split(word)?, axes.last_mut()) {
                (Some((variable, first)), _) => {
                    let values = first.map(|value| variable.values(value)).transpose()?;
                    axes.push(Self { variable, values: values.unwrap_or_default() });
                }
                // A method may have settings, with a = of their own.
                (None, Some(axis)) if !axis.values.is_empty() => {
                    axis.values.extend(axis.variable.values(word)?);
                }
                _ => {
                    let name = word.split_once('=').map_or(word, |(key, _)| key).to_owned();
                    return Err(AxisError::Parameter { name });
                }
            }
        }
        for axis in axes.iter_mut().filter(|axis| axis.values.is_empty()) {
            axis.values = axis.variable.usual_values(threads);
            if axis.values.is_empty() {
                let expected = "give values, as in camera.fov=20,40 or camera.fov=20..60:5".to_owned();
                let variable = axis.variable.clone();
                return Err(AxisError::Value { variable, value: String::new(), expected });
            }
        }
        Self::check(&axes)?;
        Ok(axes)
    }

    /// A number of the scene over a range: `count` numbers at equal distances, both ends included. Those of a key that
    /// takes whole numbers are rounded, and each stands once. `None` where an end is no number, or for fewer than two
    /// numbers or too many.
    pub fn over(path: ScenePath, key: &KeySpec, range: [f64; 2], count: usize) -> Option<Self> {
        let mut numbers = evenly(range, count)?;
        if let Kind::Integer(_) = key.kind {
            numbers.iter_mut().for_each(|number| *number = number.round());
            numbers.dedup();
        }
        let values = numbers.into_iter().map(|number| Value::Setting(number.into())).collect();
        Some(Self { variable: Variable::Setting(path), values })
    }

    /// A range to begin with around a number that a key of the format has now: all of a short range such as 0…1, half to
    /// twice a length or an amount, 45 degrees or a unit to both sides of what can be negative.
    pub fn usual_range(key: &KeySpec, value: f64) -> [f64; 2] {
        let limits = key.limits().unwrap_or(Limits::PLACE);
        let around = match key.unit(Language::English) {
            Some("degrees") => 45.0,
            _ => value.abs().max(1.0),
        };
        let range = if limits.max - limits.min <= SHORT_RANGE {
            [limits.min, limits.max]
        } else if limits.min < 0.0 {
            [value - around, value + around]
        } else if value > 0.0 {
            [0.5 * value, 2.0 * value]
        } else {
            [0.0, 1.0]
        };
        let range = if let Kind::Integer(_) = key.kind { [range[0].floor(), range[1].ceil()] } else { range };
        range.map(|end| end.clamp(limits.min, limits.max))
    }

    /// One parameter or two different ones.
    pub(super) fn check(axes: &[Self]) -> Result<(), AxisError> {
        match axes {
            [one, other] if one.variable == other.variable => Err(AxisError::Twice(one.variable.clone())),
            [_] | [_, _] => Ok(()),
            _ => Err(AxisError::Number(axes.len())),
        }
    }

    /// The method that the values of a parameter are about, unless it is the one that is asked for.
    pub(super) fn applies(parameter: Parameter, method: &Method) -> bool {
        match parameter {
            Parameter::Fineness => matches!(method, Method::Flat(_) | Method::Gouraud(_) | Method::Phong(_)),
            Parameter::CubeMapSize => matches!(method, Method::CubeMap(_)),
            _ => true,
        }
    }
}

#[cfg(test)]
mod tests {
    use catoptric_scene::format::spec::TableSpec;

    use super::*;

    fn read(text: &str) -> String {
        match Axis::read(text, 4) {
            Ok(axes) => {
                let values =
                    |axis: &Axis| axis.values.iter().map(Value::to_string).collect::<Vec<_>>().join(" ");
                axes.iter()
                    .map(|axis| format!("{}: {}", axis.variable, values(axis)))
                    .collect::<Vec<_>>()
                    .join("; ")
            }
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn parameters_and_values_are_told_apart() {
        assert_eq!(read("threads"), "threads: 1 2 3 4");
        assert_eq!(read("bodies=10,100,search"), "bodies: 10 100; search: hierarchy one-by-one");
        assert_eq!(
            read("size=64x36, 128x72 ,method=whitted,whitted:generations=2,ssr"),
            "size: 64x36 128x72; method: whitted whitted:generations=2 ssr"
        );
        assert_eq!(read("search=one-by-one,bodies=0"), "search: one-by-one; bodies: 0");
        assert_eq!(
            read("camera.fov=20,30, 40,bodies.'a,b'.position.x=-1..1:5"),
            "camera.fov: 20 30 40; bodies.\"a,b\".position.x: -1 -0.5 0 0.5 1"
        );
        assert_eq!(
            read("bodies.0.shape=sphere,cube,tracing.threshold=0,0.1..0.2:2,0.5"),
            "bodies.0.shape: sphere cube; tracing.threshold: 0 0.1 0.2 0.5"
        );
        assert_eq!(
            read("bodies.0.radius=0.1..1:10,materials.a.texture=../a.png"),
            "bodies.0.radius: 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9 1; materials.a.texture: ../a.png"
        );
    }

    #[test]
    fn a_number_of_the_scene_has_a_range() {
        let over = |table: &'static TableSpec, key: &str, range, count| {
            let axis = Axis::over("camera.fov".parse().unwrap(), table.key(key).unwrap(), range, count)?;
            Some(axis.values.iter().filter_map(Value::number).collect::<Vec<_>>())
        };
        let fov = |range, count| over(&keys::CAMERA, "fov", range, count);
        assert_eq!(fov([20.0, 60.0], 5), Some(vec![20.0, 30.0, 40.0, 50.0, 60.0]));
        assert_eq!(fov([1.0, -0.5], 4), Some(vec![1.0, 0.5, 0.0, -0.5]));
        let generations = |range, count| over(&keys::TRACING, "generations", range, count);
        assert_eq!(generations([1.0, 3.0], 9), Some(vec![1.0, 2.0, 3.0]));
        for (range, count) in
            [([0.0, f64::NAN], 3), ([f64::INFINITY, 0.0], 3), ([0.0, 1.0], 1), ([0.0, 1.0], 10_001)]
        {
            assert_eq!(fov(range, count), None);
        }
    }

    #[test]
    fn usual_ranges_are_within_the_limits_and_around_the_number() {
        let usual =
            |table: &'static TableSpec, key: &str, value| Axis::usual_range(table.key(key).unwrap(), value);
        assert_eq!(usual(&keys::CAMERA, "fov", 27.0), [13.5, 54.0]);
        assert_eq!(usual(&keys::CAMERA, "fov", 150.0), [75.0, 179.9]);
        assert_eq!(usual(&keys::CAMERA, "position", 8.0), [0.0, 16.0]);
        assert_eq!(usual(&keys::BODY, "position", 0.0), [-1.0, 1.0]);
        assert_eq!(usual(&keys::BODY, "rotation", 30.0), [-15.0, 75.0]);
        assert_eq!(usual(&keys::BODY, "radius", 0.5), [0.25, 1.0]);
        assert_eq!(usual(&keys::LIGHT, "intensity", 0.0), [0.0, 1.0]);
        assert_eq!(usual(&keys::MATERIAL, "reflection", 0.1), [0.05, 0.2]);
        assert_eq!(usual(&keys::MATERIAL, "roughness", 0.1), [0.0, 1.0]);
        assert_eq!(usual(&keys::TRACING, "generations", 5.0), [2.0, 10.0]);
        assert_eq!(usual(&keys::TRACING, "generations", 1.0), [1.0, 2.0]);
    }

    #[test]
    fn usual_values_are_valid() {
        for parameter in Parameter::ALL {
            for threads in [1, 2, 6, 8, 16, 100, 100_000] {
                let values = parameter.usual_values(threads);
                assert!(!values.is_empty());
                for value in &values {
                    assert_eq!(parameter.value(&value.to_string()), Ok(value.clone()), "{parameter}");
                }
                let numbers: Vec<f64> = values.iter().filter_map(Value::number).collect();
                assert!(
                    numbers.windows(2).all(|pair| pair[0] < pair[1]),
                    "{parameter} {threads}: {numbers:?}"
                );
            }
        }
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (text, said) in [
            ("", "cannot vary \"\"; there are bodies, generations, size"),
            ("speed", "cannot vary \"speed\""),
            ("10,bodies", "cannot vary \"10\""),
            ("bodies,10", "cannot vary \"10\""),
            ("bodies=", "bodies cannot be \"\": give a whole number from 0 to 10000000"),
            ("bodies=-1", "bodies cannot be \"-1\""),
            ("generations=0", "generations cannot be \"0\": give a whole number from 1 to 64"),
            ("generations=65", "generations cannot be \"65\""),
            ("size=64", "size cannot be \"64\": give width and height"),
            ("size=0x5", "size cannot be \"0x5\""),
            ("size=999999x999999", "size cannot be"),
            ("method=raster", "there is no method \"raster\""),
            ("search=bvh", "give hierarchy or one-by-one"),
            ("bodies=1,bodies=2", "bodies is varied twice"),
            ("bodies,size,threads", "vary one parameter or two, not 3"),
            ("camra.fov=1", "cannot vary \"camra.fov\"; there are bodies,"),
            ("camera.fov", "camera.fov cannot be \"\": give values, as in camera.fov=20,40"),
            ("camera.fov=", "`` is not a value"),
            ("camera.fov=1..2", "camera.fov cannot be \"1..2\": give a range as FROM..TO:COUNT"),
            ("camera.fov=1..x:3", "give a range as FROM..TO:COUNT"),
            ("camera.fov=1..2:1", "give a range as FROM..TO:COUNT"),
            ("camera.fov=1..2:9999999", "give a range as FROM..TO:COUNT"),
            ("camera.fov=1,camera.fov=2", "camera.fov is varied twice"),
            ("camera..fov=1", "is not the address of a value"),
        ] {
            let error = read(text);
            assert!(error.contains(said), "{text}: {error}");
        }
    }
}
