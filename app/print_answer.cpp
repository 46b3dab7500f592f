#include "app/print.hpp"

#include "app/standard_streams.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

void print_answer(const CommonOptions& args, const Json& answer,
                  const std::function<std::string(const Json&)>& to_text) {
  if (args.json) {
    write_output(json_text(answer));
  } else if (!args.quiet) {
    write_output(to_text(answer));
  }
}

}  // namespace coordreq
