//! Patterns of names: `*` is any text.

/// Returns whether the whole name is as the pattern says.
pub(super) fn matches(pattern: &str, name: &str) -> bool {
    let Some((start, rest)) = pattern.split_once('*') else { return pattern == name };
    let Some(mut name) = name.strip_prefix(start) else { return false };
    // Between stars the first place is as good as any; the end has to be the end.
    let mut parts: Vec<_> = rest.split('*').collect();
    let end = parts.pop().unwrap_or_default();
    for part in parts {
        let Some(place) = name.find(part) else { return false };
        name = &name[place + part.len()..];
    }
    name.ends_with(end)
}

#[cfg(test)]
mod tests {
    use super::matches;

    #[test]
    fn stars() {
        for (pattern, name, matching) in [
            ("cell.entropy", "cell.entropy", true),
            ("cell.entropy", "cell.entropy_from_log_odds", false),
            ("*", "", true),
            ("cell.*", "cell.entropy", true),
            ("cell.*", "limit.area", false),
            ("*.mean_information", "grid.polar.mean_information", true),
            ("grid.*.mean_information", "grid.polar.mean_information", true),
            ("grid.*.mean_information", "grid.mean_information", false),
            ("*a*a*", "banana", true),
            ("*a*a", "banana", true),
            ("b*na*na", "bana", false),
            ("", "x", false),
        ] {
            assert_eq!(matches(pattern, name), matching, "{pattern} {name}");
        }
    }
}
