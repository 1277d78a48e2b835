//! Sums of four products with a small relative error, however much they cancel.

/// The sum of the products `a[i] · b[i]` with the correct sign, zero included, and a relative error of at most 130 · 2⁻⁵³.
///
/// The plain sum, off by at most four roundings of the sum of magnitudes, suffices unless the terms nearly cancel. Then the sum is
/// expanded exactly into eight numbers (products and sums after Dekker 1971 and Knuth, the expansion after Shewchuk 1997, §2.4).
/// 2²⁷ times a component must not overflow, nor the last digits of a product underflow.
pub(super) fn sum_of_products(a: [f64; 4], b: [f64; 4]) -> f64 {
    let [p, q, r, s] = [a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]];
    let sum = p + q + r + s;
    if sum.abs() >= (p.abs() + q.abs() + r.abs() + s.abs()) * PLAIN { sum } else { expanded(a, b) }
}

/// The plain sum suffices where it is at least this part of the sum of magnitudes: its four roundings are then 128 of itself, which
/// leaves two for terms of second order.
const PLAIN: f64 = 1.0 / 32.0;

fn expanded(a: [f64; 4], b: [f64; 4]) -> f64 {
    // Nonoverlapping components, from the smallest to the largest: the last one has the sign of the sum.
    let mut expansion = [0.0; 8];
    for i in 0..4 {
        let (product, rest) = exact_product(a[i], b[i]);
        grow(&mut expansion[..=2 * i], rest);
        grow(&mut expansion[..=2 * i + 1], product);
    }
    expansion.iter().sum()
}

/// Adds a number to an expansion whose last component is zero.
fn grow(expansion: &mut [f64], number: f64) {
    let mut carried = number;
    let last = expansion.len() - 1;
    for component in &mut expansion[..last] {
        (carried, *component) = exact_sum(carried, *component);
    }
    expansion[last] = carried;
}

/// The rounded sum and its rounding error.
fn exact_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

/// The rounded product and its rounding error.
fn exact_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((a_high, a_low), (b_high, b_low)) = (halves(a), halves(b));
    (product, a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low))
}

/// A number as a sum of two numbers with half of its digits each.
fn halves(a: f64) -> (f64, f64) {
    const SPLIT: f64 = 134_217_729.0;
    let scaled = SPLIT * a;
    let high = scaled - (scaled - a);
    (high, a - high)
}

#[cfg(test)]
mod tests {
    use super::sum_of_products;
    use dashu_int::IBig;
    use proptest::prelude::*;

    /// Times 2¹⁰⁰, exactly.
    fn scaled(value: f64) -> IBig {
        let bits = value.to_bits();
        let exponent = (bits >> 52 & 0x7ff) as i32;
        let mantissa = IBig::from(bits & ((1 << 52) - 1) | 1 << 52);
        let shift = exponent - 1075 + 100;
        let magnitude = if exponent == 0 {
            IBig::ZERO
        } else if shift < 0 {
            panic!("2^-48 and above")
        } else {
            mantissa << shift as usize
        };
        if value < 0.0 { -magnitude } else { magnitude }
    }

    /// Numbers with few and with many digits, so that some sums vanish and others nearly do.
    fn number() -> impl Strategy<Value = f64> {
        let few = || (-8..=8_i32).prop_map(f64::from);
        prop_oneof![few(), -1.0..1.0, few().prop_map(|x| x * (1.0 + f64::EPSILON)), -1e12..1e12]
            .prop_map(|x: f64| if x.abs() < 1.0 / 1_048_576.0 { 0.0 } else { x })
    }

    fn check(a: [f64; 4], b: [f64; 4]) {
        let exact: IBig = a.iter().zip(&b).map(|(a, b)| scaled(*a) * scaled(*b)).sum();
        let found = sum_of_products(a, b);
        // As integers: found · 2²⁰⁰ against the exact sum, to the relative error.
        let (mantissa, exponent) = (found.abs().to_bits() & ((1 << 52) - 1) | 1 << 52, found.abs().to_bits() >> 52);
        let magnitude =
            if found == 0.0 { IBig::ZERO } else { IBig::from(mantissa) << (exponent as usize + 200 - 1075) };
        let found = if found < 0.0 { -magnitude } else { magnitude };
        let off = &found - &exact;
        let off = if off < IBig::ZERO { -off } else { off };
        let most = if exact < IBig::ZERO { -exact.clone() } else { exact.clone() } * IBig::from(130);
        assert!((off << 53_usize) <= most, "{a:?} {b:?}: {found} for {exact}");
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn any_numbers(a in prop::array::uniform4(number()), b in prop::array::uniform4(number())) {
            check(a, b);
        }

        /// The last factor is the rounded one for which the sum vanishes.
        #[test]
        fn almost_nothing_left(a in prop::array::uniform4(number()), b in prop::array::uniform3(number())) {
            let last = -(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
            let with_last = |last: f64| check([a[0], a[1], a[2], 1.0], [b[0], b[1], b[2], last]);
            prop_assume!(last == 0.0 || last.abs() > 1e-6);
            with_last(last);
            with_last(last * (1.0 + f64::EPSILON));
        }
    }
}
