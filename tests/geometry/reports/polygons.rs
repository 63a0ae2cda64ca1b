//! Boolean operations of polygons. The oracle cuts the plane into strips, in numbers of 320 binary places.
use super::Report;
use crate::polygon::scanline::{self, Ring};
use geograd::boolean::{difference, intersection, union};
use geograd::polygon::{self, Fill};
use geograd::{Rings, Vec2};

const STRIPS: &str = "sum over strips in numbers of 320 binary places";

type Pair = [Vec<Ring>; 2];

fn ring(all: &[[f64; 2]]) -> Ring {
    all.iter().map(|&[x, y]| Vec2::new(x, y)).collect()
}

fn pair(a: &[[f64; 2]], b: &[[f64; 2]]) -> Pair {
    [vec![ring(a)], vec![ring(b)]]
}

/// The area of the intersection, both ways round.
fn shared([a, b]: &Pair) -> Vec<f64> {
    let of = |a: &[Ring], b: &[Ring]| {
        polygon::area(&intersection(Rings::from(a), Rings::from(b), Fill::EvenOdd).unwrap())
    };
    vec![of(a, b), of(b, a)]
}

fn shared_right([a, b]: &Pair) -> Vec<f64> {
    vec![scanline::areas(a, b, Fill::EvenOdd)[1]; 2]
}

fn joined([a, b]: &Pair) -> Vec<f64> {
    let of = |a: &[Ring], b: &[Ring]| {
        polygon::area(&union(Rings::from(a), Rings::from(b), Fill::EvenOdd).unwrap())
    };
    vec![of(a, b), of(b, a)]
}

fn joined_right([a, b]: &Pair) -> Vec<f64> {
    vec![scanline::areas(a, b, Fill::EvenOdd).iter().sum(); 2]
}

fn less([a, b]: &Pair) -> Vec<f64> {
    vec![polygon::area(
        &difference(Rings::from(&a[..]), Rings::from(&b[..]), Fill::EvenOdd).unwrap(),
    )]
}

fn less_right([a, b]: &Pair) -> Vec<f64> {
    vec![scanline::areas(a, b, Fill::EvenOdd)[0]]
}

fn strip() -> Pair {
    pair(
        &[
            [171.604_803_511_377_78, 162.320_966_506_356_97],
            [172.217_959_263_325_67, 162.997_360_730_964_6],
            [172.217_959_263_325_67, 170.0],
            [171.604_803_511_377_78, 170.0],
        ],
        &[
            [200.0, 166.000_02],
            [184.000_05, 166.000_02],
            [180.000_05, 164.000_02],
            [169.999_988_89, 162.000_002_78],
            [182.0, 159.0],
            [200.0, 159.0],
        ],
    )
}

fn lots() -> Pair {
    pair(
        &[
            [76.375_939_820_202_43, 53.628_559_655_441_95],
            [76.566_299_438_476_56, 53.710_998_535_156_25],
            [76.977_096_557_617_19, 54.0],
            [77.414_901_733_398_44, 54.585_098_266_601_56],
            [77.0, 55.0],
            [76.999_993_121_099_07, 55.000_006_878_872_07],
            [76.998_664_065_521_84, 55.001_335_928_872_43],
            [76.098_963_576_578_94, 55.901_032_642_573_67],
            [76.329_902_648_925_78, 54.0],
        ],
        &[
            [77.414_901_733_398_44, 54.585_098_266_601_56],
            [77.0, 55.0],
            [76.090_896_606_445_31, 55.909_099_578_857_42],
            [76.0, 56.0],
            [76.329_902_648_925_78, 54.0],
            [76.372_802_734_375, 53.627_201_080_322_27],
            [76.566_299_438_476_56, 53.710_998_535_156_25],
            [76.977_096_557_617_19, 54.0],
        ],
    )
}

fn needle() -> Pair {
    pair(
        &[[1e-14, 0.0], [-10.0, 50.0], [-20.0, 50.0]],
        &[[0.0, 1000.0], [0.0, 0.0], [1000.0, 0.0], [1000.0, 1000.0]],
    )
}

fn walls() -> Pair {
    pair(
        &[
            [-2.470_890_26, -86.030_592_46],
            [-1.161_944_873, 146.303_059_6],
            [3.402_212_14, 145.862_801_5],
            [3.024_695_769, 141.949_088],
            [2.420_586_453, 111.955_456_4],
            [1.208_013_978, -86.040_699_36],
        ],
        &[
            [-6.213_278_056, -88.018_517_48],
            [-6.207_382_255, -86.518_529_06],
            [-6.205_399_51, -86.014_086_04],
            [-2.470_873_099, -86.024_345_75],
            [-2.472_221_358, -86.533_155_86],
            [-2.476_196_085, -88.033_150_59],
        ],
    )
}

