#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <limbcast/module_status_t.hpp>
#include <limbcast/mounting_t.hpp>
#include <nlohmann/json.hpp>
#include <thread>

#include "common/lcm_io/bus.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::doctor {
namespace {

using ::testing::HasSubstr;

constexpr int kProblems = 1, kWrongUsage = 2;

TEST(Doctor, NamesMissingModulesAndForeignTypesThatItHears) {
  const std::string url = test::private_lcm_url();
  test::ChildProcess segmenter({test::program("limbcast-segmenter"), "--lcm-url", url},
                               test::temporary_folder("doctor") + "/segmenter.txt");
  lcm_io::Bus listener(url);
  bool is_up = false;
  listener.subscribe<module_status_t>("MODULE_STATUS", lcm_io::Keep::kAll,
                                      [&](const module_status_t&) { is_up = true; });
  while (!is_up) {
    listener.handle(std::chrono::milliseconds(200));
    ASSERT_TRUE(segmenter.running()) << segmenter.output();
  }
  std::atomic<bool> examined{false};
  std::thread foreigner([&] {
    lcm_io::Bus bus(url);
    while (!examined) {
      bus.publish("BODY_POSES", mounting_t{});
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  });
  const auto result = test::run(
      {test::program("limbcast-doctor"), "--lcm-url", url, "--expect", "segmenter,pose_fitter"});
  examined = true;
  foreigner.join();
  EXPECT_EQ(result.exit_code, kProblems);
  EXPECT_THAT(result.output, HasSubstr("problem  channel BODY_POSES: carries another type"));
  EXPECT_THAT(result.output, HasSubstr("problem  module pose_fitter: is not heard\n"
                                       "         mend: systemctl start limbcast-pose-fitter"));
  EXPECT_THAT(result.output, HasSubstr("good     module segmenter on "));
}

TEST(Doctor, PrintsJson) {
  const auto result = test::run({test::program("limbcast-doctor"), "--lcm-url",
                                 test::private_lcm_url(), "--listen-s", "1", "--json"});
  const auto json = nlohmann::json::parse(result.output);
  EXPECT_EQ(json["good"], result.exit_code == 0);
  EXPECT_FALSE(json["findings"].empty());
}

TEST(Doctor, RefusesNamesThatNoModuleHas) {
  for (const std::string list : {",", "segmenter, pose_fitter"}) {
    const auto result = test::run({test::program("limbcast-doctor"), "--expect", list});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.output, "limbcast-doctor: 'expect' is '" + list +
                                 "', must be names with commas between, as "
                                 "segmenter,pose_fitter\n");
  }
}

TEST(Doctor, RefusesAUrlThatIsNotMulticast) {
  const auto result = test::run({test::program("limbcast-doctor"), "--lcm-url", "memq://"});
  EXPECT_EQ(result.exit_code, kWrongUsage);
  EXPECT_THAT(result.output, HasSubstr("is no multicast URL"));
}

}  // namespace
}  // namespace limbcast::doctor
