//! Cases in which a long run once found something lost.
//!
//! In all of them the view is a needle, with a field of view of a thousandth, and the light is behind the eye on the view's
//! axis, almost in the planes of all sides at once: their values there were rounding, and a plane that is the sum of two by
//! such factors turned about the edge, which is far away.

use crate::arbitrary::{Case, LightParams, Pose, SceneParams, ViewParams};
use crate::focus::check;

fn check_one(case: &Case) {
    check(case, &mut Default::default());
}

/// A scene that is a flat strip, and a lamp behind the eye: 1e-15 of the paper's H.
#[test]
fn needle_at_a_segment() {
    check_one(&Case {
        view: ViewParams::Perspective {
            pose: Pose {
                eye: [0.004_765_272_048_652_74, -0.004_300_255_101_551_981_5, 0.004_321_876_754_441_234],
                forward: [0.613_958_652_232_036_8, -0.760_559_917_042_816_9, -0.211_195_137_106_052_87],
                up: [-0.030_304_413_638_843_453, 1.027_003_237_267_391, -0.029_197_049_355_831_523],
            },
            fov_y: 0.001,
            aspect: 0.620_232_452_712_229_7,
            near: 0.000_457_584_182_248_922_47,
            far: Some(366.121_523_495_159_64),
        },
        light: LightParams::Point {
            position: [-86.329_434_071_500_24, 106.914_959_746_149_49, 29.750_440_932_370_317],
            near: 0.000_480_459_359_146_555_84,
            range: None,
        },
        scene: SceneParams::Bounds {
            min: [0.004_985_527_009_403_167, -0.062_320_407_061_167_68, 0.004_096_573_147_491_012_5],
            max: [0.005_166_093_054_547_855, 0.052_950_655_356_135_91, 0.004_096_573_147_491_012_5],
        },
    });
}

/// The sun behind the eye, and a far plane a thousand times as far as the scene: 1e-12 of the paper's H.
#[test]
fn needle_over_a_slab() {
    check_one(&Case {
        view: ViewParams::Perspective {
            pose: Pose {
                eye: [-2.573_198_746_708_6, -3.460_185_056_469_031_3, -1.341_095_300_056_747_6],
                forward: [0.351_518_331_759_294_7, -0.299_112_357_382_375_1, -0.887_111_413_576_852_1],
                up: [0.047_794_731_772_872_495, 1.014_580_245_560_271_3, -0.001_755_008_308_061_728_2],
            },
            fov_y: 0.001,
            aspect: 1.792_831_856_966_975_2,
            near: 0.125_880_777_841_914_12,
            far: Some(49_794.530_223_425_456),
        },
        light: LightParams::Directional {
            direction_to_light: [-0.351_518_331_759_294_8, 0.299_112_357_382_374_3, 0.887_111_413_576_852_3],
        },
        scene: SceneParams::Bounds {
            min: [-60.404_640_407_809_836, -3.265_154_789_461_905_5, -1.948_578_020_826_072_8],
            max: [56.559_725_696_535_51, -2.824_017_737_845_806_2, -1.577_205_029_621_542_7],
        },
    });
}

/// The sun exactly behind the eye: 3e-14 of the paper's H.
#[test]
fn needle_in_a_cut_box() {
    check_one(&Case {
        view: ViewParams::Perspective {
            pose: Pose {
                eye: [0.0, 0.0, 0.0],
                forward: [0.575_704_270_083_145_3, 0.704_682_574_787_839_7, -0.414_713_228_868_351_5],
                up: [0.032_391_681_020_378_47, 0.994_321_733_900_772_4, 0.037_663_461_003_742_287],
            },
            fov_y: 0.001,
            aspect: 1.565_337_912_611_967_8,
            near: 0.998_024_638_119_449_9,
            far: Some(11_667.993_719_709_486),
        },
        light: LightParams::Directional {
            direction_to_light: [-0.575_704_270_083_145_3, -0.704_682_574_787_839_7, 0.414_713_228_868_351_5],
        },
        scene: SceneParams::Cut {
            min: [-6.501_916_699_126_052, -7.328_830_780_038_987, -12.357_528_437_059_216],
            max: [6.396_224_962_758_011, 7.899_904_583_544_64, 12.290_553_621_936_319],
            planes: vec![
                [
                    0.796_941_031_984_558_8,
                    0.089_794_794_416_474_77,
                    0.597_345_700_943_004_7,
                    0.036_478_872_278_038_45,
                ],
                [-1.0, -1.0, 1.0, 26.653_657_983_361_867],
                [0.103_485_957_172_863_3, 0.183_660_329_890_129_3, 0.977_527_257_877_070_7, -5.984_483_909_748_033],
                [-1.0, -1.0, 1.0, -10.081_934_878_422_523],
            ],
        },
    });
}

/// A lamp behind the eye, and a scene that is almost flat: 3e-16 of the paper's H.
#[test]
fn needle_in_a_sheet() {
    check_one(&Case {
        view: ViewParams::Perspective {
            pose: Pose {
                eye: [0.0, 0.0, 0.0],
                forward: [-0.144_649_500_048_220_6, 0.814_637_933_337_703_3, -0.561_641_842_906_202_4],
                up: [0.035_362_856_013_752_164, 0.974_522_283_486_921_8, -0.024_502_130_026_384_506],
            },
            fov_y: 0.001,
            aspect: 1.903_903_788_534_042_9,
            near: 0.000_390_082_304_757_403_7,
            far: Some(65.788_409_503_805_57),
        },
        light: LightParams::Point {
            position: [3.795_834_858_828_581_3, -21.253_684_432_035_087, 14.640_217_190_066_716],
            near: 5.455_066_550_085_133e-5,
            range: None,
        },
        scene: SceneParams::Bounds {
            min: [-0.027_411_245_788_861_588, 0.000_829_981_255_862_823, -0.027_411_245_788_861_588],
            max: [0.027_411_245_788_861_588, 0.000_829_981_257_522_785_7, 0.027_411_245_788_861_588],
        },
    });
}
