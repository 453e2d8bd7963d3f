//! The topics of a bag that carry maps, and which of them is meant.

use super::delivery::Topic;
use super::grid::GridMessage;
use super::octomap::OCTOMAP;
use super::refusals::choice;
use crate::error::Error;
use std::collections::BTreeSet;

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

impl MapTopic {
    /// Names a topic that is no costmap.
    ///
    /// ```
    /// use mean_information_files::bags::MapTopic;
    /// assert_eq!(MapTopic::named("/map").name.as_deref(), Some("/map"));
    /// ```
    pub fn named(name: &str) -> Self {
        Self { name: Some(name.to_owned()), costmaps: false }
    }
}

/// A topic of a bag that carries maps of one of two kinds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum AnyMapTopic {
    /// One of type `nav_msgs/OccupancyGrid`, by its name.
    Grids(String),
    /// One of type `octomap_msgs/Octomap`, by its name.
    Octrees(String),
}

/// The topics of maps of a bag, as they are declared while it is read: the first that may be meant is followed, and in the
/// end it is known whether another may be.
#[derive(Debug)]
pub(super) struct MapTopics {
    wanted: MapTopic,
    grids: BTreeSet<String>,
    octrees: BTreeSet<String>,
    /// The topic of grids that is followed.
    grid: Option<String>,
    /// The topic of octrees that is followed.
    octree: Option<String>,
}

impl MapTopics {
    /// Creates the topics of a bag of which nothing is declared yet.
    pub(super) fn new(wanted: &MapTopic) -> Self {
        let (grids, octrees) = (BTreeSet::new(), BTreeSet::new());
        Self { wanted: wanted.clone(), grids, octrees, grid: None, octree: None }
    }

    /// Takes in a topic; tells whether it is followed.
    pub(super) fn follows(&mut self, topic: &Topic) -> bool {
        let name = &topic.name;
        let is_named = self.wanted.name.as_ref().is_none_or(|wanted| wanted == name);
        let (names, followed, may_be) = match &*topic.kind {
            GridMessage::KIND => {
                let is_allowed = self.wanted.name.is_some() && self.wanted.costmaps || !is_costmap(name);
                (&mut self.grids, &mut self.grid, is_named && is_allowed)
            }
            OCTOMAP => (&mut self.octrees, &mut self.octree, is_named),
            _ => return false,
        };
        names.insert(name.clone());
        if followed.is_none() && may_be {
            *followed = Some(name.clone());
        }
        followed.as_ref() == Some(name)
    }

    /// Tells whether the updates of a topic may be wanted, of which it is not known yet whether it is meant.
    pub(super) fn may_update(&self, topic: &str) -> bool {
        match &self.wanted.name {
            Some(wanted) => wanted == topic,
            None => !is_costmap(topic),
        }
    }

    /// Returns the topic of grids that is followed.
    pub(super) fn grid(&self) -> Option<&str> {
        self.grid.as_deref()
    }

    /// Returns the topic of type `nav_msgs/OccupancyGrid` that is meant.
    ///
    /// # Errors
    /// An [`Error`] of kind [`ErrorKind::Choice`](crate::ErrorKind::Choice) that lists the topics of maps if none or several
    /// may be meant, or the one named carries costmaps and these are not allowed; at the option that mends it.
    pub(super) fn chosen_grid(&self) -> Result<&str, Error> {
        chosen(&self.grids, &self.wanted)
    }

    /// Returns the topic that is meant: one of octrees if it is named, or the only one where there is none of grids; else as
    /// [`Self::chosen_grid`].
    ///
    /// # Errors
    /// As [`Self::chosen_grid`].
    pub(super) fn chosen(&self) -> Result<AnyMapTopic, Error> {
        let is_meant = match &self.wanted.name {
            Some(_) => self.octree.is_some(),
            None => self.octrees.len() == 1 && self.grids.iter().all(|name| is_costmap(name)),
        };
        if let Some(name) = self.octree.as_ref().filter(|_| is_meant) {
            return Ok(AnyMapTopic::Octrees(name.clone()));
        }
        let octrees = self.octrees.iter().map(String::as_str).collect::<Vec<_>>().join(", ");
        let listed = if octrees.is_empty() { octrees } else { format!("; of octrees: {octrees}") };
        let grid = self.chosen_grid().map_err(|error| error.followed_by(&listed))?;
        Ok(AnyMapTopic::Grids(grid.to_owned()))
    }
}

/// Chooses the topic that is meant among those of maps.
fn chosen<'a>(topics: &'a BTreeSet<String>, wanted: &MapTopic) -> Result<&'a str, Error> {
    let refuse =
        |option, words: String| Err(choice(option, words, "; topics of its maps are: ", topics.iter()));
    if let Some(name) = &wanted.name {
        return match topics.get(name) {
            None => refuse("topic", format!("has no topic {name} of type {}", GridMessage::KIND)),
            Some(_) if is_costmap(name) && !wanted.costmaps => {
                let words = "carries costmaps by its name, whose cells are costs and not probabilities of being occupied";
                refuse("costmaps", format!("{name} {words}"))
            }
            Some(name) => Ok(name),
        };
    }
    let maps: Vec<&String> = topics.iter().filter(|name| !is_costmap(name)).collect();
    match *maps {
        [name] => Ok(name),
        [] => refuse("costmaps", "has no topic of maps, other than costmaps".to_owned()),
        _ => refuse("topic", "has several topics of maps".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn choose(topics: &[&str], name: Option<&str>, costmaps: bool) -> Result<String, String> {
        let wanted = MapTopic { name: name.map(str::to_owned), costmaps };
        let topics = topics.iter().map(|&name| name.to_owned()).collect();
        chosen(&topics, &wanted).map(str::to_owned).map_err(|error| error.to_string())
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
