// write_sample FILE [THREADS [MOST_BYTES]]: writes the made-up result of sample_content.hpp, for tests that
// look at it from outside. MOST_BYTES limits the size of files as a full disk would. Exit 5 and the error if
// it fails. write_sample FILE everything: a small one that has every dataset a file can have.
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <string>

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
    const bool everything = argc > 2 && std::string(argv[2]) == "everything";
    coordreq::ThreadTeam team(argc > 2 && !everything ? std::atoi(argv[2]) : 2);
    if (argc > 3) limit_file_size(argv[3]);
    coordreq::sample::Options options;
    if (everything) options = {.points = {41, 30, 20}, .with_everything = true};
    const coordreq::sample::Sample sample = coordreq::sample::make_sample(options);
    coordreq::write_results(argv[1], sample.spec, sample.values, team);
  } catch (const coordreq::Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.exit_code());
  }
  return 0;
}
