// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "experiment_file.hpp"
#include "experiment_keys.hpp"
#include "experiment_reference.hpp"
#include "known_value.hpp"
#include "scratch_folder.hpp"

namespace shakedown {
namespace {

std::string read_me() {
  std::ifstream file(std::string(PROJECT_ROOT) + "/harness/measure/README.md");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(ExperimentReference, StandsInTheReadMe) {
  EXPECT_NE(read_me().find(experiment_keys_markdown()), std::string::npos)
      << "put the output of `shakedown schema --experiment --table` there";
}

TEST(ExperimentReference, NamesEveryKeyWithASentence) {
  const std::string text = experiment_keys_markdown();
  for (const ExperimentKey& key : experiment_keys()) {
    EXPECT_TRUE(key.sentence.ends_with(".")) << key.name;
    EXPECT_NE(text.find("| `" + std::string(key.name) + "` |"), std::string::npos) << key.name;
  }
  for (const CameraKey& key : camera_keys()) {
    EXPECT_NE(text.find("| `" + std::string(key.path) + "` |"), std::string::npos);
    std::vector<Violation> wrong;
    read_known(parse_toml("\"" + std::string(key.path) + "\" = \"" + example_of(key) + "\"", "example"), "",
               wrong);
    EXPECT_TRUE(wrong.empty()) << to_string(wrong[0]);
  }
}

TEST(ExperimentReference, TheSchemaHasEveryKeyOfEveryTable) {
  const auto schema = nlohmann::json::parse(experiment_schema());
  const auto& properties = schema["properties"];
  const auto& column = properties["column"]["properties"]["box_position"]["properties"];
  for (const ExperimentKey& key : experiment_keys()) {
    const std::string name(key.name);
    const auto& table = key.table == ExperimentTable::file     ? properties
                        : key.table == ExperimentTable::camera ? properties["camera"]["properties"]
                        : key.table == ExperimentTable::column ? column
                                                               : properties["run"]["items"]["properties"];
    EXPECT_TRUE(table.contains(name)) << name;
  }
  EXPECT_TRUE(properties["known"]["properties"].contains("box.mass"));
  EXPECT_TRUE(properties["known"]["properties"].contains("camera.shutter"));
}

TEST(ExperimentReference, TheExampleOfTheReadMeIsRead) {
  const std::string text = read_me();
  const std::size_t begin = text.find("```toml\n") + 8;
  const std::string example = text.substr(begin, text.find("```", begin) - begin);
  const ScratchFolder folder;
  std::ofstream(folder / "L040.csv")
      << "frame,track,x\n0,1,1472\n1,1,1471\n100,1,1470\n101,1,1469\n102,1,1468\n"
         "103,1,1466\n104,1,1462\n";
  std::ofstream(folder / "empty.csv") << "frame,track,x\n0,1,1472\n1,1,1471\n2,1,1470\n3,1,1469\n4,1,1468\n";
  const Experiment experiment = parse_experiment(example, "experiment.toml", folder.path());
  EXPECT_EQ(experiment.runs.size(), 2u);
  EXPECT_EQ(experiment.known.size(), 5u);
  EXPECT_EQ(experiment.runs[0].lead_in.time.size(), 2u);
}

}  // namespace
}  // namespace shakedown
