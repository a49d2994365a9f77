//! What reflected rays bring, many rays side by side.

use glam::DVec3;

use crate::geometry::ray::INWARDS;
use crate::raster::cube_map::active::ActiveCubeMaps;
use crate::raster::gbuffer::GBuffer;
use crate::raster::mirrored::{ReflectionSources, reflecting};
use crate::raster::screen::way::ScreenView;
use crate::raster::screen::{MarchRays, ScreenMarcher};
use crate::simd::vector::Vector;
use crate::simd::{Float32 as _, MOST_LANES, Mask as _, SimdKernel, Width};
use crate::transport::camera::RenderCamera;
use crate::transport::scene::RenderScene;
use crate::transport::tile::hits::SurfaceTexel;

/// So many rays go side by side, whatever the width: a multiple of all widths that they are in.
const RAYS: usize = 16;

const NOTHING: Vector<f32> = Vector { x: 0.0, y: 0.0, z: 0.0 };

/// Where reflected rays of a sample find their light.
pub(crate) struct Reflections<'a> {
    scene: &'a RenderScene,
    buffer: &'a GBuffer,
    view: ScreenView,
    screen: Option<ScreenMarcher<'a>>,
    maps: &'a ActiveCubeMaps,
}

impl<'a> Reflections<'a> {
    pub(crate) fn new(
        (scene, camera): (&'a RenderScene, &RenderCamera),
        sources: ReflectionSources<'a>,
        buffer: &'a GBuffer,
        maps: &'a ActiveCubeMaps,
    ) -> Self {
        let screen = sources.screen.map(|settings| ScreenMarcher::new(buffer, camera, settings));
        Self { scene, buffer, view: ScreenView::new(camera, buffer.frame.size()), screen, maps }
    }
}

/// Where the light of some rows of pixels goes to.
pub(crate) enum BandLight<'k> {
    /// The pixels of the picture.
    Picture(&'k mut [[f32; 3]]),
    /// Sums of samples.
    Sums(&'k mut [DVec3]),
}

/// The reflections of some rows of pixels.
pub(crate) struct ReflectionKernel<'k> {
    pub(crate) reflections: &'k Reflections<'k>,
    pub(crate) first_row: usize,
    /// What the reflected rays bring; black as yet.
    pub(crate) reflected: &'k mut [[f32; 3]],
    pub(crate) light: BandLight<'k>,
}

impl ReflectionKernel<'_> {
    /// Rows of a kernel: rays go side by side from blocks so high and wide, as near to each other as may be.
    pub(crate) const ROWS: usize = 4;
}

impl SimdKernel for ReflectionKernel<'_> {
    type Output = ();

    #[inline(always)]
    fn run<W: Width>(self, w: W) {
        let Self { reflections, first_row, reflected, mut light } = self;
        let Reflections { scene, buffer, .. } = *reflections;
        let width = buffer.frame.width;
        let first = first_row * width;
        let (texels, lit) = (&buffer.hits.surfaces[first..], &buffer.lit[first..]);
        if let BandLight::Picture(pixels) = &mut light {
            pixels.copy_from_slice(&lit[..pixels.len()]);
        }
        let mut shares = ShareOfBody::new(scene);
        let mut waiting = WaitingRays { pixels: [0; RAYS], shares: [0.0; RAYS], count: 0 };
        for left in (0..width).step_by(Self::ROWS) {
            let right = (left + Self::ROWS).min(width);
            for row in (0..reflected.len()).step_by(width) {
                for (column, texel) in (left..right).zip(&texels[row + left..row + right]) {
                    let share = shares.of(texel);
                    if share > 0.0 {
                        waiting.push(row + column, share);
                        if waiting.count == RAYS {
                            reflections.find(w, first, &waiting, reflected, &mut light);
                            waiting.count = 0;
                        }
                    }
                }
            }
        }
        if waiting.count > 0 {
            reflections.find(w, first, &waiting, reflected, &mut light);
        }
        if let BandLight::Sums(sums) = light {
            for ((texel, &lit), (&found, sum)) in texels.iter().zip(lit).zip(reflected.iter().zip(sums)) {
                *sum += DVec3::from(with_share(lit, found, shares.of(texel)).map(f64::from));
            }
        }
    }
}

/// The light of a pixel with its share of what is reflected.
#[inline(always)]
fn with_share(lit: [f32; 3], found: [f32; 3], share: f32) -> [f32; 3] {
    std::array::from_fn(|part| lit[part] + found[part] * share)
}

/// Looks up k_r of texels: neighboring pixels mostly show the same body.
struct ShareOfBody<'a> {
    scene: &'a RenderScene,
    start: u32,
    share: f32,
}

impl<'a> ShareOfBody<'a> {
    fn new(scene: &'a RenderScene) -> Self {
        Self { scene, start: SurfaceTexel::EMPTY.start, share: 0.0 }
    }

