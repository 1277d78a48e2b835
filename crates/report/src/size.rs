//! How much is measured.

/// How much is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// Next to nothing: whether everything works. The figures mean nothing.
    Smoke,
    /// Enough for the figures to mean something.
    Full,
}

impl Size {
    /// The first or the second of two amounts.
    #[must_use]
    pub const fn of<T: Copy>(self, smoke: T, full: T) -> T {
        match self {
            Self::Smoke => smoke,
            Self::Full => full,
        }
    }
}
