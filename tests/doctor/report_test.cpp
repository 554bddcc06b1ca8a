#include "modules/doctor/report.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace limbcast::doctor {
namespace {

const Findings kFindings = {{Level::kGood, "ttl", "1", ""},
                            {Level::kProblem, "route", "none", "ip route add"}};

TEST(ReportText, HasALineForEachFindingAndOneForTheCommand) {
  EXPECT_EQ(report_text(kFindings),
            "good     ttl: 1\n"
            "problem  route: none\n"
            "         mend: ip route add\n");
}

TEST(ReportJson, HoldsFindingsAndChannels) {
  Traffic traffic;
  traffic.duration_s = 2.0;
  traffic.channels["BODY_POSES"] = {10, 3000, 400, {}};
  const auto json = nlohmann::json::parse(report_json(kFindings, traffic, "vision", "udpm://"));
  EXPECT_EQ(json["host"], "vision");
  EXPECT_EQ(json["good"], false);
  EXPECT_EQ(json["findings"][1]["level"], "problem");
  EXPECT_EQ(json["findings"][1]["command"], "ip route add");
  EXPECT_EQ(json["channels"]["BODY_POSES"]["rate_hz"], 5.0);
  EXPECT_EQ(json["channels"]["BODY_POSES"]["largest_bytes"], 400);
}

TEST(HasProblem, CountsNeitherNotesNorWhatIsGood) {
  EXPECT_TRUE(has_problem(kFindings));
  EXPECT_FALSE(has_problem({{Level::kNote, "ttl", "0", ""}, {Level::kGood, "cpu", "", ""}}));
}

}  // namespace
}  // namespace limbcast::doctor
