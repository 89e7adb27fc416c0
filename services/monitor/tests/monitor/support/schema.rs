//! Whether JSON has the shape that a schema describes: as much of JSON Schema as ours use.

use serde_json::Value;

/// What is wrong with a value, if anything. A key that the schema does not describe counts as wrong.
pub fn misfit(value: &Value, schema: &Value, root: &Value) -> Option<String> {
    let parts: Vec<&Value> = described(schema, root);
    parts.iter().find_map(|part| own_misfit(value, part, root)).or_else(|| unknown_key(value, &parts))
}

/// A schema, and the one that it refers to.
fn described<'a>(schema: &'a Value, root: &'a Value) -> Vec<&'a Value> {
    let mut parts = vec![schema];
    if let Some(reference) = schema["$ref"].as_str() {
        parts.extend(described(root.pointer(&reference[1..]).expect("a reference within the schema"), root));
    }
    parts
}

fn own_misfit(value: &Value, schema: &Value, root: &Value) -> Option<String> {
    let wrong = |what: &str| Some(format!("{value}: {what}"));
    let types: Vec<&str> = match &schema["type"] {
        Value::Array(types) => types.iter().filter_map(Value::as_str).collect(),
        name => name.as_str().into_iter().collect(),
    };
    if !types.is_empty() && !types.iter().any(|name| is(value, name)) {
        return wrong(&format!("expected {types:?}"));
    }
    if schema.get("const").is_some_and(|expected| expected != value) {
        return wrong(&format!("expected {}", schema["const"]));
    }
    for key in schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str) {
        if value.get(key).is_none() {
            return wrong(&format!("lacks {key}"));
        }
    }
    for choices in ["oneOf", "anyOf"].iter().filter_map(|key| schema[*key].as_array()) {
        if choices.iter().all(|choice| misfit(value, choice, root).is_some()) {
            return wrong("is none of the choices");
        }
    }
    let items = value.as_array().into_iter().flatten().map(|item| (item, schema.get("items")));
    let entries = value.as_object().into_iter().flatten().map(|(key, entry)| {
        (entry, schema["properties"].get(key).or_else(|| schema.get("additionalProperties")))
    });
    items.chain(entries).find_map(|(part, schema)| misfit(part, schema?, root))
}

fn is(value: &Value, name: &str) -> bool {
    match name {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "integer" => value.is_i64() || value.is_u64(),
        "number" => value.is_number(),
        "string" => value.is_string(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        _ => false,
    }
}

fn unknown_key(value: &Value, parts: &[&Value]) -> Option<String> {
    if parts
        .iter()
        .any(|part| ["oneOf", "anyOf", "additionalProperties"].iter().any(|key| part.get(key).is_some()))
    {
        return None;
    }
    let known = |key: &String| parts.iter().any(|part| part["properties"].get(key).is_some());
    let unknown = value.as_object()?.keys().find(|key| !known(key))?;
    Some(format!("{unknown} is not described"))
}
