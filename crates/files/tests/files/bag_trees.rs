//! Octrees in bags: messages without a head, the same trees as in files.

use mean_information_files::bags::{AnyMap, MapTopic, Visitor, last_map_of_any_kind, octree_of, read_bag};
use mean_information_files::octree::{self, Leaf, Octant, Octree, OctreeVisitor};
use mean_information_files::{Error, ErrorKind, Options, Place};
use mean_information_test_support::formats::bag::{Writer, mcap_of};
use mean_information_test_support::formats::{Folder, shared_data};
use std::path::{Path, PathBuf};

/// The leaves that were visited.
#[derive(Debug, Default, PartialEq)]
struct Leaves(Vec<(Octant, Leaf)>);

impl OctreeVisitor for Leaves {
    fn leaf(&mut self, octant: Octant, leaf: Leaf) {
        self.0.push((octant, leaf));
    }
}

/// Writes a message of a tree.
fn message(ros1: bool, binary: bool, id: &str, resolution: f64, nodes: &[u8]) -> Vec<u8> {
    let mut writer = Writer::new(false, ros1);
    writer.header([5, 6], "map");
    writer.bytes.push(u8::from(binary));
    writer.name(id);
    writer.doubles(&[resolution]);
    writer.number((nodes.len() as u32).to_le_bytes());
    writer.bytes.extend(nodes);
    writer.bytes
}

/// A bag with a tree of three nodes.
pub(crate) fn seed() -> Vec<u8> {
    let nodes = [0x9a, 0x99, 0x59, 0x3f, 0b0010_0001, 0, 0, 0x80, 0xbe, 0, 0, 0, 0x40, 0x3f, 0];
    let message = message(false, false, "OcTree", 0.25, &nodes);
    mcap_of("cdr", &[(7, "/octomap", "octomap_msgs/msg/Octomap")], &[(7, message)])
}

fn bag(folder: &Folder, encoding: &str, messages: &[Vec<u8>]) -> PathBuf {
    let messages: Vec<_> = messages.iter().map(|message| (7, message.clone())).collect();
    folder.write("run.mcap", mcap_of(encoding, &[(7, "/octomap", "octomap_msgs/msg/Octomap")], &messages))
}

fn last(path: &Path) -> (Result<Octree, Error>, Leaves) {
    let mut leaves = Leaves::default();
    let options = Options::default();
    let read = |visitor: &mut dyn Visitor| read_bag(path, &options, visitor);
    (octree_of(read, "/octomap", &mut leaves), leaves)
}

/// The head of a file and its nodes.
fn parted(file: &[u8]) -> (String, &[u8]) {
    let end = file.windows(6).position(|bytes| bytes == b"\ndata\n").unwrap() + 6;
    (String::from_utf8(file[..end].to_vec()).unwrap(), &file[end..])
}

#[test]
fn a_message_is_the_tree_of_the_file() {
    let mut nodes = Vec::new();
    for (log_odds, children) in [(0.85_f32, 0b0010_0001), (-0.4, 0), (0.75, 0)] {
        nodes.extend(log_odds.to_le_bytes());
        nodes.push(children);
    }
    let file = [b"# Octomap OcTree file\nid OcTree\nsize 3\nres 0.25\ndata\n", &*nodes].concat();
    let mut expected = Leaves::default();
    let tree = octree::read(&*file, &mut expected).unwrap();
    let folder = Folder::new();
    for ros1 in [false, true] {
        // The last one counts.
        let messages = [vec![], nodes.clone()].map(|nodes| message(ros1, false, "OcTree", 0.25, &nodes));
        let path = bag(&folder, if ros1 { "ros1" } else { "cdr" }, &messages);
        let (found, leaves) = last(&path);
        assert_eq!(found.unwrap(), tree);
        assert_eq!(leaves, expected);
        // The only topic of maps.
        let chosen = last_map_of_any_kind(&path, &MapTopic::default(), &Options::default()).unwrap();
        let AnyMap::Octree(message) = chosen else { panic!("{chosen:?}") };
        let (mut leaves, files) = (Leaves::default(), vec![path.clone()]);
        assert_eq!(message.read(&mut leaves).unwrap(), Octree { files, ..tree.clone() });
        assert_eq!((message.topic(), &leaves), ("/octomap", &expected));
    }
    // A root whose first child is free and second occupied; and no node at all.
    let path = bag(&folder, "cdr", &[message(false, true, "OcTree", 0.25, &[0b1001, 0])]);
    let (found, leaves) = last(&path);
    let tree = found.unwrap();
    assert_eq!((tree.binary, tree.nodes, tree.leaves), (true, 3, 2));
    assert_eq!(leaves.0.iter().map(|leaf| leaf.1).collect::<Vec<_>>(), [Leaf::Free, Leaf::Occupied]);
    let path = bag(&folder, "cdr", &[message(false, true, "OcTree", 0.25, &[])]);
    assert_eq!(last(&path).0.unwrap().nodes, 0);
}

#[test]
fn trees_of_the_field() {
    let Some(data) = shared_data() else { return };
    let folder = Folder::new();
    for (name, binary) in [("geb079.bt", true), ("spherical_scan.ot", false)] {
        let file = std::fs::read(data.join("octomap").join(name)).unwrap();
        let (head, nodes) = parted(&file);
        let field =
            |key: &str| head.lines().find_map(|line| line.strip_prefix(key)).unwrap().trim().to_owned();
        let path = bag(
            &folder,
            "cdr",
            &[message(false, binary, &field("id "), field("res ").parse().unwrap(), nodes)],
        );
        let (found, leaves) = last(&path);
        let mut expected = Leaves::default();
        let tree = octree::read(&*file, &mut expected).unwrap();
        assert_eq!((found.unwrap().nodes, leaves), (tree.nodes, expected), "{name}");
    }
}

#[test]
fn messages_that_are_no_trees() {
    let folder = Folder::new();
    let node = [0, 0, 0, 64, 0];
    for (message, kind, byte, line) in [
        (
            message(false, false, "OcTree", 0.25, &node[..3]),
            ErrorKind::CutShort,
            48,
            "the file ends before its data do",
        ),
        (
            message(false, false, "OcTree", 0.25, &[node, node].concat()),
            ErrorKind::Format,
            53,
            "goes on after its last node, which ends before byte 53",
        ),
        (
            message(false, false, "CountingOcTree", 0.25, &node),
            ErrorKind::Unsupported,
            24,
            "is of a tree `CountingOcTree`",
        ),
        (
            message(false, false, "OcTree", -0.25, &node),
            ErrorKind::OutOfRange,
            24,
            "resolution is -0.25, allowed is",
        ),
        (
            message(false, false, "OcTree", 0.25, &node)[..51].to_vec(),
            ErrorKind::Format,
            48,
            "has a field of 5 bytes",
        ),
    ] {
        let path = bag(&folder, "cdr", &[message]);
        let error = last(&path).0.unwrap_err();
        let place = Place::Message { topic: "/octomap".to_owned(), number: 1, byte: Some(byte) };
        assert_eq!((error.kind(), error.place()), (kind, Some(&place)), "{error}");
        let begins = format!("message 1 of /octomap, byte {byte} of it: {line}");
        assert!(error.to_string().starts_with(&begins), "{error}");
    }
    let path = bag(&folder, "cdr", &[]);
    assert!(last(&path).0.unwrap_err().to_string().ends_with("has no message of topic /octomap"));
}
