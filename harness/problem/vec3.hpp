// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>

namespace shakedown {
/// x along the oscillation, y and z across. SI unless a name says otherwise.
using Vec3 = Eigen::Vector3d;
}  // namespace shakedown
