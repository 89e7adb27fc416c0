use crate::Pointer;

/// What a page wants of the run, which the console passes on at once.
#[derive(Debug, Clone, PartialEq)]
pub enum Wish {
    /// The partner's hand is there.
    Point(Pointer),
    /// It is not seen any more.
    Hide,
    /// The person says this.
    Say(String),
}
