use crate::Axis;
use crate::taps::Taps;

/// A stretch of rows along one axis, with what lies beyond its ends, convolved with a symmetric kernel along that axis.
#[derive(Debug, Clone)]
pub(crate) struct Convolution {
    taps: Taps,
    circular: bool,
    /// Sites along the axis.
    sites: usize,
    /// Sites that lie beside each other in each row.
    width: usize,
    /// From one row to the next; a whole number of the smallest blocks, where several sites lie beside each other.
    stride: usize,
    rows: Vec<f64>,
}

/// So many sites are computed at a time, in registers, while all taps are gone through; what is left at the end of a row, in smaller
/// blocks.
const ALONG: usize = 32;
const ACROSS: usize = 16;
const SMALL: usize = 8;

impl Convolution {
    /// Along this axis, of rows of this many sites.
    pub fn new(axis: &Axis, width: usize, taps: Taps) -> Self {
        let Axis { sites, circular, .. } = *axis;
        let stride = if width == 1 { 1 } else { width.next_multiple_of(SMALL) };
        // Rows are computed by twos, and blocks of single sites reach beyond the last one.
        let rows = (sites.next_multiple_of(SMALL) + 2 * taps.beyond.len()) * stride;
        Self { taps, circular, sites, width, stride, rows: vec![0.0; rows] }
    }

    /// Adds the convolution of each stretch of `from`, which has the axis's sites times the width, to its place in `to`.
    pub fn add_each(&mut self, from: &[f64], to: &mut [f64]) {
        let stretch = (self.sites * self.width).max(1);
        for (from, to) in from.chunks_exact(stretch).zip(to.chunks_exact_mut(stretch)) {
            self.border(from);
            if self.width == 1 {
                add_along(self, to);
            } else {
                add_across(self, to);
            }
        }
    }

    /// Copies the stretch, with what lies beyond its ends. Beyond an open one there is nothing, and was nothing before.
    fn border(&mut self, from: &[f64]) {
        let Self { width, stride, sites, .. } = *self;
        let reach = self.taps.beyond.len();
        let mut copy = |to: usize, from: &[f64]| {
            let to = &mut self.rows[to * stride..];
            if width == stride {
                return to[..from.len()].copy_from_slice(from);
            }
            let rows = to.chunks_mut(stride).zip(from.chunks_exact(width));
            rows.for_each(|(to, from)| to[..width].copy_from_slice(from));
        };
        copy(reach, from);
        if self.circular {
            copy(0, &from[(sites - reach) * width..]);
            copy(reach + sites, &from[..reach * width]);
        }
    }
}

/// Convolves a row along itself. Blocks that begin anywhere are read faster in halves of a cache line than in whole ones.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn add_along(Convolution { taps, rows, .. }: &Convolution, mut to: &mut [f64]) {
    let mut at = taps.beyond.len();
    while !to.is_empty() {
        let width = if to.len() >= ALONG { ALONG } else { to.len().min(SMALL) };
        let (block, rest) = to.split_at_mut(width);
        match width {
            ALONG => add(block, &along::<ALONG>(taps, rows, at)),
            _ => add(block, &along::<SMALL>(taps, rows, at)),
        }
        (to, at) = (rest, at + width);
    }
}

/// Convolves rows that lie beside each other, two of them at once. (With a function that adds both, a table's
/// step takes a third longer.)
#[multiversion::multiversion(targets("x86_64+avx512f", "x86_64+avx2"))]
fn add_across(Convolution { taps, width, stride, rows, .. }: &Convolution, to: &mut [f64]) {
    let mut at = taps.beyond.len() * stride;
    for to in to.chunks_mut(2 * width) {
        let (first, second) = to.split_at_mut(*width);
        for start in (0..*width).step_by(ACROSS) {
            let first = &mut first[start..];
            let second = second.get_mut(start..).unwrap_or_default();
            if first.len() > SMALL {
                let [one, other] = across::<ACROSS>(taps, rows, at + start, *stride);
                add(first, &one);
                add(second, &other);
            } else {
                let [one, other] = across::<SMALL>(taps, rows, at + start, *stride);
                add(first, &one);
                add(second, &other);
            }
        }
        at += 2 * stride;
    }
}

/// The block of a row that begins at `at`.
#[inline(always)]
fn along<const B: usize>(taps: &Taps, row: &[f64], at: usize) -> [f64; B] {
    let mut sums = block::<B>(row, at).map(|own| taps.centre * own);
    let (mut left, mut right) = (at, at);
    for &weight in &taps.beyond {
        (left, right) = (left - 1, right + 1);
        let (lefts, rights) = (block::<B>(row, left), block::<B>(row, right));
        for site in 0..B {
            sums[site] += weight * (lefts[site] + rights[site]);
        }
    }
    sums
}

/// The block of a row that begins at `at`, and the next row's: what one of them needs at some distance, the other one needs at the
/// next, and finds in a register.
#[inline(always)]
fn across<const B: usize>(taps: &Taps, rows: &[f64], at: usize, stride: usize) -> [[f64; B]; 2] {
    let (mut left, mut right) = (at, at + stride);
    let (mut near_left, mut near_right) = (*block::<B>(rows, left), *block::<B>(rows, right));
    let mut sums = [near_left, near_right].map(|own| own.map(|own| taps.centre * own));
    for &weight in &taps.beyond {
        (left, right) = (left - stride, right + stride);
        let (far_left, far_right) = (*block::<B>(rows, left), *block::<B>(rows, right));
        for site in 0..B {
            sums[0][site] += weight * (far_left[site] + near_right[site]);
            sums[1][site] += weight * (near_left[site] + far_right[site]);
        }
        (near_left, near_right) = (far_left, far_right);
    }
    sums
}

#[inline(always)]
fn block<const B: usize>(row: &[f64], at: usize) -> &[f64; B] {
    &row[at..at + B].as_chunks().0[0]
}

/// Adds a block, or what of it there is room for. Of a whole one the length is known when it is compiled: that is faster.
#[inline(always)]
fn add<const B: usize>(to: &mut [f64], sums: &[f64; B]) {
    match to.first_chunk_mut::<B>() {
        Some(to) => to.iter_mut().zip(sums).for_each(|(to, sum)| *to += sum),
        None => to.iter_mut().zip(sums).for_each(|(to, sum)| *to += sum),
    }
}
