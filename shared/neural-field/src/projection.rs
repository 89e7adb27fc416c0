use crate::Lattice;

/// What one field adds to another one's input: for each site of the target, a weighted sum of some sites of the source.
///
/// Transforms of coordinates (moved, turned, scaled), dimensions that are left out and dimensions that are added are all of this kind,
/// made once and applied in each step.
#[derive(Debug, Clone)]
pub struct Projection {
    sources: usize,
    /// Where the terms of each target site begin, and where the last one's end.
    begins: Vec<usize>,
    terms: Vec<(usize, f64)>,
}

impl Projection {
    /// Each target site reads the source at the place that `place` gives for it, between its sites (multilinear); none, nothing.
    pub fn reading<const S: usize, const T: usize>(
        source: &Lattice<S>,
        target: &Lattice<T>,
        place: impl Fn([f64; T]) -> Option<[f64; S]>,
    ) -> Self {
        let (mut begins, mut terms) = (vec![0], Vec::new());
        for site in 0..target.sites() {
            terms.extend(place(target.place(site)).into_iter().flat_map(|place| source.around(place)));
            begins.push(terms.len());
        }
        Self { sources: source.sites(), begins, terms }
    }

    /// Each source site adds its length, area or volume, times its value, to the target at the place that `place` gives for it (divided among the
    /// sites around that place): a dimension that has no counterpart is integrated over.
    pub fn gathering<const S: usize, const T: usize>(
        source: &Lattice<S>,
        target: &Lattice<T>,
        place: impl Fn([f64; S]) -> Option<[f64; T]>,
    ) -> Self {
        let mut of_target = vec![Vec::new(); target.sites()];
        let density = source.element() / target.element();
        for site in 0..source.sites() {
            for (at, share) in place(source.place(site)).into_iter().flat_map(|place| target.around(place)) {
                of_target[at].push((site, share * density));
            }
        }
        let (mut begins, mut terms) = (vec![0], Vec::new());
        for own in of_target {
            terms.extend(own);
            begins.push(terms.len());
        }
        Self { sources: source.sites(), begins, terms }
    }

    /// Adds `gain` times what is projected to the input of the target.
    pub fn add(&self, gain: f64, output: &[f64], input: &mut [f64]) {
        assert_eq!((output.len(), input.len()), (self.sources, self.begins.len() - 1));
        for (input, bounds) in input.iter_mut().zip(self.begins.windows(2)) {
            let terms = &self.terms[bounds[0]..bounds[1]];
            *input += gain * terms.iter().map(|(site, weight)| weight * output[*site]).sum::<f64>();
        }
    }
}
