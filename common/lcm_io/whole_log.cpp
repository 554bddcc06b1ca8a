#include "common/lcm_io/whole_log.hpp"

#include <stdexcept>

#include "common/whole_file.hpp"

namespace limbcast::lcm_io {

WholeLog::WholeLog(const std::string& path) : path_(path), unfinished_(unfinished_file(path)) {}

LogWriter& WholeLog::writer() {
  if (!writer_) writer_.emplace(unfinished_);
  return *writer_;
}

void WholeLog::close() {
  if (writer_) writer_->close();
}

void WholeLog::finish() {
  // What stands beside it then is an earlier run's.
  if (!begun()) throw std::runtime_error(path_ + ": was not written, as nothing came");
  close();
  finish_file(path_);
}

std::string WholeLog::what_is_left(const std::string& done) const {
  return begun() ? unfinished_ + " holds what was " + done + " so far" : path_ + " was not written";
}

}  // namespace limbcast::lcm_io
