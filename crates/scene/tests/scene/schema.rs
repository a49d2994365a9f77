//! The JSON schema in the repository is the one that the table of the format gives.

use std::fs;
use std::path::Path;

#[test]
fn the_schema_is_up_to_date() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../schema/catoptric-1.schema.json");
    let schema = serde_json::to_string_pretty(&catoptric_scene::json_schema()).unwrap() + "\n";
    if std::env::var_os("BLESS").is_some() {
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, &schema).unwrap();
    }
    let kept = fs::read_to_string(&path).unwrap_or_default();
    assert!(kept == schema, "schema/catoptric-1.schema.json is stale: BLESS=1 cargo test -p catoptric-scene");
}
