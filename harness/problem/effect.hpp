// SPDX-License-Identifier: MIT
// A physical effect: a constant record, from which the setup's keys, the JSON schema, the listing, the fit's
// bounds, the engines' capability table, how a diagnosis looks for it, how a laboratory hides it and the
// generic tests are made; and one function that writes the effect into the physics an engine reads.
#pragma once
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "errors.hpp"
#include "vec3.hpp"

namespace shakedown {

struct Physics;

enum class ParameterKind {
  number,     ///< a quantity with a unit, or a bare number when `unit` is empty
  vector,     ///< three quantities of one unit, [x, y, z]
  choice,     ///< one word of `choices`
  text,       ///< free text, e.g. a formula
  constants,  ///< a table of named quantities with any unit
};

/// What the value of a parameter can be, in SI.
using ParameterValue = std::variant<double, Vec3, std::string, std::map<std::string, double>>;

struct Parameter {
  std::string_view name{};
  ParameterKind kind = ParameterKind::number;
  std::string_view unit{};  ///< SI unit, e.g. "N s/m"; empty for a pure number
  ParameterValue default_value = 0.0;
  bool required = false;                                  ///< the user must give it
  double low = -std::numeric_limits<double>::infinity();  ///< closed bounds of the value (of each component)
  double high = std::numeric_limits<double>::infinity();
  double neutral = std::numeric_limits<double>::quiet_NaN();  ///< value at which the effect is absent; NaN:
                                                              ///< has no such value
  double typical = 0;           ///< a strength worth looking for: step of a sensitivity, start of a fit; SI
  std::string_view sentence{};  ///< what it is
  std::vector<std::string_view> choices{};
  std::string_view unit_shown{};  ///< in which people read it where that is not `unit`: "mm/s"
  std::string_view example{};     ///< of a text or of constants: a value as a setup file has it
  /// Of a text that is the path of a table of points: the parameter whose formula a curve through them
  /// becomes when a setup is read.
  std::string_view becomes{};
};

/// How faithfully an engine models an effect.
enum class Fidelity { exact, to_stated_error, not_modelled };
struct Capability {
  Fidelity fidelity = Fidelity::not_modelled;
  std::string_view note{};  ///< the stated error, or what to use instead
};

/// What one engine makes of an effect. Engines that a record does not name do as its entry for every_engine
/// says; without such an entry they do not model the effect.
struct EngineCapability {
  std::string_view engine{};
  Capability capability{};
};
constexpr std::string_view every_engine = "*";

/// Where an effect acts. Camera effects change only what the measurement sees.
enum class ActsOn { contact, grains, box, all, camera };

struct EffectChoice;

/// What EffectRecord::check found wrong with one parameter.
struct ParameterProblem {
  std::string_view parameter;
  std::string problem, remedy;
};

/// One number that says how strong an effect is, for a diagnosis that looks for it and for a laboratory that
/// hides it. `typical` and `levels` are changes from the value at which the effect is absent (which is 0 for
/// most, so that they are the values themselves); of an `inverse` one they are the values.
struct SearchedStrength {
  /// "damping"; a component, "acceleration.x"; several that move together, "grain_grain&grain_wall".
  std::string parameters{};
  double typical = 0;  ///< scale of the prior of the strength, one of the levels; 0: the parameter's
  /// Strengths at which its signature is simulated, SI, weakest first, three to five over its sensible range.
  /// More than three say that even a parabola through them would not do.
  std::vector<double> levels{};
  double low = 0, high = 0;  ///< values searched; both 0: the parameter's own bounds
  /// Key of the setup whose value it has when absent ("restitution.grain_wall"); empty: the parameter's
  /// neutral value, or else 0.
  std::string_view absent_key{};
  bool inverse = false;  ///< a length: without end when the effect is absent
  bool even = false;     ///< both signs do the same; searched on the positive side
  double strongest = 0;  ///< hidden at most at this strength; 0: ten typical ones, within the bounds
};

/// A strength that oscillates: a diagnosis searches its frequency and phase too.
struct SearchedHarmonic {
  std::string_view amplitude{}, frequency{}, phase{};  ///< parameters; of an amplitude the component
  std::string_view rate{};  ///< parameter by which it dies away; empty: it does not
};

/// A length or time that shapes the law and that no strength tells. The momentum balance takes each value as
/// an alternative of its own and then looks between its neighbours; of what acts on grains or in their
/// contacts ensembles take each; all else takes the value in `besides`.
struct SearchedShape {
  std::string_view parameter{};
  std::vector<double> values{};  ///< SI, ascending
  /// With each of the values, the least strength that is looked for where that is more than the strength's
  /// own `low`; SI. Empty: no more.
  std::vector<double> least_strengths{};
};

/// How a diagnosis looks for an effect. Left empty it is made from the parameters: see search_of().
struct Search {
  std::vector<SearchedStrength> strengths{};                   ///< each an alternative of its own (x, y, z)
  std::vector<std::pair<std::string_view, double>> besides{};  ///< parameters that its presence needs, SI
  std::optional<SearchedHarmonic> harmonic{};
  std::vector<SearchedShape> shapes{};  ///< ensembles take each value of one with each of the others
  /// Cost of a run with it: plain as one without, slow three to five times that, dear ten times that.
  enum class Cost { plain, slow, dear } cost = Cost::plain;
  /// How likely it is in such an experiment beside a usual effect (viscous damping, friction): a prior.
  double odds = 1;
  /// Restitutions take up most of what is linear in it, so that only its full strength tells.
  bool hides_in_restitution = false;
  std::string_view not_searched{};  ///< why no diagnosis looks for it; empty: one does
  bool in_waveform = false;  ///< the waveform of an empty box is asked for it, whatever not_searched says
};

/// How well an error of camera or clock is known beforehand. It is then no effect that may be missing unless
/// the data ask for much more of it.
struct CameraError {
  std::string_view known_as{};  ///< in [known] of an experiment: "camera.lens"; empty: taken for perfect
  double usual = 0;             ///< standard deviation where the experiment does not say it, SI
  bool each_run = false;        ///< every run has its own
  double unknown = 0;           ///< standard deviation in a run that may start anywhere, SI; 0: as usual
};

struct Camera;

/// Which number of the camera (physics.hpp) the first parameter of an effect sets.
struct CameraNumber {
  double Camera::*field = nullptr;  ///< null: the effect is none of the camera
  bool optical = false;  ///< needs a lens, a shutter or a line of sight: no encoder, ranger or gyro has it
};

/// What the page of an empty box's answer lets its reader turn (diagnose/turned_model.hpp).
struct OnPage {
  bool integrated = false;  ///< forces_of() of report/page/model.js has this force
  double reach = 0;         ///< of a number of the camera: how far from the answer, SI; 0: it is not turned
};

struct EffectRecord {
  std::string_view name{};   ///< snake_case id, never changed
  std::string_view label{};  ///< short name for people, "linear damping of the box"
  /// Effects of one family look alike, and naming the family is half an answer; empty: has no look-alikes.
  std::string_view family{};
  ActsOn acts_on = ActsOn::box;
  std::string_view sentence{};  ///< one sentence for people
  std::string_view formula{};
  std::string_view source{};  ///< citation
  std::string_view limits{};  ///< where it stops being true
  std::vector<Parameter> parameters{};
  /// The part of the model that it replaces and that two effects cannot both claim, e.g. "normal
  /// restitution", or the path of the setup's key that it stands for; empty: adds up.
  std::string_view claims{};
  bool dissipative = false;  ///< its line in the energy ledger can never be negative
  std::vector<EngineCapability> engines{};
  Search search{};
  /// Name of an effect without which this one does nothing: looked for in models that have that one, and
  /// hidden beside it; empty: stands alone.
  std::string_view needs{};
  /// Misfit, over that of the model's own runs, that data of another code of the same physics leave of a
  /// right model with this effect; 0: as of one without (judgement/judgement.hpp, codes_differ).
  double codes_differ = 0;
  CameraNumber camera{};
  CameraError camera_error{};
  /// How a run was made rather than a law of physics: never missing in a model.
  bool nuisance = false;
  OnPage on_page{};
  /// Writes the effect's share into the physics. `index` is its line in Setup::effects and in the energy
  /// ledger.
  void (*apply)(const EffectChoice& choice, int index, Physics& physics) = nullptr;
  /// Applied after all others because it reads what they wrote (the box's whole mass, the restitutions).
  bool applied_last = false;
  /// What bounds and kinds cannot say about the parameters; nullptr: nothing.
  std::vector<ParameterProblem> (*check)(const EffectChoice& choice) = nullptr;