fn holed() -> Pair {
    [
        vec![
            ring(&[[0., 5.], [-6., -17.], [12., 17.]]),
            ring(&[[4., 6.], [5., 5.], [0., 1.]]),
        ],
        vec![ring(&[[3., 9.], [-15., -5.], [13., -11.]])],
    ]
}

fn touch() -> Pair {
    let (x, y) = (
        [3.166_572_116_932_842, 4.180_930_086_918_854],
        [48.539_019_468_746_3, 50.470_470_727_186_765],
    );
    pair(
        &[[x[0], y[0]], [x[0], y[1]], [x[1], y[1]], [x[1], y[0]]],
        &[
            [2.152_214_146_946_829, y[1]],
            [18.381_941_666_723_034, 19.567_250_592_139_274],
            [2.390_837_642_830_135, 49.228_045_261_718_165],
        ],
    )
}

fn tiles() -> Pair {
    pair(
        &[
            [-295.250_303_512_496_66, 4.236_074_061_427_525],
            [-295.087_112_342_183_33, -2.301_948_231_163_383],
            [-314.642_180_258_006_53, -2.790_049_108_757_038_3],
            [-314.805_371_428_319_86, 3.747_973_183_833_869_5],
        ],
        &[
            [-275.695_235_596_673_46, 4.724_174_939_021_180_5],
            [-275.532_044_426_360_13, -1.813_847_353_569_727_3],
            [-295.087_112_342_183_33, -2.301_948_231_163_382_5],
            [-295.250_303_512_496_66, 4.236_074_061_427_525],
        ],
    )
}

fn zone() -> Pair {
    pair(
        &[
            [127.742_839_324_453_64, -13.587_090_929_970_145],
            [43.440_483_771_142_47, -7.284_623_207_990_08],
            [54.329_847_263_553_376, 63.378_543_890_075_08],
            [54.618_185_542_665_68, 63.330_401_013_399_76],
            [135.626_370_802_650_46, 53.862_076_963_892_896],
        ],
        &[
            [79.570_064_684_143_16, 227.167_153_061_367_57],
            [43.440_483_771_142_46, -7.284_623_207_990_08],
            [127.742_839_324_453_64, -13.587_090_929_970_145],
            [154.998_488_086_556_08, 219.604_193_267_412_48],
        ],
    )
}

fn whole() -> Pair {
    let square = [[0., 0.], [100., 0.], [100., 100.], [0., 100.]];
    pair(&square, &square)
}

fn spear() -> Pair {
    pair(
        &[[140.5, 62.24], [140.07, 62.34], [136.94, 63.05]],
        &[[142.5, 61.44], [142.06, 61.55], [140.07, 62.34]],
    )
}

fn far() -> Pair {
    pair(
        &[
            [-10_644_125.090_349_106, 3_510_000.058_398_463],
            [-10_010_375.272_229_86, 3_502_179.609_316_81],
            [-10_018_249.493_188_547, 3_506_247.294_314_978],
            [-10_018_249.493_188_54, 3_506_247.294_314_993],
            [-10_320_063.446_714_956, 3_765_929.782_708_278_4],
        ],
        &[
            [-10_339_459.518_507_583, 3_672_178.782_408_396_7],
            [-10_172_502.686_420_029, 3_169_028.949_896_697_4],
            [-10_002_503.513_328_442, 3_498_113.196_174_42],
        ],
    )
}

fn outline() -> Pair {
    pair(
        &[
            [48.239437, -54.70892],
            [47.195786, -55.457626],
            [46.968903, -56.886974],
            [36.532383, -55.07193],
            [37.961735, -46.7454],
            [40.02635, -47.085724],
            [40.094414, -46.7454],
            [44.51859, -47.516796],
            [44.473213, -47.83443],
            [48.398254, -48.51507],
            [48.10331, -49.9898],
            [48.874702, -50.965385],
        ],
        &[
            [48.398247, -48.515068],
            [48.10331, -49.989796],
            [44.473213, -47.834427],
        ],
    )
}

