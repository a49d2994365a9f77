//! Addresses that begin as somebody has typed.

use super::listing::{SceneKey, keys_of, parts, segments};
use super::path::ScenePath;
use crate::Scene;
use crate::part::ScenePart;

/// What an address that was begun can become.
#[derive(Clone, Debug, PartialEq)]
pub struct AddressCompletion {
    /// An address; or the beginning of several, which ends with a point.
    pub text: String,
    /// The key of an address.
    pub key: Option<SceneKey>,
}

/// What begins with `typed`, at most `most`: whole addresses if they are not more, else their beginnings up to the next
/// point at which they part.
pub(super) fn completions(
    scene: &Scene,
    typed: &str,
    most: usize,
    addresses: &dyn Fn(&SceneKey) -> Vec<ScenePath>,
) -> Vec<AddressCompletion> {
    let meant: Vec<ScenePart> = parts(scene).filter(|part| is_meant(scene, *part, typed)).collect();
    let found = if meant.len() > most {
        // Each has a key or more, which nobody needs to know.
        beginnings(meant.iter().map(|part| ScenePath { segments: segments(scene, *part) }), true, typed, most)
    } else {
        let keys = meant.iter().flat_map(|part| keys_of(scene, *part, []));
        let all: Vec<(ScenePath, SceneKey)> = keys
            .flat_map(|key| addresses(&key).into_iter().map(move |path| (path, key.clone())))
            .filter(|(path, _)| path.to_string().starts_with(typed))
            .collect();
        if all.len() > most {
            beginnings(all.into_iter().map(|(path, _)| path), false, typed, most)
        } else {
            let whole = |(path, key): (ScenePath, SceneKey)| (path.to_string(), Some(key));
            all.into_iter().map(whole).map(|(text, key)| AddressCompletion { text, key }).collect()
        }
    };
    match found.as_slice() {
        // A beginning alone leaves nothing to choose.
        [AddressCompletion { text, key: None }] if text.len() > typed.len() => {
            completions(scene, text, most, addresses)
        }
        _ => found,
    }
}

/// Whether addresses of a part can begin like that.
fn is_meant(scene: &Scene, part: ScenePart, typed: &str) -> bool {
    let path = ScenePath { segments: segments(scene, part) };
    let beginning = format!("{path}.");
    beginning.starts_with(typed) || typed.starts_with(&beginning)
}

/// How far paths that begin like that go on to their next point, each once. More follows the end of each path, or not.
fn beginnings(
    paths: impl Iterator<Item = ScenePath>,
    goes_on: bool,
    typed: &str,
    most: usize,
) -> Vec<AddressCompletion> {
    let mut found: Vec<AddressCompletion> = Vec::new();
    for path in paths {
        let next = (1..=path.segments.len()).find_map(|count| {
            let is_whole = count == path.segments.len() && !goes_on;
            let beginning = ScenePath { segments: path.segments.iter().take(count).cloned().collect() };
            let text = if is_whole { beginning.to_string() } else { format!("{beginning}.") };
            (text.len() > typed.len() || is_whole).then_some(text)
        });
        let Some(text) = next else { continue };
        // Those that begin alike follow each other.
        if found.last().is_none_or(|last| last.text != text) {
            if found.len() >= most {
                break;
            }
            found.push(AddressCompletion { text, key: None });
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Body;

    fn texts(scene: &Scene, typed: &str, most: usize) -> Vec<String> {
        let path = |key: &SceneKey| vec![key.path.clone()];
        completions(scene, typed, most, &path).into_iter().map(|found| found.text).collect()
    }

    fn bodies(count: usize) -> Scene {
        let body = |index: usize| Body { name: format!("body.{index}"), ..Body::default() };
        Scene { bodies: (0..count).map(body).collect(), ..Scene::default() }
    }

    #[test]
    fn few_addresses_are_whole_and_many_are_cut_at_points() {
        let scene = bodies(2);
        let all: Vec<String> = scene.keys().map(|key| key.path.to_string()).collect();
        assert_eq!(texts(&scene, "", all.len()), all);
        assert_eq!(texts(&scene, "", 10), ["camera.", "environment.", "tracing.", "bodies."]);
        assert_eq!(texts(&scene, "bod", 10), [r#"bodies."body.0"."#, r#"bodies."body.1"."#]);
        let radius = [r#"bodies."body.1".radius"#];
        assert_eq!(texts(&scene, r#"bodies."body.1".rad"#, 10), radius);
        assert_eq!(texts(&scene, radius[0], 10), radius);
        assert!(texts(&scene, "bodies.none", 10).is_empty() && texts(&scene, "x", 10).is_empty());
        assert!(texts(&scene, r#"bodies."body.1".material."#, 40).len() > 5);
        assert_eq!(
            texts(&scene, "camera.", 100),
            ["position", "target", "up", "projection", "fov"].map(|key| format!("camera.{key}"))
        );
    }

    #[test]
    fn very_many_bodies_are_told_by_some() {
        let scene = bodies(20_000);
        let found = texts(&scene, "bodies.", 50);
        assert_eq!((found.len(), found[0].as_str()), (50, r#"bodies."body.0"."#));
        assert_eq!(texts(&scene, r#"bodies."body.1234"#, 5).len(), 5);
        let one = texts(&scene, r#"bodies."body.1234"."#, 50);
        assert!(
            one.len() > 10 && one.iter().all(|text| text.starts_with(r#"bodies."body.1234"."#)),
            "{one:?}"
        );
    }
}
