// write_sample FILE [THREADS [MOST_BYTES]]: writes the made-up result of sample_content.hpp, for tests that
// look at it from outside. MOST_BYTES limits the size of files as a full disk would. Exit 5 and the error if
// it fails.
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <iostream>

#include "base/error.hpp"
#include "base/thread_team.hpp"
#include "results/sample_content.hpp"
#include "results/write_results.hpp"

namespace {

void limit_file_size(const char* bytes) {
  std::signal(SIGXFSZ, SIG_IGN);  // writing then fails, instead of ending the program
  const rlimit limit{std::strtoull(bytes, nullptr, 10), RLIM_INFINITY};
  setrlimit(RLIMIT_FSIZE, &limit);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  try {
    coordreq::ThreadTeam team(argc > 2 ? std::atoi(argv[2]) : 2);
    if (argc > 3) limit_file_size(argv[3]);
    coordreq::write_results(argv[1], coordreq::sample::make_content(), team);
  } catch (const coordreq::Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.exit_code());
  }
  return 0;
}
