//! The bytes of map files.

/// Returns a yaml file with the usual thresholds and these further lines.
pub fn yaml(image: &str, more: &str) -> String {
    format!(
        "image: {image}\nresolution: 0.05\norigin: [-3.5, 2.25, 0.125]\n\
         occupied_thresh: 0.65\nfree_thresh: 0.196\n{more}"
    )
}

/// Returns a raw PGM.
pub fn pgm(width: usize, height: usize, max: u16, samples: &[u16]) -> Vec<u8> {
    let mut bytes = format!("P5\n# a comment 7\n{width} # another\n{height}\n{max}\n").into_bytes();
    for &sample in samples {
        bytes.extend(&sample.to_be_bytes()[usize::from(max < 256)..]);
    }
    bytes
}

/// Returns an `.npy` file of version 1.
pub fn npy(descr: &str, fortran_order: bool, shape: &str, data: &[u8]) -> Vec<u8> {
    let order = if fortran_order { "True" } else { "False" };
    let mut header = format!("{{'descr': {descr}, 'fortran_order': {order}, 'shape': {shape}, }}");
    while (10 + header.len() + 1) % 64 != 0 {
        header.push(' ');
    }
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.into_bytes());
    bytes.extend(data);
    bytes
}
