// SPDX-License-Identifier: MIT
// Figures of single impacts from elsewhere. Curves of Y. C. Chung and J. Y. Ooi, Granular Matter 13, 643
// (2011), and of A. H. Kharaz, D. A. Gorham and A. D. Salman, Powder Technology 120, 281 (2001), were read
// off the printed diagrams by the Kratos project (github.com/KratosMultiphysics/Kratos,
// applications/DEMApplication/test_examples/basic_benchmarks/paper_data, BSD licence); a pixel is 0.005 to
// 0.02 of a tangent, 0.2 degrees or 2 rad/s.
#pragma once
#include <array>

namespace shakedown::published {

/// Chung and Ooi, tests 1 (glass) and 2 (aluminium alloy): elastic normal impact.
struct NormalImpact {
  const char* what;
  bool pair;             ///< else a rigid plane
  double radius, speed;  ///< m, m/s, of approach
  double youngs_modulus, poisson_ratio, density;
  double peak_force, duration;  ///< N, s, read off the force over time
};
inline constexpr std::array normal_impacts{
    NormalImpact{"1, glass on glass", true, 0.01, 20, 4.8e10, 0.2, 2800, 10.70e3, 40.5e-6},
    NormalImpact{"2, aluminium alloy on a plane", false, 0.1, 0.2, 7e10, 0.3, 2699, 11.36e3, 727e-6}};

/// Chung and Ooi, test 4: aluminium oxide of 5 mm on a rigid plane at 3.9 m/s, restitution 0.98, friction
/// 0.092. Angles from the normal, degrees.
struct ObliqueImpact {
  double degrees, tangential_restitution, spin, contact_degrees;
};
inline constexpr std::array oblique_impacts{
    ObliqueImpact{5, 0.948, 19.3, 3.76},    ObliqueImpact{10, 0.687, 213.0, -1.56},
    ObliqueImpact{15, 0.624, 377.8, -5.54}, ObliqueImpact{20, 0.616, 510.6, -7.54},
    ObliqueImpact{25, 0.634, 599.4, -7.54}, ObliqueImpact{30, 0.684, 616.5, -3.55},
    ObliqueImpact{35, 0.737, 582.3, 3.43},  ObliqueImpact{40, 0.781, 544.8, 11.57},
    ObliqueImpact{50, 0.845, 457.0, 29.35}, ObliqueImpact{60, 0.893, 357.5, 47.79},
    ObliqueImpact{70, 0.932, 246.2, 64.58}, ObliqueImpact{80, 0.966, 126.3, 78.70},
    ObliqueImpact{85, 0.983, 63.1, 84.52}};

/// Kharaz, Gorham and Salman: the experiment of that test, on glass. Angle of incidence and that at which the
/// point of contact leaves, degrees.
struct MeasuredAngle {
  double degrees, contact_degrees;
};
inline constexpr std::array measured_angles{
    MeasuredAngle{2.10, 0.77},   MeasuredAngle{3.94, 0.77},   MeasuredAngle{9.72, -1.06},
    MeasuredAngle{20.31, -8.53}, MeasuredAngle{30.16, -2.55}, MeasuredAngle{39.12, 9.91},
    MeasuredAngle{49.51, 30.02}, MeasuredAngle{59.90, 49.95}, MeasuredAngle{70.46, 66.90},
    MeasuredAngle{78.86, 78.87}, MeasuredAngle{84.78, 85.68}};

/// Chung and Ooi, test 5: normal speed 5 m/s, restitution 1, friction 0.3; slip and spin over friction times
/// the normal speed, of steel spheres in their program and in finite elements (these at other abscissae).
struct ScaledImpact {
  double slip, slip_after, spin_after;
};
inline constexpr std::array steel_spheres{ScaledImpact{0.67, -0.49, -0.82}, ScaledImpact{1.34, -1.00, -1.66},
                                          ScaledImpact{2.00, -1.53, -2.52}, ScaledImpact{2.99, -2.44, -3.90},
                                          ScaledImpact{4.00, -2.79, -4.84}, ScaledImpact{5.00, -2.00, -5.01},
                                          ScaledImpact{6.00, -1.01, -5.01}, ScaledImpact{9.99, 3.01, -5.00}};
inline constexpr std::array finite_elements{
    ScaledImpact{0.59, -0.03, -0.41}, ScaledImpact{1.19, -0.21, -0.98}, ScaledImpact{2.79, -1.25, -2.86},
    ScaledImpact{3.97, -1.72, -4.04}, ScaledImpact{5.76, -1.20, -4.94}, ScaledImpact{7.12, 0.13, -4.94},
    ScaledImpact{9.12, 2.15, -4.97},  ScaledImpact{12.36, 5.43, -4.97}};

/// Chung and Ooi, tests 6 and 8: a sphere that spins comes straight down at 0.2 m/s, restitution 0.5,
/// friction 0.4; slip turned round over slip before, against the angle whose tangent is slip over normal
/// speed. Test 6: aluminium alloy and nylon on a plane; 8: aluminium alloy on a sphere of five times the
/// radius.
struct SpinningImpact {
  double degrees, alloy, nylon, on_large_sphere;
};
inline constexpr std::array spinning_impacts{
    SpinningImpact{85, -0.820, -0.824, -0.815}, SpinningImpact{80, -0.633, -0.638, -0.626},
    SpinningImpact{75, -0.445, -0.443, -0.439}, SpinningImpact{70, -0.243, -0.243, -0.238},
    SpinningImpact{65, -0.028, -0.026, -0.017}, SpinningImpact{60, 0.097, 0.093, 0.096},
    SpinningImpact{55, 0.119, 0.119, 0.111},    SpinningImpact{50, 0.100, 0.117, 0.090},
    SpinningImpact{40, 0.005, 0.056, 0.006},    SpinningImpact{30, -0.100, -0.056, -0.103},
    SpinningImpact{20, -0.175, -0.159, -0.162}, SpinningImpact{10, -0.258, -0.113, -0.248}};

}  // namespace shakedown::published
