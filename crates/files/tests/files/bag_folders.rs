//! Folders of bags: which files belong together, in which order, and which are to be named.

use crate::scan_bag::{PLAIN, TOPICS};
use mean_information_files::bags::{Message, Topic, Visitor, bag_files, is_bag, read_bag};
use mean_information_files::scans::{ScanOptions, Selection};
use mean_information_files::{Error, ErrorKind, Options, Place, read_selected_scans};
use mean_information_test_support::formats::Folder;
use mean_information_test_support::formats::bag::{mcap_at, mcap_of};
use std::path::Path;

/// Takes the times of messages.
#[derive(Default)]
struct Times(Vec<u64>);

impl Visitor for Times {
    fn wants(&mut self, _: &Topic) -> bool {
        true
    }

    fn take(&mut self, message: &Message<'_>) -> Result<(), Error> {
        self.0.push(message.time_ns);
        Ok(())
    }
}

fn times(path: &Path) -> Result<Vec<u64>, Error> {
    let mut times = Times::default();
    read_bag(path, &Options::default(), &mut times).map(|_| times.0)
}

/// A bag of a message at a time.
fn bag(time: u64) -> Vec<u8> {
    let (id, message) = PLAIN.scan(22);
    mcap_at("cdr", &TOPICS, &[(id, time, message)])
}

/// A folder of bags, each of a message at the time of its place; the path of the folder.
fn folder(names: &[&str]) -> (Folder, std::path::PathBuf) {
    let folder = Folder::new();
    let mut path = folder.write("none.txt", b"");
    for (name, time) in names.iter().zip(1..) {
        path = folder.write(name, bag(time));
    }
    let path = path.parent().unwrap().to_owned();
    (folder, path)
}

fn metadata(files: &[&str]) -> String {
    let listed = files.join("\n    - ");
    format!(
        "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: mcap\n  relative_file_paths:\n    - {listed}\n  \
         topics_with_message_count:\n    - topic_metadata: {{name: /scan, offered_qos_profiles: \"- depth: 1\"}}\n  \
         files:\n    - path: other.mcap\n"
    )
}

#[test]
fn metadata_says_which_files_and_in_which_order() {
    let (folder, path) = folder(&["b.mcap", "a.mcap", "other.mcap"]);
    folder.write("metadata.yaml", metadata(&["b.mcap", "a.mcap"]));
    assert_eq!(times(&path).unwrap(), [1, 2]);
    let read = ["b.mcap", "a.mcap", "metadata.yaml"].map(|name| path.join(name));
    assert_eq!(bag_files(&path).unwrap(), read);
    // Before version 4 a list has the folder, too.
    folder.write("metadata.yaml", metadata(&["old/a.mcap", "old/b.mcap"]));
    assert_eq!(times(&path).unwrap(), [2, 1]);
    folder.write("metadata.yaml", metadata(&["a.mcap", "gone.mcap"]));
    let error = times(&path).unwrap_err();
    assert_eq!((error.kind(), error.value()), (ErrorKind::NotFound, Some("gone.mcap")));
    assert!(
        error.to_string().ends_with("lists gone.mcap in its metadata.yaml, which is not there"),
        "{error}"
    );
    folder.write("metadata.yaml", "a: [1\nb: }");
    let error = times(&path).unwrap_err();
    assert_eq!((error.kind(), error.file()), (ErrorKind::Format, Some(&*path.join("metadata.yaml"))));
    // One that lists none leaves the names.
    folder.write("metadata.yaml", "version: 5\n");
    assert_eq!(times(&path).unwrap_err().kind(), ErrorKind::Choice);
}

#[test]
fn files_of_one_bag_are_numbered() {
    let (_kept, path) = folder(&["run_10.mcap", "run_2.mcap", "run_0.mcap"]);
    assert_eq!(times(&path).unwrap(), [3, 2, 1]);
    let (_kept, path) = folder(&["run.bag"]);
    assert_eq!(times(&path).unwrap(), [1]);
    for names in [&["a.mcap", "b.mcap"][..], &["run_0.mcap", "run_1.db3"], &["run_0.bag", "run_1.bag"]] {
        let (_kept, path) = folder(names);
        assert!(is_bag(&path));
        let error = times(&path).unwrap_err();
        assert_eq!((error.kind(), error.file()), (ErrorKind::Choice, Some(&*path)), "{error}");
        let words =
            format!("is a folder of several bags, {}, {}, without a metadata.yaml", names[0], names[1]);
        assert!(error.to_string().contains(&words), "{error}");
        assert!(error.to_string().ends_with("; allowed is the name of one"), "{error}");
    }
    let folder = Folder::new();
    let empty = folder.write("x.txt", b"").parent().unwrap().to_owned();
    let error = times(&empty).unwrap_err();
    assert_eq!((is_bag(&empty), error.kind(), error.file()), (true, ErrorKind::NotAFile, Some(&*empty)));
    let words =
        "is a folder that holds no bag, no .mcap, .db3 or .bag file; allowed are files, and folders of bags";
    assert_eq!(error.message(), words);
}

#[test]
fn files_that_were_compressed_as_a_whole() {
    for name in ["run_0.mcap.zstd", "run_0.db3.zstd"] {
        let (kept, path) = folder(&[name]);
        kept.write("metadata.yaml", metadata(&[name]));
        let error = times(&path).unwrap_err();
        assert!(is_bag(&path.join(name)));
        assert_eq!((error.kind(), error.file()), (ErrorKind::Unsupported, Some(&*path.join(name))));
        assert!(error.to_string().contains("compression mode file; `zstd -d` unpacks it"), "{error}");
        assert_eq!(times(&path.join(name)).unwrap_err().kind(), ErrorKind::Unsupported);
    }
    // Unpacked beside the other, also where the list has only that.
    let (kept, path) = folder(&["run_0.mcap.zstd", "run_0.mcap"]);
    assert_eq!(times(&path).unwrap(), [2]);
    kept.write("metadata.yaml", metadata(&["run_0.mcap.zstd"]));
    assert_eq!(times(&path).unwrap(), [2]);
}

/// No output may overwrite what was read.
#[test]
fn a_log_names_the_files_that_were_read() {
    let folder = Folder::new();
    let one = folder.write("run_0.mcap", mcap_of("cdr", &TOPICS, &[PLAIN.scan(22), PLAIN.mount()]));
    let two = folder.write("run_1.mcap", mcap_of("cdr", &TOPICS, &[PLAIN.scan(23), PLAIN.moving()]));
    let list = folder.write("metadata.yaml", metadata(&["run_0.mcap", "run_1.mcap"]));
    let path = &one.parent().unwrap().to_owned();
    let log = read_selected_scans(path, &ScanOptions::default(), &Selection::default()).unwrap();
    assert_eq!((log.scans.len(), log.files), (2, vec![one, two, list]));
    let place = Place::Option("file");
    std::fs::remove_file(path.join("metadata.yaml")).unwrap();
    folder.write("other.mcap", bag(7));
    assert_eq!(bag_files(path).unwrap_err().place(), Some(&place));
}
