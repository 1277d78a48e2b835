//! Checks of the sign filter against the exact signs.

use std::cmp::Ordering;

use super::random::Random;
use testkit::oracle::exact::scale;
use testkit::oracle::homogeneous::Homogeneous;
use testkit::oracle::scalar::{cross, dot, minors};

/// Four vectors that are dependent up to rounding, and their exact determinant's sign, against
/// the filter: it may be silent, but never wrong, and on generic vectors it speaks.
#[test]
fn filter_is_never_wrong() {
    let mut random = Random::new(7);
    let mut spoke = [0, 0];
    let cases = 5000;
    for case in 0..cases {
        let mut vector = || -> [f64; 4] { std::array::from_fn(|_| scale(random.signed(), -random.integer(0, 30))) };
        let [a, b, c, generic] = std::array::from_fn(|_| vector());
        let nearly: [f64; 4] = std::array::from_fn(|i| 0.7 * a[i] - 1.3 * b[i] + 0.1 * c[i]);
        for (kind, d) in [generic, nearly].into_iter().enumerate() {
            let [a, b, c, d] = [a, b, c, d].map(Homogeneous::from_f64);
            let exact = cross(&minors(a.coords(), b.coords()), c.coords());
            let exact = dot(&exact, d.coords()).cmp(&dashu_int::IBig::ZERO);
            let [a, b, c, d] = [&a, &b, &c, &d].map(|v| v.rounded().expect("similar sizes"));
            let sign = dot(&cross(&minors(a, b), c), d).sign();
            assert!(sign.is_none_or(|sign| sign == exact), "case {case}");
            spoke[kind] += usize::from(sign.is_some_and(|sign| sign != Ordering::Equal));
        }
    }
    assert!(spoke[0] > cases * 9 / 10, "generic signs are certain");
    assert!(spoke[1] < cases / 2, "nearly dependent vectors try the bound");
}

/// Where components differ too much in size the filter is off, and the exact sign still right.
#[test]
fn filter_turns_off_for_extreme_components() {
    let tiny = Homogeneous::from_f64([1.0, 0.0, 0.0, 1e-300]);
    assert!(tiny.rounded().is_none());
    let at = |x: f64| Homogeneous::from_position([x, 0.0, 0.0]);
    assert_eq!(tiny.side(&at(-1e-300)), Ordering::Equal);
    assert_eq!(tiny.side(&at(-2e-300)), Ordering::Less);
    assert_eq!(tiny.side(&at(0.0)), Ordering::Greater);
}
