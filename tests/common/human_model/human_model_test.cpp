#include "common/human_model/human_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "common/input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast {
namespace {

const std::string kDataFolder = std::string(LIMBCAST_SOURCE_DIR) + "/common/human_model/data/";

nlohmann::json read_json(const std::string& name) {
  nlohmann::json json;
  std::ifstream(kDataFolder + name + ".json") >> json;
  return json;
}

/// A model file that ends with the test.
class ModelFile {
 public:
  explicit ModelFile(const std::string& text) : path_(folder_.write("model.json", text)) {}
  const std::string& path() const { return path_; }

 private:
  const test::TemporaryFolder folder_;
  std::string path_;
};

std::string error_of(const HumanModelFiles& files) {
  try {
    load_human_model(files);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(HumanModel, HasTheLinksAndDegreesOfFreedomOfTableI) {
  // Connected to, degrees of freedom, length of links 1 to 15; links 3 and 6 hang on 1 and 3 where
  // the table says 2 (README of the pose fitter).
  const int connected_to[] = {0, 1, 1, 2, 4, 3, 6, 1, 8, 9, 9, 10, 12, 11, 14};
  const int degrees[] = {0, 3, 0, 2, 2, 2, 2, 3, 3, 3, 0, 2, 2, 2, 2};
  const double length_m[] = {0.25, 0.25, 0.25, 0.375, 0.375, 0.375, 0.375, 0.5,
                             0.5,  0.25, 0.25, 0.5,   0.5,   0.5,   0.5};
  const HumanModel model = load_human_model({"table1"});
  std::map<int, int> counted;
  for (const DegreeOfFreedom& dof : model.degrees_of_freedom) ++counted[dof.link];
  for (int number = 1; number < kLinkCount; ++number) {
    EXPECT_EQ(model.links[number].connected_to, connected_to[number - 1]) << number;
    EXPECT_EQ(counted[number], degrees[number - 1]) << number;
    EXPECT_DOUBLE_EQ(model.links[number].length_m, length_m[number - 1]) << number;
  }
  EXPECT_EQ(model.links[3].coupled_to, 2);
  EXPECT_EQ(model.links[11].coupled_to, 10);
}

TEST(HumanModel, EndsEveryJointWithOneLink) {
  for (const char* name : {"table1", "anthropometric"}) {
    std::set<Joint> ends;
    for (const Link& link : load_human_model({name}).links) ends.insert(link.end);
    EXPECT_EQ(ends.size(), static_cast<std::size_t>(kJointCount)) << name;
  }
}

TEST(HumanModel, GivesAnIntervalAndASourceForEveryAngle) {
  for (const DegreeOfFreedom& dof : load_human_model().degrees_of_freedom) {
    EXPECT_LT(dof.min_rad, dof.max_rad) << dof.name;
    EXPECT_THAT(dof.source, testing::ContainsRegex("[12][90][0-9][0-9]")) << dof.name;
  }
}

TEST(HumanModel, GivesAnIntervalAndASourceForTheLengthOfEveryLink) {
  for (const char* name : {"table1", "anthropometric"}) {
    const HumanModel model = load_human_model({name});
    EXPECT_THAT(model.length_limits_source, testing::ContainsRegex("20[0-9][0-9]")) << name;
    for (int number = 1; number < kLinkCount; ++number) {
      EXPECT_LT(model.links[number].min_length_m, model.links[number].length_m) << number;
      EXPECT_GT(model.links[number].max_length_m, model.links[number].length_m) << number;
    }
  }
}

TEST(HumanModel, Has27DifferentPosesWhichDifferMostlyInTheArms) {
  const HumanModel model = load_human_model();
  ASSERT_EQ(model.typical_poses.size(), 27U);
  std::set<std::string> names;
  int standing = 0;
  for (const TypicalPose& pose : model.typical_poses) {
    names.insert(pose.name);
    standing += pose.directions[12].y() < -0.9F ? 1 : 0;
    for (int number = 1; number < kLinkCount; ++number) {
      EXPECT_NEAR(pose.directions[number].norm(), 1.0F, 1e-5F);
    }
  }
  EXPECT_EQ(names.size(), 27U);
  EXPECT_GE(standing, 24);
  EXPECT_NEAR(model.rotation_step_rad, 33.3 * 3.14159265 / 180.0, 1e-6);
  EXPECT_EQ(model.rotation_count, 11);
}

TEST(HumanModel, ShipsTheFilesThatItWasBuiltFrom) {
  const HumanModel shipped = load_human_model();
  const HumanModel read =
      load_human_model({kDataFolder + "anthropometric.json", kDataFolder + "joint_limits.json",
                        kDataFolder + "typical_poses.json"});
  for (int number = 0; number < kLinkCount; ++number) {
    EXPECT_EQ(shipped.links[number].length_m, read.links[number].length_m);
  }
  EXPECT_EQ(shipped.typical_poses[26].name, read.typical_poses[26].name);
}

TEST(HumanModel, NamesTheFileThatIsMissingAndWhatShips) {
  EXPECT_THAT(error_of({"/no/such/model.json"}),
              testing::AllOf(testing::HasSubstr("/no/such/model.json: cannot be read"),
                             testing::HasSubstr("anthropometric")));
}

TEST(HumanModel, RefusesAFolder) {
  EXPECT_THAT(error_of({kDataFolder}),
              testing::StartsWith(kDataFolder + ": is a folder; name a model that ships ("));
}

TEST(HumanModel, NamesTheByteAtWhichJsonEnds) {
  const ModelFile file("{\"links\": [");
  EXPECT_THAT(error_of({file.path()}),
              testing::StartsWith(file.path() + ": no valid JSON at byte 12"));
}

TEST(HumanModel, NamesFileAndKeyOfALengthOutOfRange) {
  auto json = read_json("anthropometric");
  json["links"][3]["length_m"] = -1;
  const ModelFile file(json.dump());
  EXPECT_THAT(error_of({file.path()}),
              testing::StartsWith(file.path() + ": 'links[3].length_m' is -1, must be "));
}

TEST(HumanModel, NamesFileAndKeyThatIsMissing) {
  auto json = read_json("joint_limits");
  json["angles"][27].erase("source");
  const ModelFile file(json.dump());
  EXPECT_EQ(error_of({"table1", file.path()}),
            file.path() + ": 'angles[27]' has no 'source'; add it");
}

TEST(HumanModel, RefusesAWrongNumberOfLinksAnglesOrPoses) {
  auto links = read_json("table1");
  links["links"].erase(14);
  const ModelFile links_file(links.dump());
  EXPECT_THAT(error_of({links_file.path()}), testing::HasSubstr("'links' must have 15 entries"));
  auto limits = read_json("joint_limits");
  limits["angles"].erase(0);
  const ModelFile limits_file(limits.dump());
  EXPECT_THAT(error_of({"table1", limits_file.path()}),
              testing::HasSubstr("'angles' must have 28 entries"));
  auto poses = read_json("typical_poses");
  poses["poses"].erase(0);
  const ModelFile poses_file(poses.dump());
  EXPECT_THAT(error_of({"table1", "joint_limits", poses_file.path()}),
              testing::HasSubstr("'poses' must have 27 entries"));
}

TEST(HumanModel, RefusesALinkThatStartsAtALaterOne) {
  auto json = read_json("table1");
  json["links"][1]["connected_to"] = 5;
  const ModelFile file(json.dump());
  EXPECT_THAT(error_of({file.path()}), testing::HasSubstr("'links[1].connected_to' is 5"));
}

TEST(HumanModel, RefusesAPoseOfUnknownArms) {
  auto json = read_json("typical_poses");
  json["poses"][4]["arm_left"] = "akimbo?";
  const ModelFile file(json.dump());
  EXPECT_THAT(error_of({"table1", "joint_limits", file.path()}),
              testing::HasSubstr("'poses[4].arm_left' is 'akimbo?'"));
}

}  // namespace
}  // namespace limbcast
