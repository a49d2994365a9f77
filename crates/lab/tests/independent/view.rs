//! Camera and codes of the independent tracer.

use catoptric_scene::{Camera, Projection};
use glam::DVec3;

use super::{IndependentTracer, Slip};

/// The curve from light to codes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// Codes in proportion to light.
    Linear,
    /// The function of sRGB.
    Srgb,
}

/// The rays of a picture.
pub(super) struct View {
    eye: DVec3,
    right: DVec3,
    up: DVec3,
    ahead: DVec3,
    /// Half of the window's sides at the distance 1, or in meters for a parallel projection.
    half: [f64; 2],
    is_parallel: bool,
}

impl View {
    fn new(camera: &Camera, [width, height]: [u32; 2], slips: &[Slip]) -> Self {
        let has = |slip| slips.contains(&slip);
        let aspect = f64::from(width) / f64::from(height);
        let mut eye = camera.position;
        if has(Slip::CameraMoved) {
            eye += DVec3::new(0.25, 0.1, -0.15);
        }
        let toward = if has(Slip::TargetAsDirection) { camera.target } else { camera.target - eye };
        let ahead = toward.normalize();
        let across = ahead.cross(camera.up);
        let right = if has(Slip::RightNotUnit) { across } else { across.normalize() };
        let up = if has(Slip::UpNotOrthogonal) { camera.up.normalize() } else { right.cross(ahead) };
        let right = if has(Slip::LeftHanded) { -right } else { right };
        let (mut half, is_parallel) = match camera.projection {
            Projection::Perspective { fov_degrees } => ((0.5 * fov_degrees).to_radians().tan(), false),
            Projection::Parallel { height } => (0.5 * height, true),
        };
        let angle = half.atan();
        if !is_parallel && has(Slip::AngleWhole) {
            half = (2.0 * angle).tan();
        }
        if !is_parallel && has(Slip::AngleQuartered) {
            half = (0.5 * angle).tan();
        }
        if has(Slip::AngleForWidth) {
            half /= aspect;
        }
        if has(Slip::AngleForHeight) {
            half *= aspect;
        }
        let aspect = match () {
            () if has(Slip::Stretched) => 4.0 / 3.0,
            () if has(Slip::NoAspect) => 1.0,
            () => aspect,
        };
        Self { eye, right, up, ahead, half: [half * aspect, half], is_parallel }
    }

    /// The ray of a place in the window, each coordinate from −1 to 1, to the right and up.
    fn ray(&self, x: f64, y: f64, slips: &[Slip]) -> (DVec3, DVec3) {
        let has = |slip| slips.contains(&slip);
        let [mut x, mut y] = [x * self.half[0], y * self.half[1]];
        if self.is_parallel {
            return (self.eye + x * self.right + y * self.up, self.ahead);
        }
        if has(Slip::EvenAngles) {
            let even = |at: f64, half: f64| (at / half * half.atan()).tan();
            [x, y] = [even(x, self.half[0]), even(y, self.half[1])];
        }
        (self.eye, (x * self.right + y * self.up + self.ahead).normalize())
    }
}

impl IndependentTracer<'_> {
    /// Linear light, row by row from the top.
    pub fn light(&self, size: [u32; 2]) -> Vec<DVec3> {
        let [width, height] = size;
        let view = View::new(&self.scene.camera, size, &self.slips);
        let middle = match () {
            () if self.has(Slip::Corners) => 0.0,
            () if self.has(Slip::OnePixel) => 1.5,
            () => 0.5,
        };
        let mut light = Vec::new();
        for row in 0..height {
            for column in 0..width {
                let mut x = (f64::from(column) + middle) / f64::from(width);
                let mut y = (f64::from(row) + middle) / f64::from(height);
                if self.has(Slip::Cropped) {
                    (x, y) = (0.8 * x, 0.8 * y);
                }
                let (origin, direction) = view.ray(2.0 * x - 1.0, 1.0 - 2.0 * y, &self.slips);
                light.push(self.primary(origin, direction));
            }
        }
        light
    }

    /// The codes of a picture, row by row from the top.
    pub fn codes(&self, size: [u32; 2], encoding: Encoding) -> Vec<[u8; 3]> {
        let light = self.light(size);
        let mut codes: Vec<[u8; 3]> =
            light.iter().map(|light| light.to_array().map(|light| self.code(light, encoding))).collect();
        if self.has(Slip::BlueFirst) {
            codes.iter_mut().for_each(|code| code.reverse());
        }
        if self.has(Slip::FlippedDown) {
            codes = codes.chunks(size[0] as usize).rev().flatten().copied().collect();
        }
        if self.has(Slip::UpsideDown) {
            codes.reverse();
        }
        codes
    }

    fn code(&self, light: f64, encoding: Encoding) -> u8 {
        let light = if self.has(Slip::Darker) { 0.6 * light } else { light };
        let encode = |light: f64| match encoding {
            Encoding::Linear => light,
            Encoding::Srgb if light <= 0.003_130_8 => 12.92 * light,
            Encoding::Srgb => 1.055 * light.powf(1.0 / 2.4) - 0.055,
        };
        if self.has(Slip::Overflow) {
            return ((encode(light.max(0.0)) * 255.0) as u32 % 256) as u8;
        }
        let mut value = encode(light.clamp(0.0, 1.0));
        if self.has(Slip::Gamma) {
            value = light.clamp(0.0, 1.0).powf(1.0 / 2.2);
        }
        if self.has(Slip::EncodedTwice) {
            let once = if encoding == Encoding::Linear { value.powf(1.0 / 2.2) } else { value };
            value = once.powf(1.0 / 2.2);
        }
        if self.has(Slip::Decoded) {
            value = light.clamp(0.0, 1.0).powf(2.2);
        }
        (value * 255.0).round() as u8
    }
}
