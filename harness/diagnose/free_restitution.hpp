// SPDX-License-Identifier: MIT
// Offers physics inside the contacts that no list has: restitution as a free function of the closing speed,
// beside a model that no known effect mends.
#pragma once
#include "state.hpp"

namespace shakedown {

/// Fits a curve of restitution (likelihood/contact_curve.hpp) in place of the model's own law, everything
/// else free as before; a curve that turns is held to one side and fitted again. Throws BudgetSpent,
/// PhysicsError, InputError where the setup has no range of speeds.
FreeRestitution free_restitution_beside(const DiagnosisState& failing, DiagnosisTools& tools);

/// Offers such a curve, in the user's setup, where it explains what `failing` leaves and foretells the box
/// lengths that it was not fitted to better; where it does not, a note says that restitution is not what is
/// missing.
void offer_free_restitution(const Setup& user, const DiagnosisState& failing, DiagnosisTools& tools,
                            Diagnosis& diagnosis);

}  // namespace shakedown
