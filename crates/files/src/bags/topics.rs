//! The topics of a bag that carry maps, and which of them is meant.

use super::delivery::{Message, Topic, Visitor};
use super::grid::GridMessage;
use super::octomap::OCTOMAP;
use super::read::read_bag;
use crate::error::{Error, ErrorKind};
use crate::options::Options;
use std::path::Path;

/// The topic of a bag whose maps are wanted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MapTopic {
    /// The name; `None` for the only topic of maps that is no costmap.
    pub name: Option<String>,
    /// Allows a costmap to be named.
    pub costmaps: bool,
}

/// Tells whether a topic carries costmaps by its name: costs of driving, not probabilities of being occupied.
///
/// ```
/// use mean_information_files::bags::is_costmap;
/// assert!(is_costmap("/global_costmap/costmap") && !is_costmap("/map"));
/// ```
pub fn is_costmap(name: &str) -> bool {
    name.to_ascii_lowercase().contains("costmap")
}

/// Finds the topic of type `nav_msgs/OccupancyGrid` that is meant in the bag at `path`.
///
/// # Errors
/// An [`Error`] of kind [`ErrorKind::Choice`] that lists the topics of maps if none or several may be meant, or the one
/// named carries costmaps and these are not allowed; or as [`read_bag`].
pub fn map_topic(path: &Path, wanted: &MapTopic) -> Result<String, Error> {
    let mut found = Found::default();
    read_bag(path, &Options::default(), &mut found)?;
    chosen(found.grids, wanted).map_err(|error| error.in_file(path))
}

/// A topic of a bag that carries maps of one of two kinds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum AnyMapTopic {
    /// One of type `nav_msgs/OccupancyGrid`, by its name.
    Grids(String),
    /// One of type `octomap_msgs/Octomap`, by its name.
    Octrees(String),
}

/// Finds the topic of maps that is meant in the bag at `path`: one of octrees if it is named, or the only one where there is
/// none of grids; else as [`map_topic`].
///
/// # Errors
/// As [`map_topic`].
pub fn any_map_topic(path: &Path, wanted: &MapTopic) -> Result<AnyMapTopic, Error> {
    let mut found = Found::default();
    read_bag(path, &Options::default(), &mut found)?;
    let Found { grids, mut octrees } = found;
    octrees.sort_unstable();
    octrees.dedup();
    let only = || octrees.first().filter(|_| octrees.len() == 1 && grids.iter().all(|name| is_costmap(name)));
    let meant = match &wanted.name {
        Some(name) => octrees.iter().find(|own| *own == name),
        None => only(),
    };
    if let Some(name) = meant {
        return Ok(AnyMapTopic::Octrees(name.clone()));
    }
    let listed =
        if octrees.is_empty() { String::new() } else { format!("; of octrees: {}", octrees.join(", ")) };
    let grid = chosen(grids, wanted).map_err(|error| error.followed_by(&listed).in_file(path))?;
    Ok(AnyMapTopic::Grids(grid))
}

/// Chooses the topic that is meant among those of maps.
fn chosen(mut topics: Vec<String>, wanted: &MapTopic) -> Result<String, Error> {
    topics.sort_unstable();
    topics.dedup();
    let listed = if topics.is_empty() { "none".to_owned() } else { topics.join(", ") };
    let refuse = |words: String| {
        Err(Error::new(ErrorKind::Choice, words).allowing("; topics of its maps are: ", listed.clone()))
    };
    if let Some(name) = &wanted.name {
        return match topics.contains(name) {
            false => refuse(format!("has no topic {name} of type {}", GridMessage::KIND)),
            true if is_costmap(name) && !wanted.costmaps => refuse(format!(
                "{name} carries costmaps by its name, whose cells are costs and not probabilities of being occupied"
            )),
            true => Ok(name.clone()),
        };
    }
    let maps: Vec<&String> = topics.iter().filter(|name| !is_costmap(name)).collect();
    match *maps {
        [name] => Ok(name.clone()),
        [] => refuse("has no topic of maps, other than costmaps".to_owned()),
        _ => refuse("has several topics of maps".to_owned()),
    }
}

/// Takes the names of the topics of maps and none of their messages.
#[derive(Default)]
struct Found {
    grids: Vec<String>,
    octrees: Vec<String>,
}

impl Visitor for Found {
    fn wants(&mut self, topic: &Topic) -> bool {
        if topic.kind == GridMessage::KIND {
            self.grids.push(topic.name.clone());
        } else if topic.kind == OCTOMAP {
            self.octrees.push(topic.name.clone());
        }
        false
    }

    fn take(&mut self, _: &Message<'_>) -> Result<(), Error> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn choose(topics: &[&str], name: Option<&str>, costmaps: bool) -> Result<String, String> {
        let wanted = MapTopic { name: name.map(str::to_owned), costmaps };
        let topics = topics.iter().map(|&name| name.to_owned()).collect();
        chosen(topics, &wanted).map_err(|error| error.to_string())
    }

    #[test]
    fn the_only_topic_of_maps_that_is_no_costmap() {
        let topics = ["/map", "/global_costmap/costmap", "/map"];
        assert_eq!(choose(&topics, None, false).unwrap(), "/map");
        assert_eq!(
            choose(&topics[1..2], None, true).unwrap_err(),
            "has no topic of maps, other than costmaps; topics of its maps are: /global_costmap/costmap"
        );
        let several = choose(&["/b", "/a"], None, false).unwrap_err();
        assert_eq!(several, "has several topics of maps; topics of its maps are: /a, /b");
        assert_eq!(choose(&["/b", "/a"], Some("/b"), false).unwrap(), "/b");
        assert!(choose(&[], Some("/b"), false).unwrap_err().ends_with("topics of its maps are: none"));
    }

    #[test]
    fn costmaps_only_where_they_are_allowed() {
        let name = "/local_costmap/costmap";
        assert!(choose(&[name], Some(name), false).unwrap_err().contains("carries costmaps by its name"));
        assert_eq!(choose(&[name], Some(name), true).unwrap(), name);
    }
}