    /// k_r, 0 if nothing is reflected.
    #[inline(always)]
    fn of(&mut self, texel: &SurfaceTexel) -> f32 {
        if texel.start != self.start {
            (self.start, self.share) = (texel.start, reflecting(self.scene, texel.start).unwrap_or(0.0));
        }
        self.share
    }
}

/// Pixels of a kernel whose reflections are to be found.
struct WaitingRays {
    pixels: [usize; RAYS],
    /// k_r of each.
    shares: [f32; RAYS],
    count: usize,
}

impl WaitingRays {
    #[inline(always)]
    fn push(&mut self, pixel: usize, share: f32) {
        let at = self.count % RAYS;
        (self.pixels[at], self.shares[at]) = (pixel, share);
        self.count += 1;
    }
}

/// What is known of the rays that are reflected in some pixels.
struct ReflectedRays {
    bodies: [u32; RAYS],
    positions: [Vector<f32>; RAYS],
    directions: [Vector<f32>; RAYS],
}

impl Reflections<'_> {
    /// Writes what the reflected rays of some pixels bring, which are counted from the `first` one of the picture on. In a
    /// function of its own, so that this code is there once.
    #[inline(never)]
    fn find<W: Width>(
        &self,
        w: W,
        first: usize,
        waiting: &WaitingRays,
        reflected: &mut [[f32; 3]],
        light: &mut BandLight<'_>,
    ) {
        w.run(
            #[inline(always)]
            || {
                let lanes = ((1_u64 << waiting.count) - 1) as u32;
                let mut rays = ReflectedRays {
                    bodies: [0; RAYS],
                    positions: [NOTHING; RAYS],
                    directions: [NOTHING; RAYS],
                };
                let mut found = [NOTHING; RAYS];
                let mut left = lanes;
                for from in (0..waiting.count).step_by(W::LANES) {
                    let packet = self.packet(w, first, waiting, from, &mut rays);
                    let Some(screen) = &self.screen else { continue };
                    let marched = screen.march_all(w, &packet, w.first(waiting.count - from));
                    let met = marched.met.bits();
                    screen.light_all(w, marched.at, met, &mut found[from..]);
                    left &= !(met << from);
                }
                let ReflectedRays { bodies, positions, directions } = &rays;
                left &= !self.maps.light_all(w, (bodies, positions), directions, left, &mut found);
                for lane in 0..waiting.count.min(RAYS) {
                    if left >> lane & 1 == 1 {
                        found[lane] = self.scene.sky.along(directions[lane]);
                    }
                    let (pixel, found) = (waiting.pixels[lane], found[lane].into());
                    reflected[pixel] = found;
                    if let BandLight::Picture(pixels) = light {
                        pixels[pixel] = with_share(pixels[pixel], found, waiting.shares[lane]);
                    }
                }
            },
        );
    }

    /// The rays that wait from number `from` on.
    #[inline(always)]
    fn packet<W: Width>(
        &self,
        w: W,
        first: usize,
        waiting: &WaitingRays,
        from: usize,
        rays: &mut ReflectedRays,
    ) -> MarchRays<W> {
        let GBuffer { frame, hits, .. } = self.buffer;
        let mut numbers = [[0.0; MOST_LANES]; 9];
        let mut bodies = [0; MOST_LANES];
        for lane in 0..W::LANES.min(waiting.count - from) {
            let pixel = first + waiting.pixels[from + lane];
            let (position, normal) = (hits.positions[pixel], hits.normals[pixel]);
            let SurfaceTexel { depth, start } = hits.surfaces[pixel];
            let (column, row) = (pixel % frame.width, pixel / frame.width);
            let [x, y, z] = position;
            let [normal_x, normal_y, normal_z] = normal;
            let all = [x, y, z, normal_x, normal_y, normal_z, column as f32, row as f32, depth];
            for (row, number) in numbers.iter_mut().zip(all) {
                row[lane] = number;
            }
            bodies[lane] = start & !INWARDS;
            rays.bodies[from + lane] = bodies[lane];
            rays.positions[from + lane] = Vector::new(x, y, z);
        }
        let vector = |first: usize| {
            Vector::new(w.load(&numbers[first]), w.load(&numbers[first + 1]), w.load(&numbers[first + 2]))
        };
        let direction = self.view.reflected(vector(0), vector(3));
        let [mut x, mut y, mut z] = [[0.0; MOST_LANES]; 3];
        direction.x.store(&mut x);
        direction.y.store(&mut y);
        direction.z.store(&mut z);
        for lane in 0..W::LANES {
            rays.directions[(from + lane) % RAYS] = Vector::new(x[lane], y[lane], z[lane]);
        }
        MarchRays {
            pixel: [w.load(&numbers[6]), w.load(&numbers[7])],
            depth: w.load(&numbers[8]),
            body: w.load_words(&bodies),
            direction,
        }
    }
}
