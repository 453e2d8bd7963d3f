//! PNG files put together from their parts, so that any part can be wrong.

/// Puts a PNG together from its parts; the caller compresses the bytes of `IDAT`.
pub fn raw_png(
    width: u32,
    height: u32,
    depth: u8,
    colour: u8,
    interlace: u8,
    chunks: &[(&str, Vec<u8>)],
) -> Vec<u8> {
    let mut header = width.to_be_bytes().to_vec();
    header.extend(height.to_be_bytes());
    header.extend([depth, colour, 0, 0, interlace]);
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    let ihdr = [("IHDR", header)];
    let iend = [("IEND", Vec::new())];
    for (name, data) in ihdr.iter().chain(chunks).chain(&iend) {
        let mut crc = flate2::Crc::new();
        crc.update(name.as_bytes());
        crc.update(data);
        bytes.extend((data.len() as u32).to_be_bytes());
        bytes.extend(name.as_bytes());
        bytes.extend(data);
        bytes.extend(crc.sum().to_be_bytes());
    }
    bytes
}

/// Compresses bytes as zlib.
///
/// # Panics
/// If memory lacks.
pub fn zlib(data: &[u8]) -> Vec<u8> {
    use std::io::Write;
    let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
    encoder.write_all(data).unwrap();
    encoder.finish().unwrap()
}
