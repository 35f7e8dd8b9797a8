// SPDX-License-Identifier: MIT
// What a diagnosis writes for physics that no list has.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "effects.hpp"
#include "engines.hpp"
#include "free_restitution.hpp"
#include "physics.hpp"
#include "scratch_folder.hpp"
#include "setup_file.hpp"
#include "unlisted_force.hpp"

using namespace shakedown;

TEST(PointsOfAForce, AreThoseOfTheCurveThatExplainsMostAndAreReadAgain) {
  EXPECT_EQ(points_of_force({}), "");
  const ForceCurve pull{ShapeOf::position, {-0.1, 0.1}, {3, 4}, {1, 1}, 5, 2};
  const ForceCurve brake{ShapeOf::damping_at_x, {-0.1, 0, 0.1}, {0.5, 2, 1}, {0.1, 0.2, 0.3}, 7, 3};
  const std::string table = points_of_force({pull, brake});
  EXPECT_EQ(table, "x,damping,error\n-0.1,0.5,0.1\n0,2,0.2\n0.1,1,0.3\n");
  const ScratchFolder folder;
  std::ofstream(folder / "force.csv") << table;
  const Physics physics = physics_of(parse_setup("[[effect]]\nname = \"user_force\"\ntable = \"force.csv\"\n",
                                                 "s", all_effects(), {}, folder.path()));
  EXPECT_DOUBLE_EQ(physics.box.free[0].newton(0, 0.3, 1), -0.6);
  EXPECT_DOUBLE_EQ(physics.box.free[0].newton(-0.1, 0.3, 1), -0.15);
}

TEST(PointsOfAForce, NameWhatEachShapeDependsOnAndIs) {
  for (const auto& [shape, header] :
       {std::pair(ShapeOf::position, "x,force"), std::pair(ShapeOf::velocity, "v,force"),
        std::pair(ShapeOf::time, "t,force"), std::pair(ShapeOf::friction_at_x, "x,friction"),
        std::pair(ShapeOf::damping_at_t, "t,damping"), std::pair(ShapeOf::stiffness_at_t, "t,stiffness")})
    EXPECT_TRUE(points_of_force({{shape, {0}, {1}, {1}, 1, 1}}).starts_with(header)) << header;
}

// The momentum balance tells the sum of forces on box and grains: in time alone it may be either.
TEST(UnlistedForce, OfTimeAloneMayBeTheGrains) {
  const UnlistedForce push{"F*exp(-((t-t0)/w)^2)", {{"F", "0.05 N"}, {"t0", "4 s"}, {"w", "0.4 s"}}};
  const std::optional<UnlistedForce> shared = shared_by_grains(push, 37);
  ASSERT_TRUE(shared);
  shakedown::Setup setup = with_force({}, *shared, all_effects());
  EXPECT_TRUE(has_force_on_grains(setup));
  EXPECT_DOUBLE_EQ(physics_of(setup).grains.free.at(0).newton(0, 0, 4.4), 0.05 * std::exp(-1) / 37);
  EXPECT_TRUE(physics_of(setup).box.free.empty());
  EXPECT_NE(as_table(*shared).find("on = \"grains\""), std::string::npos);
  setup = with_force(setup, push, all_effects());
  EXPECT_FALSE(has_force_on_grains(setup));
  EXPECT_TRUE(physics_of(setup).grains.free.empty());
}

TEST(UnlistedForce, OfPlaceOrSpeedIsTheBoxsAlone) {
  EXPECT_FALSE(shared_by_grains({"-c*v*exp(-(t/w)^2)", {}}, 37));
  EXPECT_FALSE(shared_by_grains({"-k*max(0,x-x0)", {}}, 37));
  EXPECT_TRUE(shared_by_grains({"-k*max(0,t-x0)", {}}, 37));  // neither x0 nor the x of max
}

// A box that is shaken and not let go has no range of speeds: the diagnosis goes on without the question.
TEST(FreeRestitution, IsNotAskedForWhereNothingIsLetGo) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  const Measurement nothing;
  DiagnoseOptions options;
  options.known = all_effects();
  DiagnosisTools tools(nothing, *engine, options);
  DiagnosisState failing;
  failing.setup.release.displacement = 0;
  Diagnosis diagnosis;
  EXPECT_NO_THROW(offer_free_restitution({}, failing, tools, diagnosis));
  EXPECT_FALSE(diagnosis.free_restitution);
  ASSERT_EQ(diagnosis.notes.size(), 1u);
  EXPECT_NE(diagnosis.notes.front().find("has no range of speeds"), std::string::npos)
      << diagnosis.notes.front();
}
