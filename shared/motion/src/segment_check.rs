//! Checks of an attempt's segments against everything that they must keep.

use crate::attempt::Attempt;
use crate::{Proximity, Refusal, Segment, SegmentKind, SegmentMotion};

/// Points at which leaving, approaching and line constraints are looked at. A trade-off: leaving and approaching are 5 to
/// 15 cm long, so that the points are less than 1 cm apart.
pub(crate) const SPARSE: u32 = 24;
/// Points at which a reach is checked. A trade-off with the time of planning: on a reach of half a metre they are 5 mm
/// apart.
pub(crate) const DENSE: u32 = 96;

/// A point of a reach, as the fraction of its duration, and what is nearest there.
pub(crate) type Closest = (f64, Proximity);

impl Attempt<'_> {
    /// Checks all segments.
    ///
    /// # Errors
    /// The constraint that is not kept.
    pub fn check(&self, segments: &[Segment]) -> Result<(), Refusal> {
        self.check_straight_segments(segments)?;
        self.check_lines(segments)?;
        let reaches = segments.iter().filter(|segment| segment.kind == SegmentKind::Reach);
        let mut closest = reaches.filter_map(|segment| {
            self.closest_where(&segment.motion, &|s| self.required_on_reach(segments, segment, s))
        });
        closest.next().map_or(Ok(()), |closest| Err(self.no_path(&closest)))
    }

    /// Leaving and approaching must be clear: no bounce helps them.
    pub(crate) fn check_straight_segments(&self, segments: &[Segment]) -> Result<(), Refusal> {
        let straight = segments.iter().filter(|segment| segment.kind != SegmentKind::Reach);
        let near = straight.flat_map(|segment| {
            let clearance = self.clearance.at(segment.kind);
            fractions(SPARSE).filter_map(move |s| {
                let required = self.required_on_straight(segment.kind, s);
                let near = clearance.nearest(&segment.motion.posture(s), required)?;
                Some((required - near.distance, near))
            })
        });
        match near.max_by(|one, other| one.0.total_cmp(&other.0)) {
            None => Ok(()),
            Some((short, near)) => {
                let (link, other) = self.clearance.names(&near);
                Err(Refusal::Blocked { link, other, short })
            }
        }
    }

    /// The hand must keep to its line where it leaves something, and where what it holds goes into something.
    fn check_lines(&self, segments: &[Segment]) -> Result<(), Refusal> {
        let mechanism = self.clearance.mechanism;
        let excesses = self.line_constraints(segments).flat_map(|line| {
            let motion = &segments[line.segment].motion;
            fractions(SPARSE).map(move |s| line.excess(&mechanism.arm.palm(&motion.posture(s))))
        });
        let short = excesses.fold(0.0, f64::max);
        if short > 0.0 {
            let (link, other) =
                ("the hand".to_owned(), "the side of the place that it leaves or goes into".to_owned());
            return Err(Refusal::NoPath { link, other, short, fraction: 1.0 });
        }
        Ok(())
    }

    /// The point of a reach that comes nearest to something, if it is nearer than required.
    pub(crate) fn closest(&self, reach: &SegmentMotion) -> Option<Closest> {
        self.closest_where(reach, &|s| self.min_clearance.at(s))
    }

    fn closest_where(&self, reach: &SegmentMotion, required: &dyn Fn(f64) -> f64) -> Option<Closest> {
        let found = fractions(DENSE)
            .filter_map(|s| Some((s, self.clearance.nearest(&reach.posture(s), required(s))?)));
        found.min_by(|one, other| one.1.distance.total_cmp(&other.1.distance))
    }

    pub(crate) fn no_path(&self, (fraction, near): &Closest) -> Refusal {
        let (link, other) = self.clearance.names(near);
        let short = self.min_clearance.at(*fraction) - near.distance;
        Refusal::NoPath { link, other, short, fraction: *fraction }
    }
}

/// Equally spaced fractions from 0 to 1, both included.
fn fractions(count: u32) -> impl Iterator<Item = f64> {
    (0..=count).map(move |point| f64::from(point) / f64::from(count))
}
