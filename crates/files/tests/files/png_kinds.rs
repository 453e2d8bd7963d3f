//! Every kind of PNG: written here, and what its samples mean.

use crate::support::Random;
use png::{BitDepth, ColorType, Encoder};

/// Width and height of the images.
pub(crate) const SIZE: usize = 37;

/// What kind of PNG, and what follows from its chunks.
#[derive(Clone, Debug)]
pub(crate) struct Kind {
    pub(crate) colour: ColorType,
    pub(crate) depth: u8,
    pub(crate) palette: Vec<[u8; 3]>,
    /// Alpha per palette entry, or the transparent colour.
    pub(crate) transparency: Option<Vec<u16>>,
}

impl Kind {
    pub(crate) fn plain(colour: ColorType, depth: u8) -> Self {
        Self { colour, depth, palette: Vec::new(), transparency: None }
    }

    pub(crate) fn all(random: &mut Random) -> Vec<Self> {
        let mut kinds = Vec::new();
        for depth in [1, 2, 4, 8, 16] {
            let grey = Self::plain(ColorType::Grayscale, depth);
            kinds.push(grey.clone());
            kinds.push(Self { transparency: Some(vec![u16::from(depth > 1)]), ..grey });
        }
        for depth in [8, 16] {
            for colour in [ColorType::GrayscaleAlpha, ColorType::Rgb, ColorType::Rgba] {
                kinds.push(Self::plain(colour, depth));
            }
            kinds.push(Self { transparency: Some(vec![1, 0, 2]), ..Self::plain(ColorType::Rgb, depth) });
        }
        for depth in [1, 2, 4, 8] {
            let palette: Vec<[u8; 3]> =
                (0..1 << depth).map(|_| [(); 3].map(|()| random.below(256) as u8)).collect();
            let alphas = |holes: &[usize], other: u16| {
                Some((0..palette.len()).map(|k| if holes.contains(&k) { 0 } else { other }).collect())
            };
            for transparency in [None, alphas(&[1], 255), alphas(&[0, 1], 255), alphas(&[1], 254)] {
                kinds.push(Self {
                    colour: ColorType::Indexed,
                    depth,
                    palette: palette.clone(),
                    transparency,
                });
            }
        }
        kinds
    }

    fn samples(&self) -> usize {
        self.colour.samples()
    }

    /// Random pixels: the extremes and the savers' greys often, and small samples so that transparent colours occur.
    pub(crate) fn pixels(&self, random: &mut Random) -> Vec<Vec<u16>> {
        let most = (1_u32 << self.depth) - 1;
        let mut sample = || match random.below(4) {
            0 => random.below(3).min(most),
            1 => most - random.below(3).min(most),
            2 if most == 255 => 205,
            _ => random.below(most + 1),
        };
        (0..SIZE * SIZE).map(|_| (0..self.samples()).map(|_| sample() as u16).collect()).collect()
    }

