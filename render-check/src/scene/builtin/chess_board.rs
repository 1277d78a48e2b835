//! The built-in scene: a long chess board that recedes from a low camera, after Fig. 1 of the perspective shadow maps
//! paper (Stamminger & Drettakis 2002). One square is one unit; the board's near edge lies along z = 0.

use shadowfit::glam::{DMat4, DVec2, DVec3};

use super::solids::{add_box, add_cut_out, add_turned};
use crate::scene::{Camera, LightSpec, LoadedScene, MeshBuilder};

const FILES: u32 = 8;
const RANKS: u32 = 24;
const BOARD_THICKNESS: f64 = 0.3;
const BORDER: f64 = 0.5;

const LIGHT_SQUARE: [f32; 3] = [0.78, 0.66, 0.46];
const DARK_SQUARE: [f32; 3] = [0.20, 0.09, 0.045];
const BORDER_WOOD: [f32; 3] = [0.10, 0.045, 0.025];
const WHITE_PIECE: [f32; 3] = [0.85, 0.78, 0.62];
const BLACK_PIECE: [f32; 3] = [0.055, 0.05, 0.055];

/// The profiles of the pieces, bottom to top, as (radius, height).
const BASE: [(f64, f64); 6] = [(0.0, 0.0), (0.36, 0.0), (0.37, 0.07), (0.34, 0.14), (0.27, 0.18), (0.24, 0.24)];
const PAWN: [(f64, f64); 13] = [
    (0.17, 0.34),
    (0.12, 0.50),
    (0.11, 0.60),
    (0.20, 0.63),
    (0.20, 0.66),
    (0.11, 0.69),
    (0.17, 0.74),
    (0.205, 0.81),
    (0.21, 0.88),
    (0.19, 0.96),
    (0.14, 1.02),
    (0.07, 1.06),
    (0.0, 1.07),
];
const ROOK: [(f64, f64); 9] = [
    (0.21, 0.34),
    (0.18, 0.60),
    (0.18, 0.80),
    (0.26, 0.86),
    (0.28, 0.90),
    (0.28, 1.06),
    (0.19, 1.06),
    (0.19, 1.0),
    (0.0, 1.0),
];
const KNIGHT_FOOT: [(f64, f64); 4] = [(0.25, 0.30), (0.26, 0.36), (0.20, 0.40), (0.0, 0.40)];
const BISHOP: [(f64, f64); 15] = [
    (0.18, 0.34),
    (0.13, 0.60),
    (0.11, 0.85),
    (0.22, 0.90),
    (0.22, 0.93),
    (0.12, 0.97),
    (0.17, 1.03),
    (0.195, 1.11),
    (0.19, 1.20),
    (0.15, 1.32),
    (0.09, 1.42),
    (0.045, 1.47),
    (0.06, 1.50),
    (0.05, 1.54),
    (0.0, 1.56),
];
const QUEEN: [(f64, f64); 13] = [
    (0.20, 0.36),
    (0.14, 0.70),
    (0.12, 1.05),
    (0.24, 1.11),
    (0.24, 1.14),
    (0.13, 1.18),
    (0.16, 1.32),
    (0.25, 1.55),
    (0.21, 1.56),
    (0.12, 1.60),
    (0.07, 1.64),
    (0.08, 1.70),
    (0.0, 1.76),
];
const KING: [(f64, f64); 11] = [
    (0.21, 0.36),
    (0.15, 0.75),
    (0.13, 1.15),
    (0.25, 1.21),
    (0.25, 1.24),
    (0.14, 1.28),
    (0.17, 1.42),
    (0.24, 1.64),
    (0.22, 1.68),
    (0.10, 1.74),
    (0.0, 1.75),
];
/// The knight's head, seen from its left side: rows from bottom to top, each from the nose's side to the mane.
const KNIGHT_HEAD: [[(f64, f64); 2]; 9] = [
    [(-0.17, 0.38), (0.19, 0.38)],
    [(-0.13, 0.52), (0.22, 0.52)],
    [(-0.06, 0.66), (0.24, 0.68)],
    [(-0.12, 0.76), (0.24, 0.84)],
    [(-0.31, 0.80), (0.22, 0.98)],
    [(-0.34, 0.90), (0.18, 1.08)],
    [(-0.25, 1.00), (0.12, 1.16)],
    [(-0.10, 1.12), (0.06, 1.22)],
    [(-0.02, 1.26), (0.02, 1.28)],
];

#[derive(Clone, Copy)]
enum Piece {
    Pawn,
    Rook,
    Knight,
    Bishop,
    Queen,
    King,
}

/// Where the pieces stand: (piece, file from the left, rank from the near edge). White first, then black.
const WHITE: [(Piece, u32, u32); 13] = [
    (Piece::Rook, 0, 1),
    (Piece::Pawn, 1, 3),
    (Piece::Bishop, 2, 2),
    (Piece::King, 5, 2),
    (Piece::Pawn, 6, 3),
    (Piece::Pawn, 4, 4),
    (Piece::Knight, 3, 5),
    (Piece::Pawn, 7, 4),
    (Piece::Queen, 1, 7),
    (Piece::Pawn, 3, 8),
    (Piece::Pawn, 0, 5),
    (Piece::Rook, 6, 7),
    (Piece::Knight, 6, 10),
];
const BLACK: [(Piece, u32, u32); 14] = [
    (Piece::Pawn, 2, 10),
    (Piece::Knight, 4, 10),
    (Piece::Bishop, 6, 13),
    (Piece::Pawn, 0, 12),
    (Piece::Pawn, 5, 15),
    (Piece::Queen, 2, 15),
    (Piece::Pawn, 7, 16),
    (Piece::Pawn, 3, 17),
    (Piece::Pawn, 1, 18),
    (Piece::King, 4, 21),
    (Piece::Rook, 0, 22),
    (Piece::Bishop, 2, 21),
    (Piece::Knight, 6, 20),
    (Piece::Rook, 7, 22),
];

