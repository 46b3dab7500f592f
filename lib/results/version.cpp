#include "results/version.hpp"

#include "git_version.hpp"

namespace coordreq {

std::string_view program_version() {
  return COORDREQ_VERSION;
}

std::string_view program_git_sha1() {
  return kGitSha1;
}

}  // namespace coordreq
