//! What `cargo run --release -p testkit --bin stability` prints: our columns keep their bounds, and the textbook's lose what they
//! are said to lose.

use shadowfit::glam::DVec3;

use testkit::stability::ALL;
use testkit::stability::measure::Comparison;
use testkit::stability::setup::{Lamp, Setup};

#[test]
fn our_columns_keep_their_bounds() {
    for (rows, table) in ALL {
        let table = table();
        assert!(!table.held.is_empty() && table.lines.iter().all(|line| line.len() == table.columns.len()));
        for held in &table.held {
            assert!(held.error <= held.bound, "rows {rows:?}, {}: {held:?}", table.heading);
        }
    }
}

/// The worst error of the textbook's construction, in f32 and in f64, for suns all around whose λw is this.
fn textbook(w: f64) -> [f64; 2] {
    let mut worst = [0.0_f64; 2];
    for step in 1..16 {
        let angle = f64::from(step) * std::f64::consts::PI / 16.0;
        let direction = DVec3::new(angle.cos(), angle.sin(), -w).as_vec3().as_dvec3();
        let Comparison { textbook, .. } = Comparison::new(&Setup::outdoors(Lamp::Sun(direction)));
        for (worst, errors) in worst.iter_mut().zip(textbook) {
            *worst = if errors.most.is_nan() { errors.most } else { worst.max(errors.most) };
        }
    }
    worst
}

/// In f32 half a thousandth and more at 10⁻⁴, 3 % and more at 10⁻⁶, and from 10⁻⁸ on nothing is left. In f64 it is the same
/// nine powers of ten later. Where there is no small number to divide by nothing is lost.
#[test]
fn the_divided_construction_loses_what_it_is_said_to() {
    for sign in [1.0, -1.0] {
        let [in_f32, in_f64] = textbook(sign * 1e-4);
        assert!(in_f32 >= 5e-4 && in_f64 <= 1e-10, "{in_f32:e}, {in_f64:e}");
        let [in_f32, in_f64] = textbook(sign * 1e-6);
        assert!((0.03..1.0).contains(&in_f32) && in_f64 <= 1e-8, "{in_f32:e}, {in_f64:e}");
        assert!(textbook(sign * 1e-8)[0].is_nan());
        assert!(textbook(sign * 1e-15)[1] >= 0.03);
        assert!(textbook(sign * 0.1)[0] <= 1e-5);
        assert!(textbook(sign * 0.0)[0] <= 1e-5);
    }
}
