// SPDX-License-Identifier: MIT
#pragma once
#include "report.hpp"

namespace shakedown {

struct BounceReading;

/// Makes the page about drops: restitution against speed with its band, laws, outliers, sounds.
Report report_of(const BounceReading& reading);

}  // namespace shakedown
