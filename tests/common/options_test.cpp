#include "common/config/options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace limbcast::config {
namespace {

using ::testing::HasSubstr;

struct Settings {
  double d_max_m = 0.05;
  int threads = 2;
  bool verbose = false;
  std::string method = "paper";
  std::string input;
  std::string sensor = "front", channel = "IMAGES";
  double exposure = std::numeric_limits<double>::quiet_NaN();
};

class OptionsTest : public ::testing::Test {
 protected:
  OptionsTest() {
    section_.add("d-max-m", settings_.d_max_m, "m", "largest step", {0.001, 1.0});
    section_.add("threads", settings_.threads, "", "threads", {1, 64});
    section_.add("verbose", settings_.verbose, "say more");
    section_.add_choice("method", settings_.method, {"paper", "refined"}, "how to fit");
    section_.add_name("sensor", settings_.sensor, "of the messages");
    section_.add_channel("images-channel", settings_.channel, "channel");
    section_.add("exposure", settings_.exposure, "ms", "left out: as it is");
    parser_.add(section_);
    parser_.add_positional("IN.log", settings_.input, "the log");
  }
  bool parse(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "limbcast-test");
    return parser_.parse(static_cast<int>(arguments.size()), arguments.data(), out_);
  }
  std::string error_of(const std::vector<const char*>& arguments) {
    try {
      parse(arguments);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  }
  std::string config_file(const std::string& text) const {
    return folder_.write("robot.conf", text);
  }

  const test::TemporaryFolder folder_;
  Settings settings_;
  Section section_{"pose_fitter"};
  Parser parser_{"limbcast-test", "test"};
  std::ostringstream out_;
};

TEST_F(OptionsTest, TakesNoArgumentForTheValueOfABareFlag) {
  EXPECT_TRUE(parse({"--verbose", "in.log"}));
  EXPECT_TRUE(settings_.verbose);
  EXPECT_EQ(settings_.input, "in.log");
  EXPECT_TRUE(parse({"--pose_fitter.verbose=false", "in.log"}));
  EXPECT_FALSE(settings_.verbose);
}

TEST_F(OptionsTest, KeepsDefaultsWithoutOptions) {
  EXPECT_TRUE(parse({"in.log"}));
  EXPECT_EQ(settings_.input, "in.log");
  EXPECT_DOUBLE_EQ(settings_.d_max_m, 0.05);
}

TEST_F(OptionsTest, UnderstandsKeysWithAndWithoutPrefixHyphenOrUnderscore) {
  EXPECT_TRUE(parse({"in.log", "--pose_fitter.method=refined", "--d_max_m", "0.1", "--verbose"}));
  EXPECT_EQ(settings_.method, "refined");
  EXPECT_DOUBLE_EQ(settings_.d_max_m, 0.1);
  EXPECT_TRUE(settings_.verbose);
}

TEST_F(OptionsTest, TakesTheFileOverDefaultsAndTheCommandLineOverTheFile) {
  const std::string file =
      config_file("[pose_fitter]\nmethod = refined\nthreads = 4\n[segmenter]\nx = 1\n");
  EXPECT_TRUE(parse({"in.log", "--config", file.c_str(), "--threads=8"}));
  EXPECT_EQ(settings_.method, "refined");
  EXPECT_EQ(settings_.threads, 8);
}

TEST_F(OptionsTest, KnowsWhatStoodOnTheCommandLine) {
  const std::string file = config_file("[pose_fitter]\nmethod = refined\nthreads = 4\n");
  EXPECT_TRUE(
      parse({"in.log", "--config", file.c_str(), "--threads=8", "--pose_fitter.d_max_m", "0.1"}));
  EXPECT_TRUE(parser_.on_command_line("threads"));
  EXPECT_TRUE(parser_.on_command_line("d-max-m"));
  EXPECT_FALSE(parser_.on_command_line("method"));
  EXPECT_FALSE(parser_.on_command_line("verbose"));
}

TEST_F(OptionsTest, RefusesAChannelThatIsReadAndWritten) {
  std::string input = "SEGMENTS", output = "POSES";
  section_.add_input_channel("segments-channel", input, "read");
  section_.add_output_channel("poses-channel", output, "written");
  EXPECT_EQ(error_of({"in.log", "--images-channel=POSES"}), "");
  const std::string file = config_file("[pose_fitter]\nsegments_channel = POSES\n");
  EXPECT_EQ(
      error_of({"in.log", "--config", file.c_str()}),
      "'poses-channel' is 'POSES', as 'segments-channel' is, so that [pose_fitter] would read "
      "what it writes; give one of them another name");
  EXPECT_EQ(error_of({"in.log", "--config", file.c_str(), "--poses-channel=BODIES"}), "");
}

TEST_F(OptionsTest, NamesKeyValueAndRangeOfAValueOutOfRange) {
  const std::string error = error_of({"in.log", "--d-max-m=7"});
  EXPECT_THAT(error, HasSubstr("d-max-m"));
  EXPECT_THAT(error, HasSubstr("'7'"));
  EXPECT_THAT(error, HasSubstr("0.001 to 1"));
}

TEST_F(OptionsTest, RejectsNumbersThatAreNone) {
  EXPECT_THAT(error_of({"in.log", "--threads=two"}), HasSubstr("'two'"));
  EXPECT_THAT(error_of({"in.log", "--threads=2.5"}), HasSubstr("'2.5'"));
  EXPECT_THAT(error_of({"in.log", "--d-max-m=nan"}), HasSubstr("'nan'"));
}

TEST_F(OptionsTest, RejectsUnknownOptionsChoicesAndArguments) {
  EXPECT_THAT(error_of({"in.log", "--nonsense=1"}), HasSubstr("nonsense"));
  EXPECT_THAT(error_of({"in.log", "--method=magic"}), HasSubstr("one of paper, refined"));
  EXPECT_THAT(error_of({"in.log", "another.log"}), HasSubstr("another.log"));
  EXPECT_THAT(error_of({}), HasSubstr("IN.log is missing"));
}

TEST_F(OptionsTest, SaysHowASwitchIsSetWhereItsValueStandsAlone) {
  EXPECT_EQ(error_of({"in.log", "--verbose", "false"}),
            "command line: unexpected argument 'false'; write --key=false");
}

TEST(OptionalArguments, AreNotEmpty) {
  std::string log;
  std::vector<std::string> more;
  Parser parser("limbcast-test", "test");
  parser.add_positional("[LOG]", log, "log");
  parser.add_positional("[MORE...]", more, "more");
  const auto error = [&parser](std::vector<const char*> words) {
    words.insert(words.begin(), "limbcast-test");
    return test::error_of<UsageError>(
        [&] { parser.parse(static_cast<int>(words.size()), words.data()); });
  };
  EXPECT_EQ(error({""}), "command line: [LOG] is ''; give a name or leave it out");
  EXPECT_EQ(error({"a.log", "b", ""}),
            "command line: [MORE...] is ''; give a name or leave it out");
}

TEST(OptionalArguments, KeepTheirDefaultWhereNoneIsGiven) {
  for (const bool given : {false, true}) {
    std::vector<std::string> sets = {"usual"};
    Parser parser("limbcast-test", "test");
    parser.add_positional("[SET...]", sets, "sets");
    std::vector<const char*> words = {"limbcast-test"};
    if (given) words.insert(words.end(), {"a", "b"});
    ASSERT_TRUE(parser.parse(static_cast<int>(words.size()), words.data()));
    EXPECT_EQ(sets,
              given ? (std::vector<std::string>{"a", "b"}) : std::vector<std::string>{"usual"});
  }
}

TEST_F(OptionsTest, NamesTheFileOfAnUnknownKeyOrSection) {
  std::string file = config_file("[pose_fitter]\ncolour = blue\n");
  EXPECT_THAT(error_of({"in.log", "--config", file.c_str()}), HasSubstr("robot.conf"));
  file = config_file("[pose_fiter]\nmethod = paper\n");
  EXPECT_THAT(error_of({"in.log", "--config", file.c_str()}), HasSubstr("[pose_fiter]"));
  EXPECT_THAT(error_of({"in.log", "--config", "/missing.conf"}), HasSubstr("/missing.conf"));
}

TEST_F(OptionsTest, SaysWhatALineOfAFileMustBe) {
  std::string file = config_file("[pose_fitter]\nthreads\n");
  EXPECT_THAT(error_of({"in.log", "--config", file.c_str()}),
              HasSubstr("robot.conf: 'threads' is neither [MODULE] nor KEY = VALUE; see "));
  file = config_file("\x89PNG\x01\x02\n");
  EXPECT_THAT(error_of({"in.log", "--config", file.c_str()}),
              HasSubstr("robot.conf: is no text; give a configuration file to --config"));
}

TEST_F(OptionsTest, RefusesAFileThatSetsAKeyTwice) {
  const std::string file = config_file(
      "\xEF\xBB\xBF# threads = 1\n[pose_fitter]\r\nd-max-m = 0.5 # = 1\n[segmenter]\nd_max_m = "
      "1\n\n"
      "[pose_fitter]\n  d_max_m=0.4\n");
  EXPECT_EQ(error_of({"in.log", "--config", file.c_str()}),
            file +
                ": 'd-max-m' in section [pose_fitter] is set in lines 3, 8; leave it in one of "
                "them");
  EXPECT_NE(error_of({"in.log", "--config", file.c_str(), "--d-max-m", "0.3"}), "")
      << "whatever the command line says";
  config_file("log-level = error\nlog-level = info\n");
  EXPECT_EQ(error_of({"in.log", "--config", file.c_str()}),
            file + ": 'log-level' is set in lines 1, 2; leave it in one of them");
}

TEST_F(OptionsTest, LeavesAKeyThatIsSetTwiceInAnothersSectionToThat) {
  const std::string file = config_file("[tracker]\na = 1\na = 2\n");
  EXPECT_EQ(error_of({"in.log", "--config", file.c_str()}), "");
}

TEST_F(OptionsTest, RefusesAFileThatNamesAnother) {
  const std::string file = config_file("config = other.conf\n");
  EXPECT_EQ(error_of({"in.log", "--config", file.c_str()}),
            file + ": 'config' is for the command line; leave it out");
}

TEST_F(OptionsTest, RefusesAFolderAsConfigurationFile) {
  EXPECT_THAT(error_of({"in.log", "--config", folder_.path().c_str()}),
              HasSubstr(folder_.path() + ": is a folder; give a file to --config"));
}

TEST_F(OptionsTest, RefusesNamesThatMessagesCannotHave) {
  EXPECT_EQ(error_of({"in.log", "--sensor", ""}),
            "command line: 'sensor' is '', must be a name, not empty");
  EXPECT_EQ(error_of({"in.log", "--images-channel", ""}),
            "command line: 'images-channel' is '', must be a name of 1 to 63 characters");
  const std::string longest(kLongestChannel, 'A');
  EXPECT_TRUE(parse({"in.log", "--images-channel", longest.c_str()}));
  EXPECT_EQ(settings_.channel, longest);
  EXPECT_THAT(error_of({"in.log", "--images-channel", (longest + "A").c_str()}),
              HasSubstr("must be a name of 1 to 63 characters"));
}

TEST_F(OptionsTest, ReadsAFileWithAByteOrderMark) {
  const std::string file = config_file("\xEF\xBB\xBF[pose_fitter]\r\nthreads = 4\r\n");
  EXPECT_TRUE(parse({"in.log", "--config", file.c_str()}));
  EXPECT_EQ(settings_.threads, 4);
}

TEST_F(OptionsTest, HelpShowsNoDefaultOfWhatIsLeftOut) {
  EXPECT_FALSE(parse({"--help"}));
  EXPECT_THAT(out_.str(), HasSubstr("left out: as it is [ms] (a number)\n"));
}

TEST_F(OptionsTest, HelpShowsHowASwitchIsSet) {
  EXPECT_FALSE(parse({"--help"}));
  EXPECT_THAT(out_.str(), HasSubstr("--verbose[=VALUE]\n"));
}

TEST_F(OptionsTest, HelpShowsUnitAndDefault) {
  EXPECT_FALSE(parse({"--help"}));
  EXPECT_THAT(out_.str(), HasSubstr("largest step [m] (0.001 to 1, default 0.05)"));
}

TEST(RunProgram, TellsWrongUsageFromFailure) {
  EXPECT_EQ(run_program("p", [] {}), 0);
  EXPECT_EQ(run_program("p", [] { throw std::runtime_error("disk full"); }), 1);
  EXPECT_EQ(run_program("p", [] { throw UsageError("no such file"); }), 2);
}

TEST(RunProgram, NamesAFolderThatMayNotBeRead) {
  testing::internal::CaptureStderr();
  const int code = run_program("p", [] {
    throw std::filesystem::filesystem_error("directory iterator cannot open directory", "/locked",
                                            make_error_code(std::errc::permission_denied));
  });
  EXPECT_EQ(code, 2);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "p: /locked: Permission denied; check its name and permissions\n");
}

TEST(RunProgram, FailsWhereItsOutputCannotBeWritten) {
  const auto print_to_a_full_disk = [] {
    if (std::freopen("/dev/full", "w", stdout) == nullptr) std::abort();
    std::exit(run_program("p", [] { std::printf("good\n"); }));
  };
  EXPECT_EXIT(print_to_a_full_disk(), ::testing::ExitedWithCode(1),
              "p: cannot write to stdout \\(No space left on device\\)\n");
}

}  // namespace
}  // namespace limbcast::config
