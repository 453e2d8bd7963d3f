//! Short names that still tell files apart.

/// The longest label, in characters.
const LONGEST: usize = 36;

/// Returns for each name as many of its last parts as tell it from the others; the beginning of a long one is cut.
pub fn labels(names: &[String]) -> Vec<String> {
    let last = |name: &str, parts: usize| {
        let all: Vec<_> = name.split('/').collect();
        all[all.len().saturating_sub(parts)..].join("/")
    };
    let label = |(index, name): (usize, &String)| {
        let others = || names.iter().enumerate().filter(|&(other, _)| other != index);
        let is_own = |&parts: &usize| others().all(|(_, other)| last(other, parts) != last(name, parts));
        let parts = (1..=name.split('/').count()).find(is_own).unwrap_or(1);
        let label = last(name, parts);
        let more = label.chars().count().saturating_sub(LONGEST);
        if more == 0 { label } else { format!("...{}", label.chars().skip(more + 3).collect::<String>()) }
    };
    names.iter().enumerate().map(label).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_parts_as_are_needed() {
        let of = |names: &[&str]| labels(&names.iter().map(|&name| name.to_owned()).collect::<Vec<_>>());
        assert_eq!(of(&["a/true.tum", "a/odometry.tum"]), ["true.tum", "odometry.tum"]);
        assert_eq!(of(&["x/a/poses.tum", "x/b/poses.tum", "c.tum"]), ["a/poses.tum", "b/poses.tum", "c.tum"]);
        assert_eq!(of(&["poses.tum", "b/poses.tum"]), ["poses.tum", "b/poses.tum"]);
        assert_eq!(of(&["a.tum", "a.tum"]), ["a.tum", "a.tum"]);
        assert_eq!(of(&[&"long".repeat(12)])[0].len(), LONGEST);
    }
}
