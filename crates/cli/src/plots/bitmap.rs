//! A picture in memory, and its PNG.

use png::{BitDepth, ColorType, Encoder, EncodingError};

/// Pixels in red, green and blue, row by row from the top.
pub(super) struct Bitmap {
    size: (u32, u32),
    pixels: Vec<[u8; 3]>,
}

impl Bitmap {
    /// Creates a white picture.
    pub(super) fn new(width: u32, height: u32) -> Self {
        Self { size: (width, height), pixels: vec![[255; 3]; width as usize * height as usize] }
    }

    /// Returns width and height.
    pub(super) fn size(&self) -> (u32, u32) {
        self.size
    }

    /// Returns the pixel in column `x` and row `y`; `None` outside the picture.
    pub(super) fn pixel(&mut self, x: i32, y: i32) -> Option<&mut [u8; 3]> {
        let (x, y) = (u32::try_from(x).ok()?, u32::try_from(y).ok()?);
        let (width, height) = self.size;
        (x < width && y < height).then(|| &mut self.pixels[y as usize * width as usize + x as usize])
    }

    /// Gives the pixel a colour; outside the picture nothing happens.
    pub(super) fn paint(&mut self, x: i32, y: i32, colour: [u8; 3]) {
        if let Some(pixel) = self.pixel(x, y) {
            *pixel = colour;
        }
    }

    /// Copies another picture, its upper left corner at this place; what lies outside is left out.
    pub(super) fn place(&mut self, other: &Self, [left, top]: [u32; 2]) {
        for (y, row) in (top as i32..).zip(other.pixels.chunks(other.size.0.max(1) as usize)) {
            for (x, &colour) in (left as i32..).zip(row) {
                self.paint(x, y, colour);
            }
        }
    }

    /// Returns the bytes of its PNG file.
    pub(super) fn png(&self) -> Result<Vec<u8>, EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, self.size.0, self.size.1);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(self.pixels.as_flattened())?;
        writer.finish()?;
        Ok(bytes)
    }
}
