#include "app/print.hpp"

#include "app/standard_streams.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

void print_answer(const CommonOptions& asked, const Json& answer,
                  const std::function<std::string(const Json&)>& in_words) {
  if (asked.json) {
    write_output(json_text(answer));
  } else if (!asked.quiet) {
    write_output(in_words(answer));
  }
}

}  // namespace coordreq
