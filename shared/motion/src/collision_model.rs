use crate::frames::Frames;
use crate::{Capsule, Clearance, Counterpart, Link, Mechanism, Scene, SegmentKind, Solid};
use coact_robot::Posture;
use nalgebra::{Isometry3, Point3};

/// The forms of arm, hand and held part, which move with the arm's joints. The fingers stand still in it, or pass from one
/// shape of the hand to another during a movement.
#[derive(Debug, Clone)]
pub struct CollisionModel {
    pub(crate) links: Vec<Link>,
    /// Pairs of links that could touch each other.
    pub(crate) pairs: Vec<(usize, usize)>,
    /// A sphere around all links of the hand, in the frame of the arm's last joint.
    pub(crate) hand: Option<Capsule>,
}

/// Difference of the numbers of joints that carry two links from which on their distance is watched. Chosen by hand: the
/// forms of links that are nearer to each other along the arm overlap around the joints between them.
const SEPARATING: usize = 3;

impl CollisionModel {
    /// A collision model of these links. Pairs whose numbers of carrying joints differ by at least [`SEPARATING`] are
    /// watched, but for those that touch each other in the park posture: their forms are too coarse to tell how far they
    /// are apart, or one is mounted on the other.
    pub(crate) fn new(mechanism: &Mechanism, links: Vec<Link>) -> Self {
        let apart = |one: &Link, other: &Link| one.carriers.abs_diff(other.carriers) >= SEPARATING;
        let mut pairs = Vec::new();
        for one in 0..links.len() {
            pairs.extend(
                (0..one).filter(|&other| apart(&links[one], &links[other])).map(|other| (one, other)),
            );
        }
        let of_hand = || links.iter().filter(|link| link.hand);
        let ends: Vec<Point3<f64>> =
            of_hand().flat_map(|link| [link.bounding_capsule.start, link.bounding_capsule.end]).collect();
        let hand = Capsule::around_points(&ends).map(|around| {
            let centre = nalgebra::center(&around.start, &around.end);
            let reach = |link: &Link| {
                let ends = [link.bounding_capsule.start, link.bounding_capsule.end];
                link.bounding_capsule.radius
                    + ends.iter().map(|end| (end - centre).norm()).fold(0.0, f64::max)
            };
            Capsule { start: centre, end: centre, radius: of_hand().map(reach).fold(0.0, f64::max) }
        });
        let (mut collision_model, mut touching) = (Self { links, pairs, hand }, Vec::new());
        let scene = Scene::default();
        let mut near = Vec::new();
        for segment in SegmentKind::ALL {
            let clearance =
                Clearance { mechanism, collision_model: &collision_model, scene: &scene, segment };
            clearance.near(&mechanism.park, 0.0, &mut near);
            touching.append(&mut near);
        }
        let touches = |&(one, other): &(usize, usize)| {
            touching.iter().any(|near| near.link == one && near.other == Counterpart::Link(other))
        };
        collision_model.pairs.retain(|pair| !touches(pair));
        collision_model
    }

    /// Its links.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// The same with a part in the hand, the frame of the part's form at `place` in the palm frame.
    pub fn holding(
        mut self,
        mechanism: &Mechanism,
        name: &str,
        solid: Solid,
        place: &Isometry3<f64>,
    ) -> Self {
        let place = mechanism.arm.tool * place;
        self.links.push(Link::new(name, mechanism.joints(), solid, place, true));
        Self::new(mechanism, self.links)
    }

    /// Bounding capsules of all links that the arm's joints move, in the world, for a posture of the arm, into `out`.
    pub fn moving_bounding_capsules(&self, mechanism: &Mechanism, posture: &Posture, out: &mut Vec<Capsule>) {
        let frames = Frames::of(mechanism, posture);
        let moving = self.links.iter().filter(|link| link.carriers > 0);
        out.clear();
        out.extend(moving.map(|link| link.bounding_capsule.within(&frames.carrier(link))));
    }

    /// Where the forms of all links stand in the world, for a posture of the arm.
    pub fn places(&self, mechanism: &Mechanism, posture: &Posture) -> Vec<Isometry3<f64>> {
        let frames = Frames::of(mechanism, posture);
        self.links.iter().map(|link| frames.carrier(link) * link.place).collect()
    }

    /// Bounding capsules of all links in the world, for a posture of the arm.
    pub fn bounding_capsules(&self, mechanism: &Mechanism, posture: &Posture) -> Vec<Capsule> {
        let frames = Frames::of(mechanism, posture);
        self.links.iter().map(|link| link.bounding_capsule.within(&frames.carrier(link))).collect()
    }
}
