//! The numbers that formulas are evaluated in: f32, f64, and 512 bits, which stand for exact ones.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use dashu_float::{FBig, round::mode::HalfEven};

/// A number with the operations that the constructions need.
pub trait Real:
    Clone
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    fn of(value: f64) -> Self;
    fn to_f64(&self) -> f64;
    fn sqrt(&self) -> Self;
    fn tan(&self) -> Self;

    fn abs(&self) -> Self {
        if *self < Self::of(0.0) { -self.clone() } else { self.clone() }
    }

    fn least(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    fn most(self, other: Self) -> Self {
        if other > self { other } else { self }
    }
}

macro_rules! machine {
    ($type:ident) => {
        impl Real for $type {
            fn of(value: f64) -> Self {
                value as Self
            }
            fn to_f64(&self) -> f64 {
                f64::from(*self)
            }
            fn sqrt(&self) -> Self {
                $type::sqrt(*self)
            }
            fn tan(&self) -> Self {
                $type::tan(*self)
            }
        }
    };
}

machine!(f32);
machine!(f64);

/// A number of 512 bits. Products of ten numbers that come from f64 are exact, and what cancels down to a millionth of a
/// millionth of f64's last bit still has hundreds of bits left: no table can tell it from an exact one.
#[derive(Clone, Debug)]
pub struct Big(FBig<HalfEven, 2>);

impl Big {
    const BITS: usize = 512;
}

impl Real for Big {
    fn of(value: f64) -> Self {
        let exact = FBig::try_from(value).expect("exact numbers are finite");
        Self(exact.with_precision(Self::BITS).value())
    }

    fn to_f64(&self) -> f64 {
        self.0.to_f64().value()
    }

    fn sqrt(&self) -> Self {
        Self(self.0.sqrt())
    }

    fn tan(&self) -> Self {
        Self(self.0.tan())
    }
}

impl PartialEq for Big {
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

impl PartialOrd for Big {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.partial_cmp(&other.0)
    }
}

macro_rules! operator {
    ($trait:ident, $name:ident) => {
        impl $trait for Big {
            type Output = Self;
            fn $name(self, other: Self) -> Self {
                Self($trait::$name(self.0, other.0))
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl Neg for Big {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}
