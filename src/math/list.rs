//! Lists with their items in place, without allocation.

/// Gives `$list` the methods of a list of the first `len` items of an array: `as_slice`, `iter`, `len`, indexing, `for … in &list`.
macro_rules! list {
    ($list:ident $(<$life:lifetime>)?, $item:ty, $array:ident, $what:literal) => {
        impl<$($life)?> $list<$($life)?> {
            #[doc = concat!("The ", $what, ", as a slice.")]
            #[must_use]
            pub fn as_slice(&self) -> &[$item] {
                &self.$array[..self.len]
            }

            #[doc = concat!("The ", $what, ", one after another.")]
            pub fn iter(&self) -> core::slice::Iter<'_, $item> {
                self.as_slice().iter()
            }

            #[doc = concat!("How many ", $what, " there are.")]
            #[must_use]
            pub const fn len(&self) -> usize {
                self.len
            }

            /// Whether there are none.
            #[must_use]
            pub const fn is_empty(&self) -> bool {
                self.len == 0
            }
        }

        impl<$($life)?> core::ops::Index<usize> for $list<$($life)?> {
            type Output = $item;
            fn index(&self, index: usize) -> &$item {
                &self.as_slice()[index]
            }
        }

        impl<'list, $($life)?> IntoIterator for &'list $list<$($life)?> {
            type Item = &'list $item;
            type IntoIter = core::slice::Iter<'list, $item>;
            fn into_iter(self) -> Self::IntoIter {
                self.iter()
            }
        }
    };
}
pub(crate) use list;
