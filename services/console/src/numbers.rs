/// The numbers of a picture, in the order in which they are sent.
#[derive(Debug, Default)]
pub(crate) struct Numbers(pub Vec<f32>);

impl Numbers {
    pub fn push(&mut self, number: f64) {
        self.0.push(number as f32);
    }

    pub fn extend<'a>(&mut self, numbers: impl IntoIterator<Item = &'a f64>) {
        self.0.extend(numbers.into_iter().map(|number| *number as f32));
    }

    /// So many numbers that are not known.
    pub fn unknown(&mut self, count: usize) {
        self.0.resize(self.0.len() + count, f32::NAN);
    }

    /// What `numbers` gives, or so many that are not known.
    pub fn extend_or_unknown<const COUNT: usize>(&mut self, numbers: Option<[f64; COUNT]>) {
        match numbers {
            Some(numbers) => self.extend(&numbers),
            None => self.unknown(COUNT),
        }
    }
}