  /// What a choice of parameters changes in an engine's capability (a formula of x on grains, say); nullptr:
  /// nothing.
  Capability (*capability_of)(const EffectChoice& choice, std::string_view engine,
                              Capability general) = nullptr;

  /// Returns the parameter of this name, or nullptr.
  const Parameter* find(std::string_view parameter) const;
  /// Returns what this engine makes of the effect, whatever the choice of parameters.
  Capability capability(std::string_view engine) const;
  /// Tells whether its law is written in the setup as a formula.
  bool takes_formula() const;
};

/// An effect as chosen in a setup, with all its parameters filled in.
struct EffectChoice {
  const EffectRecord* record = nullptr;
  std::map<std::string, ParameterValue, std::less<>> values;
  SourcePlace place;  ///< where the setup names it

  /// Return the value of the parameter of this name, SI; it must be of this kind.
  double number(std::string_view parameter) const;
  const Vec3& vector(std::string_view parameter) const;
  const std::string& text(std::string_view parameter) const;
  const std::map<std::string, double>& constants(std::string_view parameter) const;
};

/// Returns the effect with every parameter at its default.
EffectChoice with_defaults(const EffectRecord& record);

/// True when the effect does nothing: it has parameters with a neutral value, all of them are at it, and
/// every choice of a law is at its default.
bool is_neutral(const EffectChoice& choice);

}  // namespace shakedown
