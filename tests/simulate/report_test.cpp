#include "modules/simulate/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "common/config/options.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::simulate {
namespace {

TEST(SigmaZ, OfStereoGrowsWithTheSquareOfTheDistance) {
  SimulatorParams params;
  params.camera.fx = 500.0;
  params.baseline_m = 0.12;
  params.stereo.sigma_px = 0.12;

  EXPECT_NEAR(sigma_z_m(params, 2.0), 4.0 * 0.12 / 60.0, 1e-12);  // Z^2 sigma / (f B)
  EXPECT_NEAR(sigma_z_m(params, 4.0), 4.0 * sigma_z_m(params, 2.0), 1e-12);
}

TEST(SigmaZ, OfALaserIsItsNoise) {
  SimulatorParams params;
  params.sensor = SensorKind::kLaser;
  params.laser.range_sigma_m = 0.02;

  EXPECT_EQ(sigma_z_m(params, 7.0), 0.02);
  params.laser.ring_range_sigma_m = 0.015;
  EXPECT_NEAR(sigma_z_m(params, 7.0), 0.025, 1e-12);
}

TEST(Report, SaysFromWhereToWherePosesAreRight) {
  std::vector<ReportRow> rows(4);
  for (int i = 0; i < 4; ++i) rows[i].distance_m = 1.0 + i;
  rows[1].joints_percent = 97.0;
  rows[2].joints_percent = 96.0;
  rows[3].joints_percent = 60.0;
  std::ostringstream out;

  print_report(rows, {}, out);

  EXPECT_THAT(out.str(), ::testing::HasSubstr("from 2.0 to 3.0 m"));
}

TEST(Report, PromisesNothingBeyondADistanceWherePosesAreWrong) {
  std::vector<ReportRow> rows(5);
  for (int i = 0; i < 5; ++i) {
    rows[i].distance_m = 1.0 + i;
    rows[i].joints_percent = i == 2 ? 80.0 : 98.0;
  }
  rows[4].joints_percent = 50.0;
  std::ostringstream out;

  print_report(rows, {}, out);

  EXPECT_THAT(out.str(), ::testing::HasSubstr("from 1.0 to 2.0 m"));
}

TEST(Report, SaysWherePosesAreRightAtNoDistance) {
  std::vector<ReportRow> rows(2);
  rows[0].joints_percent = 90.0;
  std::ostringstream out;
  print_report(rows, {}, out);
  EXPECT_THAT(out.str(), ::testing::HasSubstr("at no distance"));
}

TEST(Report, NamesTheProgramThatIsMissing) {
  SimulatorParams params;
  params.camera = {160, 120, 130.0, 130.0, 79.5, 59.5};
  params.sensor = SensorKind::kStereoDepth;
  ReportParams report;
  report.from_m = report.to_m = 2.0;
  report.frames = 1;

  try {
    make_report(params, report, "/nowhere", 1);
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("/nowhere/limbcast-replay"));
  }
}

TEST(Report, NamesThePlaceWhereNoTemporaryFolderCanBeMade) {
  const char* usual = std::getenv("TMPDIR");
  const std::string before = usual != nullptr ? usual : "/tmp";
  setenv("TMPDIR", "/none", 1);
  EXPECT_EQ(test::error_of<config::UsageError>([] { make_report({}, {}, "", 1); }),
            "/none: no temporary folder can be made there (No such file or directory); set TMPDIR "
            "to another");
  setenv("TMPDIR", before.c_str(), 1);
}

}  // namespace
}  // namespace limbcast::simulate
