//! The seeds of octrees and of filters' logs.

use mean_information_test_support::formats::Node;

pub(crate) fn octree() -> Vec<(&'static str, Vec<u8>)> {
    let small = Node::small();
    let full = small.full(false);
    let claims_more = String::from_utf8_lossy(&small.binary()).replace("size 8", "size 18446744073709551615");
    // A head from before there were any of text: 3, the side, the number of nodes.
    let binary = small.binary();
    let nodes = binary.windows(5).position(|five| five == b"data\n").map_or(0, |data| data + 5);
    let old =
        [&3_u32.to_le_bytes()[..], &0.05_f64.to_le_bytes(), &8_u32.to_le_bytes(), &binary[nodes..]].concat();
    vec![
        ("old_binary", old),
        ("full", full.clone()),
        ("coloured", small.full(true)),
        ("binary", small.binary()),
        ("finest", small.clone().lowered(13).full(false)),
        ("finest_binary", small.clone().lowered(13).binary()),
        ("too_deep", small.lowered(14).full(false)),
        ("cut", full[..full.len() - 3].to_vec()),
        ("claims_more", claims_more.into_bytes()),
        ("empty", b"# Octomap OcTree file\nid OcTree\nsize 0\nres 0.1\ndata\n".to_vec()),
    ]
}

pub(crate) fn filter_log() -> Vec<(&'static str, Vec<u8>)> {
    let scan = |time| format!("LASER_READING 180{} 0.5 0.25 -0.5 {time}\n", " 2.5".repeat(180));
    let step = |time| scan(time) + "SM_UPDATE 2 0.5 1 0 -6 1 0.5 0 -9 \n";
    let odometry = "PARAM ogain 2\nODOM 0 0 0 1\nODO_UPDATE 2 0 0 0 0 0 0 0 0 1\nFRAME 1 0 0\n";
    let whole = [odometry, &step(1.5), "NEFF 1.9\nRESAMPLE 2 1 1 \n", &step(2.5), "HELLO\n"].concat();
    [
        ("whole", whole.clone()),
        ("cut", whole[..whole.len() - 20].to_owned()),
        ("underflow", whole.replace("-9", "-9e300")),
        ("out_of_range", whole.replace("2 1 1", "2 1 2")),
        ("claims_more", whole.replace("SM_UPDATE 2", "SM_UPDATE 18446744073709551615")),
        ("without_scan", "SM_UPDATE 2 0.5 1 0 -6 1 0.5 0 -9 \n".to_owned()),
    ]
    .map(|(name, text)| (name, text.into_bytes()))
    .to_vec()
}