/// Makes the scene with its camera and three lights: a sun, a lamp over the board and a spot beside it.
pub(super) fn make() -> LoadedScene {
    let mut builder = MeshBuilder::default();
    add_board(&mut builder);
    for (pieces, colour, turn) in [(&WHITE[..], WHITE_PIECE, -0.5), (&BLACK[..], BLACK_PIECE, 2.4)] {
        for &(piece, file, rank) in pieces {
            let foot = DVec3::new(f64::from(file) - 3.5, 0.0, -f64::from(rank) - 0.5);
            add_piece(&mut builder, piece, DMat4::from_translation(foot) * DMat4::from_rotation_y(turn), colour);
        }
    }
    let (mesh, left_out) = builder.finish();
    let eye = DVec3::new(0.9, 2.1, 2.6);
    let target = DVec3::new(-0.1, 0.1, -4.4);
    LoadedScene {
        name: "chess-board".into(),
        mesh,
        camera: Some(Camera {
            eye,
            forward: (target - eye).normalize(),
            up: DVec3::Y,
            fov_y: 42_f64.to_radians(),
            near: Some(1.0),
            far: Some(28.0),
        }),
        lights: vec![
            LightSpec::Sun { direction_to_light: DVec3::new(-0.8, 0.6, 0.2) },
            LightSpec::Point { position: DVec3::new(-1.6, 7.0, -8.0), range: f64::INFINITY },
            LightSpec::Spot {
                position: DVec3::new(6.0, 6.0, -1.0),
                target: DVec3::new(0.0, 0.0, -5.0),
                cone_degrees: 50.0,
                range: f64::INFINITY,
            },
        ],
        left_out,
    }
}

fn add_board(builder: &mut MeshBuilder) {
    let (half_width, length) = (f64::from(FILES) / 2.0, f64::from(RANKS));
    // The border's top lies a little lower than the squares, so that no two surfaces coincide.
    let corner = DVec3::new(half_width + BORDER, 0.0, BORDER);
    let min = DVec3::new(-corner.x, -BOARD_THICKNESS, -length - BORDER);
    add_box(builder, min, corner - 0.02 * DVec3::Y, DMat4::IDENTITY, BORDER_WOOD);
    for file in 0..FILES {
        for rank in 0..RANKS {
            let colour = if (file + rank) % 2 == 0 { DARK_SQUARE } else { LIGHT_SQUARE };
            let max = DVec3::new(f64::from(file) + 1.0 - half_width, 0.0, -f64::from(rank));
            add_box(builder, max - DVec3::new(1.0, 0.1, 1.0), max, DMat4::IDENTITY, colour);
        }
    }
}

fn add_piece(builder: &mut MeshBuilder, piece: Piece, world_from_piece: DMat4, colour: [f32; 3]) {
    let body: &[(f64, f64)] = match piece {
        Piece::Pawn => &PAWN,
        Piece::Rook => &ROOK,
        Piece::Knight => &KNIGHT_FOOT,
        Piece::Bishop => &BISHOP,
        Piece::Queen => &QUEEN,
        Piece::King => &KING,
    };
    let profile: Vec<DVec2> = BASE.iter().chain(body).copied().map(DVec2::from).collect();
    add_turned(builder, &profile, world_from_piece, colour);
    match piece {
        Piece::Knight => {
            let rows = KNIGHT_HEAD.map(|ends| ends.map(DVec2::from));
            add_cut_out(builder, &rows, [-0.1, 0.1], world_from_piece, colour);
        }
        Piece::Rook => {
            for quarter in 0..4 {
                let turn = DMat4::from_rotation_y(f64::from(quarter) * std::f64::consts::FRAC_PI_2);
                let (min, max) = (DVec3::new(0.19, 1.0, -0.1), DVec3::new(0.27, 1.18, 0.1));
                add_box(builder, min, max, world_from_piece * turn, colour);
            }
        }
        Piece::King => {
            let bars = [([-0.035, 1.72, -0.03], [0.035, 2.02, 0.03]), ([-0.11, 1.86, -0.03], [0.11, 1.93, 0.03])];
            for (min, max) in bars {
                add_box(builder, min.into(), max.into(), world_from_piece, colour);
            }
        }
        Piece::Pawn | Piece::Bishop | Piece::Queen => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_board_recedes_from_the_camera_and_the_pieces_stand_on_it() {
        let scene = make();
        let (min, max) = scene.mesh.bounds();
        assert_eq!((min.x, max.x), (-4.5, 4.5));
        assert_eq!((min.z, max.z), (-24.5, 0.5));
        assert_eq!((min.y, max.y), (-BOARD_THICKNESS, 2.02));
        assert!(scene.left_out.is_nothing(), "{}", scene.left_out);
        let camera = scene.camera.expect("the scene has a camera");
        assert!(camera.forward.z < -0.9 && camera.eye.z > max.z);
    }

    #[test]
    fn no_square_holds_two_pieces() {
        let mut squares: Vec<_> = WHITE.iter().chain(&BLACK).map(|&(_, file, rank)| (file, rank)).collect();
        assert!(squares.iter().all(|&(file, rank)| file < FILES && rank < RANKS));
        squares.sort_unstable();
        squares.dedup();
        assert_eq!(squares.len(), WHITE.len() + BLACK.len());
    }
}