pub fn reports() -> Vec<Report> {
    vec![
        Report {
            library: "boostorg/geometry",
            number: 662,
            about: "area 4.5",
            asked: "the area shared by a strip and a hexagon, both ways round",
            source: STRIPS,
            found: || shared(&strip()),
            right: || shared_right(&strip()),
            within: 1e-12,
        },
        Report {
            library: "boostorg/boost",
            number: 731,
            about: "an empty intersection",
            asked: "the area shared by two lots with common borders, both ways round",
            source: STRIPS,
            found: || shared(&lots()),
            right: || shared_right(&lots()),
            within: 1e-12,
        },
        Report {
            library: "boostorg/geometry",
            number: 1201,
            about: "the second polygon as a whole, area 10⁶",
            asked: "the area shared where a corner reaches in by 10⁻¹⁴, to 10⁻²⁰, both ways round",
            source: STRIPS,
            found: || shared(&needle()),
            right: || shared_right(&needle()),
            within: 1e-20,
        },
        Report {
            library: "boostorg/geometry",
            number: 1439,
            about: "the area of one polygon, though they hardly overlap",
            asked: "the area shared by two walls, both ways round",
            source: STRIPS,
            found: || shared(&walls()),
            right: || shared_right(&walls()),
            within: 1e-13,
        },
        Report {
            library: "boostorg/geometry",
            number: 1231,
            about: "an invalid polygon",
            asked: "the area shared by a triangle with a hole and a triangle, both ways round",
            source: STRIPS,
            found: || shared(&holed()),
            right: || shared_right(&holed()),
            within: 1e-12,
        },
        Report {
            library: "locationtech/jts",
            number: 119,
            about: "the first polygon as a whole, area 1.96",
            asked: "the area shared by a rectangle and a needle through its corner, both ways round",
            source: STRIPS,
            found: || shared(&touch()),
            right: || shared_right(&touch()),
            within: 1e-12,
        },
        Report {
            library: "shapely/shapely",
            number: 2368,
            about: "127.9: one of both tiles",
            asked: "the area of the union of two tiles whose common side differs by an ulp, both ways round",
            source: STRIPS,
            found: || joined(&tiles()),
            right: || joined_right(&tiles()),
            within: 1e-10,
        },
        Report {
            library: "libgeos/geos",
            number: 1354,
            about: "a point",
            asked: "the area shared by a zone and a pentagon on its side, both ways round",
            source: STRIPS,
            found: || shared(&zone()),
            right: || shared_right(&zone()),
            within: 1e-9,
        },
        Report {
            library: "AngusJohnson/Clipper2",
            number: 282,
            about: "an empty intersection, as small areas on the integers are",
            asked: "the area shared by two triangles of small integers, both ways round",
            source: STRIPS,
            found: || {
                shared(&pair(
                    &[[4., 1.], [9., 5.], [0., 5.]],
                    &[[1., 4.], [7., 6.], [3., 6.]],
                ))
            },
            right: || {
                shared_right(&pair(
                    &[[4., 1.], [9., 5.], [0., 5.]],
                    &[[1., 4.], [7., 6.], [3., 6.]],
                ))
            },
            within: 1e-14,
        },
        Report {
            library: "w8r/martinez",
            number: 81,
            about: "a ring that runs over itself",
            asked: "the area of a parallelogram less a smaller one on its side",
            source: STRIPS,
            found: || {
                less(&pair(
                    &[[0., 0.], [2., 2.], [4., 2.], [2., 0.]],
                    &[[1., 0.], [2., 1.], [3., 1.], [2., 0.]],
                ))
            },
            right: || {
                less_right(&pair(
                    &[[0., 0.], [2., 2.], [4., 2.], [2., 0.]],
                    &[[1., 0.], [2., 1.], [3., 1.], [2., 0.]],
                ))
            },
            within: 1e-14,
        },
        Report {
            library: "w8r/GreinerHormann",
            number: 7,
            about: "nothing",
            asked: "the area shared by a square and itself, and of their union",
            source: "definition",
            found: || vec![shared(&whole())[0], joined(&whole())[0]],
            right: || vec![1e4, 1e4],
            within: 0.0,
        },
        Report {
            library: "georust/geo",
            number: 913,
            about: "a panic",
            asked: "the area of a sliver less what it shares with another",
            source: STRIPS,
            found: || {
                let [a, b] = spear();
                let part =
                    intersection(Rings::from(&b[..]), Rings::from(&a[..]), Fill::EvenOdd).unwrap();
                vec![polygon::area(
                    &difference(Rings::from(&a[..]), &part, Fill::EvenOdd).unwrap(),
                )]
            },
            right: || less_right(&spear()),
            within: 1e-12,
        },
        Report {
            library: "georust/geo",
            number: 1180,
            about: "a panic",
            asked: "the area of the union of two polygons at 10⁷, both ways round",
            source: STRIPS,
            found: || joined(&far()),
            right: || joined_right(&far()),
            within: 1e-2,
        },
        Report {
            library: "iShape-Rust/iOverlay",
            number: 11,
            about: "a part of three equal vertices",
            asked: "the area of an intersection, and how many of its rings have no area",
            source: STRIPS,
            found: || {
                let [a, b] = outline();
                let found =
                    intersection(Rings::from(&a[..]), Rings::from(&b[..]), Fill::EvenOdd).unwrap();
                let empty = found
                    .rings()
                    .iter()
                    .filter(|r| geograd::ring::signed_area(r) == 0.0)
                    .count();
                vec![polygon::area(&found), empty as f64]
            },
            right: || {
                let [a, b] = outline();
                vec![scanline::areas(&a, &b, Fill::EvenOdd)[1], 0.0]
            },
            within: 1e-12,
        },
    ]
}
