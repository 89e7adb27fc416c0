use crate::plausible::{bounded, ensure};
use crate::{Flaw, MAX_PLACES, SiteGrid};
use bytemuck::{Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;

/// What the robot's eye sees the surface of: a depth camera's picture, mapped onto a level plane.
///
/// Of each site of a grid on the plane, how high above the plane the line of sight to it first meets something. 0: the plane
/// itself is seen there. Whatever is the cause, a board, an arm, the robot's own: what lies behind is not seen.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
pub struct Surface {
    /// Where the sites lie; none: there is no picture, and nothing is known to be in view.
    pub grid: SiteGrid,
    /// Height of the plane in the world, m: the table top.
    pub level: f64,
    /// Height of what is seen at each site, cm, rounded up; [`UNMEASURED`].
    pub height: [u8; MAX_PLACES],
}

/// The height of a site of which the camera has told nothing.
pub const UNMEASURED: u8 = u8::MAX;

/// How much higher than something what is seen in its direction must be to hide it, m: a depth camera's scatter, and its steps.
const SCATTER: f64 = 0.02;

impl Surface {
    /// How high what the eye sees in the direction of `place` reaches above it, m: the highest of the sites around that direction;
    /// `None` where the picture does not tell.
    pub fn above(&self, eye: [f64; 3], place: [f64; 3]) -> Option<f64> {
        let shadow = self.shadow(eye, place)?;
        let near = [[-0.5, -0.5], [-0.5, 0.5], [0.5, -0.5], [0.5, 0.5]];
        let sites = near.map(|side| {
            self.grid.site([0, 1].map(|axis| shadow[axis] + side[axis] * self.grid.spacing[axis]))
        });
        let highest = sites.into_iter().try_fold(0, |highest, site| {
            let height = *self.height.get(site?)?;
            (height != UNMEASURED).then_some(highest.max(height))
        });
        Some(0.01 * f64::from(highest?) - (place[2] - self.level))
    }

    /// Whether the eye may not see `place`, m: something higher is seen in its direction, or the picture does not tell.
    pub fn hides(&self, eye: [f64; 3], place: [f64; 3]) -> bool {
        self.above(eye, place).is_none_or(|above| above > SCATTER)
    }

    /// Where the line of sight through `place` meets the plane, m; `None` for a place that is not below the eye.
    pub fn shadow(&self, eye: [f64; 3], place: [f64; 3]) -> Option<[f64; 2]> {
        let (whole, part) = (eye[2] - self.level, eye[2] - place[2]);
        (part > 0.0).then(|| [0, 1].map(|axis| eye[axis] + (place[axis] - eye[axis]) * whole / part))
    }

    pub(crate) fn check(&self) -> Result<(), Flaw> {
        self.grid.check("surface.grid", MAX_PLACES)?;
        ensure(
            self.grid.used() == 0 || self.grid.spacing.iter().all(|spacing| *spacing > 0.0),
            "surface.grid.spacing",
            "more than 0",
        )?;
        bounded("surface.level", &[self.level], 100.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EYE: [f64; 3] = [0.0, 0.0, 2.0];

    /// A plane at 1 m, 1 m square, in view but for a site.
    fn surface(hidden: [f64; 2], height: u8) -> Box<Surface> {
        let mut surface: Box<Surface> = bytemuck::zeroed_box();
        surface.grid = SiteGrid { first: [-0.5, -0.5], spacing: [0.02; 2], sites: [51, 51] };
        surface.level = 1.0;
        let site = surface.grid.site(hidden).unwrap_or_default();
        surface.height[site] = height;
        surface
    }

    #[test]
    fn what_is_seen_in_a_direction_hides_what_is_lower_there() {
        let surface = surface([0.2, 0.0], 30);
        let above = |place| surface.above(EYE, place).unwrap_or(f64::NAN);
        assert!((above([0.2, 0.0, 1.0]) - 0.3).abs() < 1e-9);
        // Half way up, in the same direction.
        assert!((above([0.1, 0.0, 1.5]) + 0.2).abs() < 1e-9);
        assert!((above([0.2, 0.1, 1.0])).abs() < 1e-9, "beside it");
    }

    #[test]
    fn where_the_picture_does_not_tell_nothing_is_known() {
        let surface = surface([0.2, 0.0], UNMEASURED);
        assert_eq!(surface.above(EYE, [0.2, 0.0, 1.0]), None, "not measured");
        assert_eq!(surface.above(EYE, [0.6, 0.0, 1.0]), None, "beside the picture");
        assert_eq!(surface.above(EYE, [0.0, 0.0, 2.0]), None, "not below the eye");
        assert_eq!(surface.above(EYE, [f64::NAN, 0.0, 1.0]), None, "nowhere");
        let none: Box<Surface> = bytemuck::zeroed_box();
        assert_eq!(none.above(EYE, [0.0, 0.0, 1.0]), None, "no picture");
    }
}
