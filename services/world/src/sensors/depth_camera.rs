//! The depth camera beside the recogniser's: what is in view of the table.

use super::lines_of_sight::LinesOfSight;
use coact_joint_task::Scene;
use coact_messages::{MAX_PLACES, SiteGrid, Surface};
use coact_person::box_before;
use rand::Rng;
use rand_distr::{Distribution, StandardNormal};
use std::ops::Range;

/// Scatter of a measured height, m. Chosen by hand, of the size of what depth cameras reach at a metre and a half.
const SCATTER: f64 = 0.003;
/// How far the picture reaches beyond the table top, m: parts that stand on the table's edge are seen against what lies behind it.
const BEYOND: f64 = 0.10;
/// Distance of neighbouring sites, m, where so fine a picture fits.
const FINEST: f64 = 0.02;
/// How far below the eye what is higher counts as being, m: its shadow is finite.
const BELOW_EYE: f64 = 0.05;

/// Takes a picture of the table.
pub(crate) fn picture<R: Rng>(sight: &LinesOfSight, scene: &Scene, rng: &mut R, out: &mut Surface) {
    (out.grid, out.level) = (grid(scene), scene.table_height);
    let mut scattered =
        || -> f64 { SCATTER * <StandardNormal as Distribution<f64>>::sample(&StandardNormal, rng) };
    for height in &mut out.height[..out.grid.used()] {
        *height = centimetres(scattered());
    }
    for own in sight.boxes {
        let [x, y, z, half_x, half_y, half_z] = *own;
        let corners = [[x - half_x, y - half_y, z - half_z], [x + half_x, y + half_y, z + half_z]];
        raise(sight.eye, out, corners, |place| box_before(own, sight.eye, place, 0.0));
    }
    for limb in sight.limbs() {
        let (low, high) = (limb.start.inf(&limb.end), limb.start.sup(&limb.end));
        let corners = [low.map(|end| end - limb.radius), high.map(|end| end + limb.radius)].map(Into::into);
        raise(sight.eye, out, corners, |place| sight.met(limb, place));
    }
}

/// Sites over the table top, as fine as there is room for.
fn grid(scene: &Scene) -> SiteGrid {
    let size = scene.table_size.map(|size| size + 2.0 * BEYOND);
    let spacing = FINEST.max((size[0] * size[1] / (0.9 * MAX_PLACES as f64)).sqrt());
    let first = [0, 1].map(|axis| scene.table_centre[axis] - 0.5 * size[axis]);
    SiteGrid { first, spacing: [spacing; 2], sites: size.map(|size| (size / spacing) as u32) }
}

/// Raises the sites in whose direction something is met, whose least and greatest `corners` are these.
fn raise(eye: [f64; 3], out: &mut Surface, corners: [[f64; 3]; 2], met: impl Fn([f64; 3]) -> Option<f64>) {
    let [rows, columns] = shadow(eye, out, corners);
    for row in rows {
        for site in columns.clone().map(|column| row * out.grid.sites[1] as usize + column) {
            let [x, y] = out.grid.place(site);
            if let Some(fraction) = met([x, y, out.level]) {
                let height = centimetres((1.0 - fraction) * (eye[2] - out.level));
                out.height[site] = out.height[site].max(height);
            }
        }
    }
}

/// The rows and the columns of the sites that what has these corners may stand before.
fn shadow(eye: [f64; 3], out: &Surface, [low, high]: [[f64; 3]; 2]) -> [Range<usize>; 2] {
    let highest = eye[2] - BELOW_EYE;
    let heights = [low[2], high[2]].map(|z| z.clamp(out.level, highest));
    [0, 1].map(|axis| {
        let on_plane =
            |side: f64, z: f64| eye[axis] + (side - eye[axis]) * (eye[2] - out.level) / (eye[2] - z);
        let ends = heights.map(|z| [on_plane(low[axis], z), on_plane(high[axis], z)]);
        let ends =
            ends.as_flattened().iter().map(|end| (end - out.grid.first[axis]) / out.grid.spacing[axis]);
        let (least, most) =
            (ends.clone().fold(f64::INFINITY, f64::min), ends.fold(f64::NEG_INFINITY, f64::max));
        let sites = f64::from(out.grid.sites[axis]);
        least.clamp(0.0, sites) as usize..(most + 1.0).ceil().clamp(0.0, sites) as usize
    })
}

/// Of a height, m, rounded up.
fn centimetres(height: f64) -> u8 {
    // Not by `ceil`, which is a call where the processor may be any: each of some thousand sites is rounded twice.
    let height = (100.0 * height).clamp(0.0, 254.0);
    let whole = height as u8;
    whole + u8::from(f64::from(whole) < height)
}
