#include "tests/support/virtual_display.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

namespace limbcast::test {
namespace {

/// The next line; empty at the end.
std::string next_line(int file) {
  std::string line;
  for (char c = 0; read(file, &c, 1) == 1 && c != '\n';) line += c;
  return line;
}

/// The number that Xvfb writes once programs can connect. Before it come complaints about numbers
/// that other displays have.
std::string display_number(int file) {
  std::string line = next_line(file);
  while (!line.empty() && line.find_first_not_of("0123456789") != std::string::npos)
    line = next_line(file);
  return line;
}

}  // namespace

bool VirtualDisplay::available() {
  return run({"sh", "-c", "command -v Xvfb && command -v xdotool && command -v import"})
             .exit_code == 0;
}

VirtualDisplay::VirtualDisplay() : folder_(temporary_folder("virtual_display")) {
  const std::string pipe = folder_ + "/xvfb";
  if (mkfifo(pipe.c_str(), S_IRUSR | S_IWUSR) != 0) throw std::runtime_error(pipe + ": no pipe");
  server_ = std::make_unique<ChildProcess>(
      std::vector<std::string>{"Xvfb", "-noreset", "-displayfd", "1", "-screen", "0",
                               "1400x1000x24", "-nolisten", "tcp"},
      pipe);
  // Kept open: the server may write more.
  server_output_ = open(pipe.c_str(), O_RDONLY | O_CLOEXEC);
  variable_ = "DISPLAY=:" + display_number(server_output_);
}

VirtualDisplay::~VirtualDisplay() {
  // Told, not killed: it takes its lock file and socket away.
  server_->signal(SIGTERM);
  server_->wait();
  close(server_output_);
}

RunResult VirtualDisplay::tool(const std::vector<std::string>& command) const {
  std::vector<std::string> words = {"env", variable_};
  words.insert(words.end(), command.begin(), command.end());
  return run(words);
}

bool VirtualDisplay::has_window(const std::string& title) const {
  return tool({"xdotool", "search", "--onlyvisible", "--name", "^" + title + "$"}).exit_code == 0;
}

std::string VirtualDisplay::window(const std::string& title, ChildProcess& program) const {
  while (program.running()) {
    const RunResult found =
        tool({"xdotool", "search", "--onlyvisible", "--name", "^" + title + "$"});
    if (found.exit_code == 0) return found.output.substr(0, found.output.find('\n'));
  }
  return "";
}

void VirtualDisplay::show(const std::string& window, cv::Size size) const {
  tool({"xdotool", "windowmove", window, "0", "0", "windowsize", window, std::to_string(size.width),
        std::to_string(size.height), "windowraise", window, "windowfocus", window});
}

void VirtualDisplay::press(const std::string& window, const std::string& key) const {
  tool({"xdotool", "windowfocus", window, "key", key});
}

void VirtualDisplay::double_click(cv::Point pixel) const {
  // The other button ends the series of clicks before, to which these two would else be counted.
  tool({"xdotool", "mousemove", std::to_string(pixel.x), std::to_string(pixel.y), "click", "2",
        "click", "--repeat", "2", "--delay", "20", "1"});
}

void VirtualDisplay::drag(cv::Point from, cv::Point to) const {
  tool({"xdotool", "mousemove", std::to_string(from.x), std::to_string(from.y), "mousedown", "1",
        "mousemove", std::to_string(to.x), std::to_string(to.y), "mouseup", "1"});
}

void VirtualDisplay::turn_wheel(cv::Point pixel, bool up) const {
  // X calls the wheel buttons 4 and 5.
  tool({"xdotool", "mousemove", std::to_string(pixel.x), std::to_string(pixel.y), "click",
        up ? "4" : "5"});
}

cv::Mat VirtualDisplay::screenshot() const {
  // The first attempt fails now and then on a busy machine while windows move.
  constexpr int kMostAttempts = 30;
  const std::string file = folder_ + "/screen.png";
  cv::Mat picture;
  for (int i = 0; i < kMostAttempts && picture.empty(); ++i) {
    tool({"import", "-window", "root", file});
    picture = cv::imread(file);
  }
  if (picture.empty()) throw std::runtime_error(file + ": no picture of the screen");
  return picture;
}

}  // namespace limbcast::test
