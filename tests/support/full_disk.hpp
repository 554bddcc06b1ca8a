#pragma once

#include <sys/resource.h>

#include <csignal>

namespace limbcast::test {

/// As on a disk that is full after so many bytes; for the rest of the process.
inline void let_files_grow_to(rlim_t bytes) {
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, SIG_IGN);  // NOLINT(cert-err33-c): there is no handler to restore
}

}  // namespace limbcast::test