    pub(crate) fn encode(&self, pixels: &[Vec<u16>]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, SIZE as u32, SIZE as u32);
        encoder.set_color(self.colour);
        encoder.set_depth(BitDepth::from_u8(self.depth).unwrap());
        encoder.set_filter(png::Filter::Adaptive);
        if self.colour == ColorType::Indexed {
            encoder.set_palette(self.palette.concat());
        }
        if let Some(transparency) = &self.transparency {
            encoder.set_trns(match self.colour {
                ColorType::Indexed => transparency.iter().map(|&alpha| alpha as u8).collect(),
                _ => transparency.iter().flat_map(|sample| sample.to_be_bytes()).collect::<Vec<u8>>(),
            });
        }
        let mut data = Vec::new();
        for row in pixels.chunks(SIZE) {
            let row: Vec<u16> = row.concat();
            match self.depth {
                16 => data.extend(row.iter().flat_map(|sample| sample.to_be_bytes())),
                depth => data.extend(row.chunks(8 / usize::from(depth)).map(|samples| {
                    (0..8 / usize::from(depth)).fold(0, |byte, k| {
                        (u32::from(byte) << depth | u32::from(samples.get(k).copied().unwrap_or(0))) as u8
                    })
                })),
            }
        }
        encoder.write_header().unwrap().write_image_data(&data).unwrap();
        bytes
    }

    /// Red, green, blue and alpha as they are meant, and their white.
    pub(crate) fn meant(&self, pixel: &[u16]) -> ([u32; 4], u32) {
        let white = (1_u32 << self.depth) - 1;
        if self.colour == ColorType::Indexed {
            let index = usize::from(pixel[0]);
            let alpha = self.transparency.as_ref().map_or(255, |alphas| u32::from(alphas[index]));
            let [r, g, b] = self.palette[index].map(u32::from);
            return ([r, g, b, alpha], 255);
        }
        let sample: Vec<u32> = pixel.iter().copied().map(u32::from).collect();
        let clear = self.transparency.as_deref() == Some(pixel);
        let alpha = if clear { 0 } else { white };
        let colour = match self.colour {
            ColorType::GrayscaleAlpha => [sample[0], sample[0], sample[0], sample[1]],
            ColorType::Rgba => [sample[0], sample[1], sample[2], sample[3]],
            ColorType::Rgb => [sample[0], sample[1], sample[2], alpha],
            _ => [sample[0], sample[0], sample[0], alpha],
        };
        (colour, white)
    }

    /// As [`Self::meant`], but for the transparent colour of an RGB image of 8 bits, which GraphicsMagick does not find: it
    /// compares it with samples that it brought to 16 bits.
    pub(crate) fn by_magick(&self, pixel: &[u16]) -> ([u32; 4], u32) {
        let ([r, g, b, alpha], white) = self.meant(pixel);
        let is_vain = self.colour == ColorType::Rgb && self.depth == 8;
        ([r, g, b, if is_vain { white } else { alpha }], white)
    }

    /// As [`Self::by_magick`], with 16 bits of all but greys alone cut to their high byte.
    pub(crate) fn by_nav2(&self, pixel: &[u16]) -> ([u32; 4], u32) {
        match self.by_magick(pixel) {
            ([r, g, b, alpha], 65535) if self.colour != ColorType::Grayscale => {
                ([r, g, b, alpha].map(|sample| sample >> 8), 255)
            }
            other => other,
        }
    }

    /// Tells whether its pixels have an alpha.
    pub(crate) fn has_alpha(&self) -> bool {
        self.transparency.is_some() || matches!(self.colour, ColorType::GrayscaleAlpha | ColorType::Rgba)
    }

    /// The bytes of a pixel on SDL's surface, and whether it has an alpha mask.
    pub(crate) fn on_sdl_surface(&self, pixel: &[u16]) -> (Vec<u8>, bool) {
        let ([r, g, b, a], white) = self.meant(pixel);
        let byte = |sample: u32| (if white == 65535 { sample >> 8 } else { sample * 255 / white }) as u8;
        match self.colour {
            ColorType::Indexed => {
                let alphas = self.transparency.clone().unwrap_or_default();
                let holes = alphas.iter().filter(|&&alpha| alpha == 0).count();
                if holes < 2 && alphas.iter().all(|&alpha| alpha == 0 || alpha == 255) {
                    (vec![pixel[0] as u8], false)
                } else {
                    ([r, g, b, a].map(byte).to_vec(), true)
                }
            }
            ColorType::Grayscale if self.transparency.is_some() => ([g, a].map(byte).to_vec(), false),
            ColorType::Grayscale => (vec![byte(g)], false),
            ColorType::Rgb => ([r, g, b].map(byte).to_vec(), false),
            ColorType::GrayscaleAlpha | ColorType::Rgba => ([r, g, b, a].map(byte).to_vec(), true),
        }
    }
}
