//! Cases in which something was wrong once.
//!
//! In all that are called needles the view is one, with a field of view of a thousandth, and the light is behind the eye on
//! the view's axis, almost in the planes of all sides at once: their values there were rounding, and a plane that is the sum
//! of two by such factors turned about the edge, which is far away.

use testkit::arbitrary::{Case, LightParams, Pose, SceneParams, ViewParams};
use testkit::oracle::focus::check_case;

/// A scene that is a flat strip, and a lamp behind the eye: 1e-15 of the paper's H.
#[test]
fn needle_at_a_segment() {
    check_case(&Case {
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
    check_case(&Case {
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
    check_case(&Case {
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
    check_case(&Case {
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

/// A camera at the origin that looks along −z.
fn camera(fov_y: f64, near: f64, far: Option<f64>) -> ViewParams {
    let pose = Pose { eye: [0.0; 3], forward: [0.0, 0.0, -1.0], up: [0.0, 1.0, 0.0] };
    ViewParams::Perspective { pose, fov_y, aspect: 1.0, near, far }
}

fn check_parts(view: ViewParams, light: LightParams, scene: SceneParams) {
    check_case(&Case { view, light, scene });
}

/// The planes of an infinite view meet behind the eye too, and what lies between that and the lamp is in no hull.
#[test]
fn lamp_beside_an_infinite_view() {
    let light = LightParams::Point { position: [5.0, 0.0, -2.0], near: 0.1, range: None };
    let scene = SceneParams::Bounds { min: [9.0, -1.0, -5.0], max: [11.0, 1.0, -3.0] };
    check_parts(camera(std::f64::consts::FRAC_PI_2, 1.0, None), light, scene);
}

/// The values of planes at such a lamp are too small for products of them.
#[test]
fn lamp_at_subnormal_numbers() {
    let steps = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|steps| steps * f64::from_bits(1));
    for x in steps {
        for y in steps {
            let light = LightParams::Point { position: [x, y, -f64::from_bits(1)], near: 0.1, range: None };
            let scene = SceneParams::Bounds { min: [-50.0, -10.0, -35.0], max: [50.0, 13.0, 34.0] };
            check_parts(camera(1.0, 0.02, Some(4000.0)), light, scene.clone());
            check_parts(camera(1.0, 0.02, None), light, scene);
        }
    }
}

/// Planes through both the eye and the lamp have no part along the one axis that the scene has any extent along, and so
/// no slack of their own.
#[test]
fn scene_that_is_a_point_at_the_lamp() {
    let pose = Pose {
        eye: [0.0; 3],
        forward: [-0.416_388_913_493_760_9, 0.507_535_177_632_769_7, 0.754_339_655_715_353_7],
        up: [0.001_012_522_015_507_787_2, 0.954_184_007_463_004_7, -0.019_996_740_409_829_402],
    };
    let (fov_y, aspect) = (1.067_813_520_479_684_8, 0.994_440_932_905_400_1);
    let view = ViewParams::Perspective { pose, fov_y, aspect, near: 0.477, far: Some(5.787) };
    let lamp = [0.0, 5.333_275_472_640_323, 0.0];
    let light = LightParams::Point { position: lamp, near: 3e-4, range: None };
    check_parts(view, light, SceneParams::Bounds { min: lamp, max: lamp });
}

/// The two ends of such a scene have no edge in common, and still their planes and the lamp bound a hull.
#[test]
fn lamp_on_the_line_of_a_scene_that_is_a_segment() {
    let pose = Pose {
        eye: [0.0; 3],
        forward: [1.0, 0.0, -1.0],
        up: [-0.014_261_899_152_505_08, 1.020_746_944_496_340_6, -0.043_199_103_308_165_23],
    };
    let (fov_y, aspect) = (0.853_117_987_799_680_6, 0.942_871_682_521_709_6);
    let view = ViewParams::Perspective { pose, fov_y, aspect, near: 0.455_363_927_774_044_33, far: Some(12.9) };
    let [y, z] = [-0.124_690_321_598_245_93, -0.212_588_798_226_178_7];
    let light = LightParams::Point { position: [0.380_962_981_626_110_75, y, z], near: 3.6e-4, range: None };
    let scene = SceneParams::Bounds { min: [-0.797_397_325_351_127, y, z], max: [0.810_482_848_011_230_6, y, z] };
    check_parts(view, light, scene);
}

/// A needle to beyond a thousand times what the scene is large, and the sun behind the eye: 8e-9 of the paper's H.
#[test]
fn needle_far_beyond_the_scene() {
    let pose = Pose {
        eye: [1_892_666.490_976_138_5, 1_425_825.808_268_803_9, -1_841_533.421_697_060_3],
        forward: [0.209_522_771_925_046_12, 0.484_249_672_399_047_15, -0.849_471_872_887_066_6],
        up: [-0.007_472_598_960_999_909, 1.034_696_209_007_395_2, -0.035_218_366_590_221_01],
    };
    let (aspect, near, far) = (1.539_579_400_466_893_2, 41_879.497_032_197_26, Some(4_313_478_611.111_423_5));
    let view = ViewParams::Perspective { pose, fov_y: 0.001, aspect, near, far };
    let direction_to_light = [-0.209_522_771_925_046, -0.484_249_672_399_047_9, 0.849_471_872_887_066_2];
    let scene = SceneParams::Bounds {
        min: [-555_711.589_251_520_6, 1_446_087.125_648_275_3, -1_877_126.617_869_298_2],
        max: [1_901_412.756_107_658, 6_087_385.729_266_9, 1_123_467.666_355_528_2],
    };
    check_parts(view, LightParams::Directional { direction_to_light }, scene);
}

/// Five units in the last place beside that line, which are less than what planes are moved by.
#[test]
fn lamp_almost_on_the_line_of_a_scene_that_is_a_segment() {
    let [x, y, z] = [3.039_754_158_122_918e-4, 2.762_269_943_780_980_4e-3, -2.867_669_766_935_168_4e-3];
    let pose = Pose {
        eye: [x, y, z],
        forward: [0.738_961_455_800_044_1, -0.511_253_932_878_304_9, 0.438_811_329_569_263_94],
        up: [-0.001_204_717_379_299_338_4, 0.971_619_175_323_918_8, -0.041_147_022_331_410_05],
    };
    let (aspect, near, far) = (1.875_961_481_208_952, 0.000_160_159_371_254_516_6, Some(6.886_024_093_245_126));
    let view = ViewParams::Perspective { pose, fov_y: 3.0, aspect, near, far };
    let light = LightParams::Point { position: [x, y, z], near: 3.2e-3, range: Some(0.144_496_425_388_557_9) };
    let [x, z] = [3.039_754_158_122_925e-4, -2.867_669_766_935_169_2e-3];
    let scene = SceneParams::Bounds { min: [x, 0.0, z], max: [x, 0.041_337_622_752_744_316, z] };
    check_parts(view, light, scene);
}
